use roxmltree::{Document, Node};

use super::*;

fn figure() -> Figure {
    let x: Vec<f64> = (0..9).map(|n| 10f64.powf(n as f64 / 4.0 - 1.0)).collect();
    let curve = |n: usize| {
        let y = x.iter().map(|x| 0.3 / (1.0 + x / n as f64));
        let y = y.map(|value| Estimate { value, error: 0.05 * value });
        Curve::with_errors(format!("{n} ω_{{c}}"), x.clone(), y)
    };
    let curves: Vec<Curve> = (1..4).map(curve).collect();
    let (rate, friction) = (Axis::logarithmic("slip rate V (m/s)"), Axis::linear("friction coefficient μ"));
    let mut area = Panel::new("area", "area", rate.clone(), Axis::logarithmic("A (m^{2})"), curves.clone());
    area.curves.truncate(1);
    let panels = vec![Panel::new("friction", "weakening", rate, friction, curves), area, map(0.0, 10.0)];
    Figure::new("Friction", panels)
}

fn map(from: f64, to: f64) -> Panel {
    let row = |i: usize| (0..20).map(|j| [j as f64, i as f64, (i * j) as f64]).collect();
    let rows: Vec<Vec<[f64; 3]>> = (0..20).map(row).collect();
    let colors = Colors::Bands { label: "temperature T (K)".into(), from, to };
    let field = Field {
        cells: Field::quadrilaterals(&rows),
        colors,
        arrow: Some(Arrow { text: "flat".into(), backwards: false }),
    };
    Panel { name: "map".into(), equal: true, field: Some(field), ..Panel::default() }
}

fn texts(node: Node) -> Vec<String> {
    let text =
        |node: Node| node.descendants().filter_map(|node| node.text().filter(|_| node.is_text())).collect();
    node.descendants().filter(|node| node.has_tag_name("text")).map(text).collect()
}

fn group<'a>(document: &'a Document, class: &str) -> Node<'a, 'a> {
    let found = document.descendants().find(|node| node.attribute("class") == Some(class));
    found.unwrap_or_else(|| panic!("no group {class}"))
}

/// Paths that are curves: wider than ticks and bars, and not closed.
fn curves<'a>(node: Node<'a, 'a>) -> Vec<Node<'a, 'a>> {
    node.descendants().filter(|node| node.attribute("stroke-width") == Some("1")).collect()
}

#[test]
fn every_format_is_written_and_reproducible() {
    let folder = tempfile::tempdir().unwrap();
    for (extension, start) in [("svg", &b"<svg"[..]), ("PNG", b"\x89PNG"), ("pdf", b"%PDF-1.")] {
        let path = folder.path().join(format!("figure.{extension}"));
        figure().save(&path).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        figure().save(&path).unwrap();
        assert!(bytes == std::fs::read(&path).unwrap(), "{extension}");
        assert!(bytes.starts_with(start) && bytes.len() > 5000, "{extension}");
    }
}

#[test]
fn a_panel_is_a_group_with_its_labels_ticks_and_curves() {
    let svg = figure().svg();
    let document = Document::parse(&svg).unwrap();
    let panel = group(&document, "panel friction");
    let shown = texts(panel);
    for text in
        ["slip rate V (m/s)", "friction coefficient μ", "weakening", "3 ωc", "10−1", "100", "101", "0.10"]
    {
        assert!(shown.contains(&text.to_string()), "{text}: {shown:?}");
    }
    // Each curve, and its sample in the legend.
    let curves = curves(panel);
    assert_eq!(curves.len(), 6);
    let mut looks: Vec<_> =
        curves.iter().map(|curve| (curve.attribute("stroke"), curve.attribute("stroke-dasharray"))).collect();
    looks.sort();
    looks.dedup();
    assert_eq!(looks.len(), 3);
    assert_eq!(texts(group(&document, "title")), ["Friction"]);
    let map = texts(group(&document, "panel map"));
    assert!(map.contains(&"temperature T (K)".to_string()) && map.contains(&"flat".to_string()), "{map:?}");
}

#[test]
fn a_single_panel_is_as_wide_as_a_column_and_has_no_titles() {
    let names = |names: &[&str]| figure().only(&names.iter().map(ToString::to_string).collect::<Vec<_>>());
    let one = names(&["area"]).unwrap();
    assert_eq!((one.panels.len(), one.panels[0].title.as_str(), one.title.as_str()), (1, "", ""));
    // 85 mm.
    assert!((one.page().width - 85.0 / 25.4 * 72.0).abs() < 0.1);
    assert_eq!(names(&["map", "friction"]).unwrap().panels.len(), 2);
    assert_eq!(names(&[]).unwrap(), figure());
    let error = names(&["areas"]).unwrap_err().to_string();
    assert_eq!(error, "the figure has no panel areas: it has friction, area, map");
}

/// Ends of all texts and lines of a panel: (left, right, top, bottom).
fn bounds(group: &Group) -> [f64; 4] {
    use canvas::{Mark, width};
    let mut bounds = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
    let mut add = |x: f64, y: f64| {
        bounds = [bounds[0].min(x), bounds[1].max(x), bounds[2].min(y), bounds[3].max(y)];
    };
    for mark in &group.marks {
        match mark {
            Mark::Line { points, .. } => points.iter().for_each(|(x, y)| add(*x, *y)),
            Mark::Fill { outlines, .. } => outlines.iter().flatten().for_each(|(x, y)| add(*x, *y)),
            Mark::Text { at: (x, y), text, size, anchor } => {
                let length = width(text, *size);
                let start = match anchor {
                    Anchor::Start => 0.0,
                    Anchor::Middle | Anchor::Upwards => -0.5 * length,
                    Anchor::End => -length,
                };
                for end in [start, start + length] {
                    match anchor {
                        Anchor::Upwards => (add(x - 0.75 * size, y - end), add(x + 0.2 * size, y - end)),
                        _ => (add(x + end, y - 0.75 * size), add(x + end, y + 0.2 * size)),
                    };
                }
            }
        }
    }
    bounds
}

#[test]
fn nothing_reaches_beyond_its_panel() {
    let mut panels = figure().panels;
    let values = vec![1.234e-9, 5e-9, 9.9e-9];
    let long =
        (0..6).map(|n| Curve::new(format!("a long label, number {n}"), values.clone(), values.clone()));
    let axis = || Axis::linear("length (m)");
    panels.push(Panel::new("small", "numbers", axis(), axis(), long.collect()));
    for panel in &panels {
        let [left, right, top, bottom] = bounds(&panel::draw(panel, (0.0, 0.0)));
        let (width, height) = panel::SIZE;
        assert!(
            left >= 0.0 && right <= width && top >= 0.0 && bottom <= height,
            "{}: {left} {right} {top} {bottom}",
            panel.name
        );
    }
}

#[test]
fn legends_do_not_cover_curves() {
    use canvas::Mark;
    // Curves through all corners: no room inside.
    let x: Vec<f64> = (0..=20).map(f64::from).collect();
    let wave = |phase: f64| x.iter().map(|x| (1.5 * x + phase).sin()).collect();
    let full = (0..4).map(|n| Curve::new(format!("wave {n}"), x.clone(), wave(f64::from(n)))).collect();
    let full = Panel::new("full", "", Axis::linear("x"), Axis::linear("y"), full);
    for panel in [&full, &figure().panels[0]] {
        let group = panel::draw(panel, (0.0, 0.0));
        let lines: Vec<&Vec<(f64, f64)>> = (group.marks.iter())
            .filter_map(|mark| match mark {
                Mark::Line { points, width, .. } if *width == 1.0 => Some(points),
                _ => None,
            })
            .collect();
        let (curves, samples) = lines.split_at(lines.len() / 2);
        let samples: Vec<_> = samples.iter().map(|sample| (sample[0], sample[1].0)).collect();
        for ((left, y), right) in samples {
            for pair in curves.iter().flat_map(|curve| curve.windows(2)) {
                for n in 0..=20 {
                    let at = |a: f64, b: f64| a + (b - a) * f64::from(n) / 20.0;
                    let (px, py) = (at(pair[0].0, pair[1].0), at(pair[0].1, pair[1].1));
                    assert!(!(left..=right + 30.0).contains(&px) || (py - y).abs() > 3.0, "{}", panel.name);
                }
            }
        }
    }
}

#[test]
fn points_and_their_fit_share_a_colour() {
    let (x, y) = (vec![1.0, 2.0, 3.0], vec![1.0, 3.0, 2.0]);
    let svg = |drawn: Drawn| {
        let curves = vec![Curve::new("", x.clone(), y.clone()).drawn_as(drawn, 1)];
        Figure::new("", vec![Panel { curves, ..Panel::default() }]).svg()
    };
    let [both, points, line] = [Drawn::LineAndMarkers, Drawn::Markers, Drawn::Line].map(svg);
    for picture in [&both, &points, &line] {
        assert!(picture.contains("#0072b2") && !picture.contains("#d55e00"));
    }
    assert!(both.len() > points.len() && both.len() > line.len());
    assert!(line.contains("stroke-dasharray") && !points.contains("stroke-dasharray"));
}

#[test]
fn what_cannot_be_drawn_is_left_out() {
    let mut figure = figure();
    figure.panels[0].curves = vec![
        // Letters that the font does not have.
        Curve::new("摩擦", vec![0.0, 1.0, 2.0], vec![1.0, f64::NAN, 3.0]),
        Curve::new("nothing", vec![0.0], vec![1.0]),
    ];
    let points = figure.panels[0].visible(&figure.panels[0].curves[0]);
    assert_eq!(points, [panel::Value { x: 2.0, y: 3.0, error: 0.0 }]);
    // A field of one value has no scale.
    figure.panels.push(map(1.0, 1.0));
    for drawn in [figure, Figure::default()] {
        Document::parse(&drawn.svg()).unwrap();
        export::png(&drawn.page()).unwrap();
        export::pdf(&drawn.page()).unwrap();
    }
}
