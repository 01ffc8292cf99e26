#!/usr/bin/env python3
"""Thermal expansion of a counterface that conducts, over that of the asperity: of two like half-spaces that rub over a disc.

Friction releases a uniform flux q over the disc of radius a, at rest on one half-space, from t = 0 on; the other moves at the
speed V. Both have the same mean rise over the disc. A pulse of heat Q per area with the wave number k displaces a free surface
by 2 (1 + nu) alpha Q/(rho c) erfc(k sqrt(kappa t)), and raises its temperature by Q exp(-kappa k^2 t)/(rho c sqrt(pi kappa t));
of the moving body the wave is seen times J0(k V t), in the mean over directions. The disc has the transform 2 pi a J1(k a)/k.

Prints, over the Peclet number Va/(2 kappa) and the slip over a: the share of the heat that enters the body at rest, and the mean
displacement of the moving surface over the disc, over that of the surface at rest.
"""

import argparse

import numpy as np
from scipy.special import erfc, j0, j1

# Wave numbers over 1/a, equal steps of their roots, and weights of the mean over the disc.
ROOTS = (np.arange(6000) + 0.5) * (np.sqrt(400.0) / 6000)
WAVES = ROOTS**2
WEIGHTS = 2 * j1(WAVES) ** 2 / WAVES * 2 * ROOTS * (ROOTS[1] - ROOTS[0])


def responses(speed, times):
    """Mean rise and displacement at the times, of constant flux from 0 on; in units of a, k and kappa."""
    # The rise of a pulse is integrable in the root of the time.
    roots = np.linspace(0, np.sqrt(times[-1]), 3001)
    middle = 0.5 * (roots[1:] + roots[:-1])
    ages = middle**2
    seen = np.array([WEIGHTS * j0(WAVES * speed * age) for age in ages])
    rise = np.sum(seen * np.exp(-np.outer(ages, WAVES**2)), axis=1) * 2 / np.sqrt(np.pi)
    moved = np.sum(seen * erfc(np.sqrt(ages)[:, None] * WAVES), axis=1) * 2 * middle
    sums = [np.concatenate([[0], np.cumsum(pulse)]) * roots[1] for pulse in (rise, moved)]
    return [lambda t, total=total: np.interp(np.sqrt(t), roots, total) for total in sums]


def expansion(peclet, slip, steps=150):
    """Share of the heat in the body at rest, and displacement of the other over its own."""
    times = slip / (2 * peclet) * (np.arange(steps + 1) / steps) ** 2
    rise, moved = zip(*(responses(speed, times) for speed in (0.0, 2 * peclet)))
    share = np.zeros(steps)
    for i in range(1, steps + 1):
        ages = times[i] - times[: i + 1]
        own, other = (response(ages[:-1]) - response(ages[1:]) for response in rise)
        # Of the last interval from equal mean rises.
        known = np.dot(other, 1 - np.append(share[: i - 1], 0)) - np.dot(own[:-1], share[: i - 1])
        share[i - 1] = known / (own[-1] + other[-1])
    ages = times[-1] - times
    own, other = (response(ages[:-1]) - response(ages[1:]) for response in moved)
    return share[-1], np.dot(other, 1 - share) / np.dot(own, share)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--peclet", type=float, nargs="+", default=[0.5, 2, 10, 50])
    parser.add_argument("--slip", type=float, nargs="+", default=[2, 4, 20])
    arguments = parser.parse_args()
    print(f"{'Pe':>6} {'slip/a':>7} {'share':>8} {'expansion':>10}")
    for peclet in arguments.peclet:
        for slip in arguments.slip:
            share, ratio = expansion(peclet, slip)
            print(f"{peclet:6g} {slip:7g} {share:8.4f} {ratio:10.3f}")


if __name__ == "__main__":
    main()
