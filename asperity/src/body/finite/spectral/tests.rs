use super::*;

/// Excess of C of a principal stretch in each lane, turned by a rotation.
fn turned(values: [f64; 3], frame: &Frame<1>) -> [Lanes<1>; 6] {
    let mut tensor = [[0.0]; 6];
    for (v, &(i, j)) in PAIR.iter().enumerate() {
        tensor[v][0] = (0..3).map(|a| values[a] * frame[i][a][0] * frame[j][a][0]).sum();
    }
    tensor
}

/// Eigenvectors of some tensor that has three different eigenvalues.
fn rotation() -> Frame<1> {
    eigen::<1>([[0.3], [-0.2], [0.9], [0.4], [-0.5], [0.25]]).1
}

#[test]
fn spectral_form_gives_the_tensor_back() {
    let frame = rotation();
    for values in [
        [0.0; 3],
        [0.4, 0.4, 0.4],
        [0.4, 0.4, -0.3],
        [2.0, 2.0 + 1e-13, -0.9],
        [1e-9, -2e-9, 3e-9],
        [80.0, -0.99, 0.0],
    ] {
        let tensor = turned(values, &frame);
        let scale = values.iter().fold(f64::MIN_POSITIVE, |m: f64, x| m.max(x.abs()));
        let (found, axes) = eigen(tensor);
        let mut sorted = [found[0][0], found[1][0], found[2][0]];
        let mut exact = values;
        sorted.sort_by(f64::total_cmp);
        exact.sort_by(f64::total_cmp);
        let again = turned([found[0][0], found[1][0], found[2][0]], &axes);
        for i in 0..6 {
            assert!((again[i][0] - tensor[i][0]).abs() < 1e-14 * scale, "{values:?}");
        }
        for a in 0..3 {
            assert!((sorted[a] - exact[a]).abs() < 1e-14 * scale, "{sorted:?} {exact:?}");
            for b in 0..3 {
                let product: f64 = (0..3).map(|i| axes[i][a][0] * axes[i][b][0]).sum();
                assert!((product - f64::from(a == b)).abs() < 1e-14);
            }
        }
        // The logarithm in the frame that it was built from.
        let strain = Spectral::new(&tensor).log_strain();
        let expected = turned(values.map(|x| 0.5 * x.ln_1p()), &frame);
        let scale = expected.iter().fold(f64::MIN_POSITIVE, |m: f64, x| m.max(x[0].abs()));
        for i in 0..6 {
            assert!((strain[i][0] - expected[i][0]).abs() < 1e-13 * scale, "{values:?}");
        }
    }
}

/// The mean values of f' and f'' over segment and triangle (Hermite–Genocchi) by quadrature,
/// from well apart to equal, on both sides of the switch to series.
#[test]
fn divided_differences_are_the_hermite_genocchi_integrals() {
    const COUNT: usize = 400;
    let nodes: Vec<f64> = (0..COUNT).map(|i| (i as f64 + 0.5) / COUNT as f64).collect();
    for spread in [1.0, 0.12, 0.1, 0.041, 0.039, 4e-3, 1e-6, 0.0] {
        let excess = [0.3, 0.3 + spread, 0.3 - 0.4 * spread];
        let divided = Divided { excess, strain: excess.map(|x: f64| 0.5 * x.ln_1p()) };
        let lambda = excess.map(|x| 1.0 + x);
        for (a, b) in [(0, 1), (1, 2), (0, 0)] {
            let mean: f64 = nodes.iter().map(|t| 0.5 / (lambda[a] + t * (lambda[b] - lambda[a]))).sum();
            assert!((divided.first(a, b) - mean / COUNT as f64).abs() < 1e-6, "{spread} {a} {b}");
        }
        // Over the unit triangle, of area ½, by Duffy's map.
        for (a, b, c) in [(0, 1, 2), (1, 1, 2), (2, 0, 0), (1, 1, 1)] {
            let mut mean = 0.0;
            for s in &nodes {
                for t in &nodes {
                    let x = lambda[a] + s * (lambda[b] - lambda[a]) + s * t * (lambda[c] - lambda[b]);
                    mean += -0.5 / (x * x) * s / (COUNT * COUNT) as f64;
                }
            }
            let found = divided.second(a, b, c);
            assert!((found / mean - 1.0).abs() < 1e-5, "{spread} {a}{b}{c}: {found} {mean}");
        }
    }
}

/// Quotient and series agree where one takes over from the other.
#[test]
fn second_differences_do_not_jump() {
    let at = |spread: f64| {
        let excess = [0.3, 0.3 + spread, 0.3 + 0.3 * spread];
        Divided { excess, strain: excess.map(|x: f64| 0.5 * x.ln_1p()) }.second(0, 1, 2)
    };
    // The switch is at a spread s of CLOSE times a mean of 1.3 + 1.3 s/3.
    let switch = 1.3 * CLOSE / (1.0 - CLOSE * 1.3 / 3.0);
    let [below, above] = [1.0 - 1e-9, 1.0 + 1e-9].map(|share| at(share * switch));
    assert!((below - above).abs() < 1e-9 * below.abs(), "{below} {above}");
}
