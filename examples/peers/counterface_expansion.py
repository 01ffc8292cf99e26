#!/usr/bin/env python3
"""Thermal expansion of a counterface that conducts, over that of the asperity: of two like half-spaces that rub over a disc.

Friction releases a uniform flux q over the disc of radius a, at rest on one half-space, from t = 0 on; the other moves at the
speed V. Both have the same mean rise over the disc. A pulse of heat Q per area with the wave number k displaces a free surface
by 2 (1 + nu) alpha Q/(rho c) erfc(k sqrt(kappa t)), and raises its temperature by Q exp(-kappa k^2 t)/(rho c sqrt(pi kappa t));
of the moving body the wave is seen times J0(k V t), in the mean over directions. The disc has the transform 2 pi a J1(k a)/k.

Prints, over the Peclet number Va/(2 kappa) and the slip over a: the share of the heat that enters the body at rest, and the mean
displacement of the moving surface over the disc, over that of the surface at rest.

With --shape: mean, slope and curvature of the height of the moving surface under a constant uniform flux, by least squares over the
disc, and what their remainder would add to the load of an elastic contact, over what the height adds (pressure of a flat punch as
the weight). Fast Fourier transforms in a box of 24 a.
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


def shape(peclet, slip, cells=256, box=24.0, steps=400):
    """Mean, slope and curvature of the height over 2 (1 + nu) alpha q a^2/k, and the share of the load in their remainder."""
    places = (np.arange(cells) - cells / 2) * box / cells
    x, y = np.meshgrid(places, places, indexing="ij")
    # Share of each cell that is in the disc.
    parts = ((np.arange(6) + 0.5) / 6 - 0.5) * box / cells
    disc = sum((x + i) ** 2 + (y + j) ** 2 < 1 for i in parts for j in parts) / 36
    waves = 2 * np.pi * np.fft.fftfreq(cells, box / cells)
    along, across = np.meshgrid(waves, waves, indexing="ij")
    flux, size = np.fft.fft2(disc), np.hypot(along, across)
    height = np.zeros_like(flux)
    last = np.sqrt(slip / (2 * peclet))
    for root in (np.arange(steps) + 0.5) / steps * last:
        age = root * root
        wave = erfc(size * root) * np.exp(-1j * along * 2 * peclet * age)
        height += flux * wave * 2 * root * last / steps
    inside = disc > 0.5
    height, squared = np.real(np.fft.ifft2(height))[inside], (x**2 + y**2)[inside]
    terms = np.stack([np.ones_like(squared), x[inside], 2 * squared - 1], 1)
    profile = np.linalg.lstsq(terms, height, rcond=None)[0]
    weight = 1 / np.sqrt(np.clip(1 - squared, 0.02, None))
    return profile, np.dot(height - terms @ profile, weight) / np.dot(height, weight)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--peclet", type=float, nargs="+", default=[0.5, 2, 10, 50])
    parser.add_argument("--slip", type=float, nargs="+", default=[2, 4, 20])
    parser.add_argument("--shape", action="store_true", help="mean, slope and curvature of the height")
    arguments = parser.parse_args()
    if arguments.shape:
        print(f"{'Pe':>6} {'slip/a':>7} {'mean':>9} {'slope':>9} {'curvature':>10} {'remainder':>10}")
        for peclet in arguments.peclet:
            for slip in arguments.slip:
                profile, remainder = shape(peclet, slip)
                print(f"{peclet:6g} {slip:7g}", *(f"{term:9.5f}" for term in profile), f"{remainder:10.4f}")
        return
    print(f"{'Pe':>6} {'slip/a':>7} {'share':>8} {'expansion':>10}")
    for peclet in arguments.peclet:
        for slip in arguments.slip:
            share, ratio = expansion(peclet, slip)
            print(f"{peclet:6g} {slip:7g} {share:8.4f} {ratio:10.3f}")


if __name__ == "__main__":
    main()
