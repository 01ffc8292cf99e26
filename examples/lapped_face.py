#!/usr/bin/env python3
"""Writes a text file of 256 x 256 heights in µm, 2 µm apart: in place of a measured map, for the tutorial of the book.

    examples/lapped_face.py lapped-face.txt

White noise under a Gaussian filter, 0.4 µm high (rms), as of a lapped face. Standard library only.
"""

import math
import random
import sys

POINTS, WIDTH, RMS = 256, 4.0, 0.4  # width of the filter in points


def smooth(row):
    """One row under the filter, periodic."""
    return [sum(w * row[(i + j) % POINTS] for j, w in KERNEL) for i in range(POINTS)]


REACH = int(3 * WIDTH)
KERNEL = [(j, math.exp(-0.5 * (j / WIDTH) ** 2)) for j in range(-REACH, REACH + 1)]

if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    generator = random.Random(4340)
    noise = [[generator.gauss(0.0, 1.0) for _ in range(POINTS)] for _ in range(POINTS)]
    columns = zip(*[smooth(row) for row in noise])
    heights = [smooth(column) for column in columns]
    rms = math.sqrt(sum(z * z for row in heights for z in row)) / POINTS
    with open(sys.argv[1], "w") as file:
        for row in heights:
            file.write(" ".join(f"{RMS / rms * z:.4f}" for z in row) + "\n")
