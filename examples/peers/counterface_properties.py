#!/usr/bin/env python3
"""Rise of a half-space whose conductivity and specific heat grow with temperature, under a uniform flux over a disc that moves fast.

Heat then does not spread along the surface: each point is a plane under a constant flux for the time since it entered the disc.
k = k0 (1 + b_k theta) and c = c0 (1 + b_c theta). Units: radius of the disc, its speed, k0, rho c0 (so kappa0 = 1), and a flux for
which the mean rise at constant properties is about 0.9.

The plane is solved by finite differences: implicit steps that grow in proportion to the time, nodes that are denser towards the
surface. Prints, for each pair of b: the mean Kirchhoff potential over the disc, int k/k0 dtheta, the mean rise, and the share f of
the mean potential for which constant properties with the diffusivity at f times it have the same mean rise. With --rest the same of
a plane at the time of one radius over the speed, with the diffusivity that grows with the potential.
"""

import argparse

import numpy as np

FLUX = 0.9
RADIUS_TIMES = 2.0
NODES, STEPS, ITERATIONS = 600, 2000, 6


def potential(rise, growth):
    return rise + 0.5 * growth * rise**2


def rise_at(potential, growth):
    return potential if growth == 0 else (np.sqrt(1 + 2 * growth * potential) - 1) / growth


def surface(growths):
    """Times and rises of the surface of a plane under the flux."""
    of_k, of_c = growths
    share = np.linspace(0, 1, NODES + 1)
    x = 10 * np.sqrt(RADIUS_TIMES) * (0.95 * share**2 + 0.05 * share)
    cells = np.diff(np.concatenate([[0], 0.5 * (x[1:] + x[:-1]), [x[-1]]]))
    times = RADIUS_TIMES * np.linspace(0, 1, STEPS + 1) ** 2
    theta, rises = np.zeros(NODES + 1), [0.0]
    for dt in np.diff(times):
        before = theta.copy()
        for _ in range(ITERATIONS):
            k = 1 + of_k * theta
            between = 0.5 * (k[1:] + k[:-1]) / np.diff(x)
            capacity = cells * (1 + of_c * 0.5 * (theta + before)) / dt
            right = capacity * before
            right[0] += FLUX
            diagonal = capacity.copy()
            diagonal[:-1] += between
            diagonal[1:] += between
            theta = tridiagonal(between, diagonal, right)
        rises.append(theta[0])
    return times, np.array(rises)


def tridiagonal(between, diagonal, right):
    """Solution with the off-diagonals -between; the last node stays cold."""
    d, r = diagonal.copy(), right.copy()
    for i in range(1, len(d) - 1):
        w = between[i - 1] / d[i - 1]
        d[i] -= w * between[i - 1]
        r[i] += w * r[i - 1]
    solution = np.zeros_like(r)
    for i in range(len(d) - 2, -1, -1):
        solution[i] = (r[i] + between[i] * solution[i + 1]) / d[i]
    return solution


def disc(points=200):
    """Times since they entered the disc of points at equal areas, and their weights."""
    y = (np.arange(points) + 0.5) / points
    chord = 2 * np.sqrt(1 - y**2)
    times = chord[:, None] * (np.arange(points) + 0.5) / points
    return times, np.broadcast_to(chord[:, None], times.shape) / (chord.sum() * points)


def share_of(mean_rise, scheme):
    """The share for which scheme(share) is mean_rise, by bisection."""
    low, high = 0.0, 1.2
    rising = scheme(high) > scheme(low)
    for _ in range(24):
        middle = 0.5 * (low + high)
        if (scheme(middle) > mean_rise) == rising:
            high = middle
        else:
            low = middle
    return low


def diffusivity(theta, growths):
    return (1 + growths[0] * theta) / (1 + growths[1] * theta)


def moving(growths):
    times, rises = surface(growths)
    since, weights = disc()
    local = np.interp(np.sqrt(since), np.sqrt(times), rises)
    mean = lambda values: float((values * weights).sum())

    def scheme(share):
        kappa = 1.0
        for _ in range(60):
            of_disc = 2 * FLUX * np.sqrt(kappa * since / np.pi)
            kappa = diffusivity(rise_at(share * mean(of_disc), growths[0]), growths)
        return mean(rise_at(of_disc, growths[0]))

    return mean(potential(local, growths[0])), mean(local), share_of(mean(local), scheme)


def resting(growths):
    times, rises = surface(growths)
    rise = float(np.interp(1.0, np.sqrt(times), rises))
    steps = np.linspace(0, 1, 4001) ** 2

    def scheme(share):
        stretched = 0.0
        for dt in np.diff(steps):
            end = stretched + dt
            for _ in range(3):
                middle = FLUX * (np.sqrt(stretched / np.pi) + np.sqrt(end / np.pi))
                end = stretched + dt * diffusivity(rise_at(share * middle, growths[0]), growths)
            stretched = end
        return rise_at(2 * FLUX * np.sqrt(stretched / np.pi), growths[0])

    return potential(rise, growths[0]), rise, share_of(rise, scheme)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rest", action="store_true", help="a plane at rest in place of a disc that moves fast")
    of = resting if parser.parse_args().rest else moving
    print("  b_k   b_c  potential    rise   share  ln(kappa)")
    for growths in [(0.5, 0), (1, 0), (2, 0), (0, 0.5), (0, 1), (0, 2), (0.5, 0.25), (1, 0.5), (2, 1)]:
        mean, rise, share = of(growths)
        print(f"{growths[0]:5} {growths[1]:5}  {mean:9.4f} {rise:7.4f} {share:7.3f} {np.log(diffusivity(rise, growths)):10.3f}")


if __name__ == "__main__":
    main()
