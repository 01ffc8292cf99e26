#!/usr/bin/env python3
"""Temperatures of two half-spaces that rub over a disc, equal at each point of it.

Boundary elements: the disc, of radius a, is divided into squares of constant flux. One half-space is at rest beside the disc,
the other moves past it at the speed V; friction releases a uniform flux q. Rises are those of point sources (Carslaw & Jaeger,
Conduction of Heat in Solids, 1959, sec. 10.2 and 10.7), integrated over each square: steady ones, or those of the body at rest
at the Fourier number kappa t/a^2 of a constant flux, beside the steady ones of the moving body.

Prints, over the Peclet number Pe = Va/(2 kappa) and the conductivity of the moving body over that of the other: the share of
the heat that enters the body at rest, the mean rise over qa/k of this body, and its highest rise over the mean one. They are
followed by those of a solution in which the flux into the moving body is a sum of 1, x/a and 2(r/a)^2 - 1, x along the motion,
and the rises of both bodies have only their moments with these in common; and by those with a uniform flux and a common mean.
"""

import argparse
import math

import numpy as np
from numpy.polynomial.legendre import leggauss

NODES, WEIGHTS = leggauss(12)
erfc = np.vectorize(math.erfc)
# Of a square next to the point, and of others.
NEAR, PARTS_NEAR, PARTS_FAR = 2, 8, 2


def over_own_square(width, peclet, fourier):
    """Integral over a square around the point of exp(-Pe (r - x)) erfc(r/(2 sqrt(Fo)))/r, in polar coordinates.

    Of a moving body Fo is infinite, of a body at rest Pe is 0.
    """
    nodes, weights = leggauss(60)
    total = 0.0
    for start in np.arange(8) * np.pi / 4:
        angle = start + np.pi / 8 * (nodes + 1)
        end = 0.5 * width / np.maximum(abs(np.cos(angle)), abs(np.sin(angle)))
        if math.isfinite(fourier):
            reached = end / (2 * math.sqrt(fourier))
            inner = end * erfc(reached) + 2 * math.sqrt(fourier / np.pi) * -np.expm1(-(reached**2))
            total += np.sum(weights * np.pi / 8 * inner)
            continue
        decay = peclet * (1 - np.cos(angle))
        inner = np.where(decay * end < 1e-8, end, -np.expm1(-decay * end) / np.maximum(decay, 1e-300))
        total += np.sum(weights * np.pi / 8 * inner)
    return total


def over_other_square(width, i, j, peclet, fourier):
    """The same over a square i and j squares upstream and aside of the point."""
    parts = PARTS_NEAR if max(abs(i), abs(j)) <= NEAR else PARTS_FAR
    starts = (np.arange(parts)[:, None] + 0.5 + 0.5 * NODES).ravel() / parts - 0.5
    weights = np.tile(WEIGHTS, parts) * width / (2 * parts)
    x, y = np.meshgrid((i + starts) * width, (j + starts) * width, indexing="ij")
    r = np.hypot(x, y)
    spread = erfc(r / (2 * math.sqrt(fourier))) if math.isfinite(fourier) else np.exp(-peclet * (r - x))
    return weights @ (spread / r) @ weights


def rises(cells, peclet, fourier=math.inf):
    """Rise in the middle of each square per flux of each, over a/k, and x/a and y/a of the squares."""
    width = 2 / cells
    centres = (np.arange(cells) + 0.5) * width - 1
    inside = np.hypot(*np.meshgrid(centres, centres, indexing="ij")) < 1
    row, column = np.nonzero(inside)
    kernel = np.zeros((2 * cells + 1, 2 * cells + 1))
    for i in range(-cells, cells + 1):
        for j in range(cells + 1):
            own = i == 0 and j == 0
            over = (peclet, fourier)
            value = over_own_square(width, *over) if own else over_other_square(width, i, j, *over)
            kernel[cells + i, cells + j] = kernel[cells + i, cells - j] = value / (2 * np.pi)
    offsets = row[:, None] - row, column[:, None] - column
    return kernel[offsets[0] + cells, offsets[1] + cells], centres[row], centres[column]


def shared(resting, moving, shapes=None):
    """Share, mean rise, and highest over mean rise of the body at rest.

    With `shapes` the flux into the moving body is a sum of these, and the rises have equal moments with them.
    """
    uniform = np.ones(len(resting))
    both, alone = resting + moving, resting @ uniform
    if shapes is None:
        into_moving = np.linalg.solve(both, alone)
    else:
        into_moving = shapes.T @ np.linalg.solve(shapes @ both @ shapes.T, shapes @ alone)
    into_resting = uniform - into_moving
    rise = resting @ into_resting
    return into_resting.mean(), rise.mean(), rise.max() / rise.mean()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=64, help="squares along the diameter [default: 64]")
    parser.add_argument("--peclet", type=float, nargs="+", default=[0.5, 2, 10, 50, 100])
    parser.add_argument("--ratio", type=float, nargs="+", default=[0.05, 0.3, 1, 3, 20])
    parser.add_argument("--fourier", type=float, default=math.inf, help="of the body at rest [default: steady]")
    parser.add_argument(
        "--constriction", type=float, default=1, help="rise of the body at rest over that of a half-space [default: 1]"
    )
    arguments = parser.parse_args()
    at_rest, x, y = rises(arguments.cells, 0.0, arguments.fourier)
    at_rest *= arguments.constriction
    constraints = [None, np.array([np.ones_like(x), x, 2 * (x**2 + y**2) - 1]), np.ones((1, len(x)))]
    headings = ["equal at each point", "three moments equal", "mean equal"]
    print(f"{'':14}", *(f"{heading:26}" for heading in headings))
    print(f"{'Pe':>6} {'k2/k':>6} ", *[f"{'share':>8} {'mean':>8} {'highest':>8}"] * 3)
    for peclet in arguments.peclet:
        like, *_ = rises(arguments.cells, peclet)
        for ratio in arguments.ratio:
            values = [value for shapes in constraints for value in shared(at_rest, like / ratio, shapes)]
            print(f"{peclet:6g} {ratio:6g} ", *(f"{value:8.5f}" for value in values))


if __name__ == "__main__":
    main()
