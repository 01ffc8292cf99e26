"""The problem that all codes solve, and a mesh of it for those that bring none. mm, N, MPa."""

import math

import numpy as np

RADIUS = 1.0
YOUNG = 200e3
POISSON = 0.3
YIELD = 400.0
HARDENING = 200.0
FRICTION = 0.2
INTERFERENCE = 20.0  # of that of first yield
SLIDE = 2.0  # of the interference

CONTACT_MODULUS = YOUNG / (1 - POISSON**2)
# Jackson & Green 2005: first yield, and the contact area of an elastic-plastic press.
_C = 1.295 * math.exp(0.736 * POISSON)
CRITICAL = (math.pi * _C * YIELD / (2 * CONTACT_MODULUS)) ** 2 * RADIUS
DEPTH = INTERFERENCE * CRITICAL
CONTACT_RADIUS = math.sqrt(
    RADIUS * DEPTH * (INTERFERENCE / 1.9) ** (0.14 * math.exp(23 * YIELD / CONTACT_MODULUS))
)

FINE = 1.25  # half width of the uniformly fine block, in contact radii


def half_hemisphere(elements_per_radius):
    """Hexahedra of the half y >= 0: (points, cells, top, base, symmetry).

    A half ball with a uniform block in the middle of its flat side and shells around that, mapped
    to the hemisphere with the flat side as its surface and the apex in the middle. In each
    meridian that is the conformal map w -> i (1 - w)/(1 + w). Cells are numbered as in VTK; `top`,
    `base` and `symmetry` are sets of points.
    """
    half = round(FINE * elements_per_radius)
    deep = elements_per_radius
    size = 0.5 * CONTACT_RADIUS / elements_per_radius  # the map doubles lengths at the apex
    nx, ny, nz = 2 * half, half, deep
    block = {}
    points, cells = [], []
    for k in range(nz + 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                block[i, j, k] = len(points)
                points.append(((i - half) * size, j * size, k * size))

    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                cells.append([block[a, b, k + 1] for a, b in square] + [block[a, b, k] for a, b in square])

    # Shells grow ever faster, to cells as long as their distance allows.
    width = half * size
    radii, growth = [width], 1 + 1 / half
    while radii[-1] < 1:
        radii.append(radii[-1] * growth)
        growth = min(1.06 * growth, 1.4)
    radii = np.exp(np.log(width) * (1 - np.log(np.array(radii) / width) / np.log(radii[-1] / width)))

    faces = [[(0, j, k), (0, j + 1, k), (0, j + 1, k + 1), (0, j, k + 1)] for j in range(ny) for k in range(nz)]
    faces += [[(nx, j, k), (nx, j + 1, k), (nx, j + 1, k + 1), (nx, j, k + 1)] for j in range(ny) for k in range(nz)]
    faces += [[(i, ny, k), (i + 1, ny, k), (i + 1, ny, k + 1), (i, ny, k + 1)] for i in range(nx) for k in range(nz)]
    faces += [[(i, j, nz), (i + 1, j, nz), (i + 1, j + 1, nz), (i, j + 1, nz)] for i in range(nx) for j in range(ny)]
    rim = sorted({corner for face in faces for corner in face})
    inner = {corner: block[corner] for corner in rim}
    for radius in radii[1:]:
        # From box to ball while the radius triples: no sooner, or the corners would be drawn inwards.
        round_share = min(1.0, math.log(radius / width) / math.log(3))
        outer = {}
        for corner in rim:
            p = np.array(points[block[corner]])
            blend = (1 - round_share) * p / width + round_share * p / np.linalg.norm(p)
            outer[corner] = len(points)
            points.append(tuple(radius * blend))
        for face in faces:
            cells.append([inner[c] for c in face] + [outer[c] for c in face])
        inner = outer

    points = np.array(points)
    cells = np.array(cells)
    flat = np.isclose(points[:, 2], 0)
    symmetry = np.isclose(points[:, 1], 0)
    base = np.isclose(np.linalg.norm(points, axis=1), 1)

    distance = np.hypot(points[:, 0], points[:, 1])
    w = points[:, 2] + 1j * distance
    image = 1j * (1 - w) / (1 + w) * RADIUS
    turn = np.divide(image.real, distance, out=np.zeros_like(distance), where=distance > 0)
    mapped = np.column_stack([points[:, 0] * turn, points[:, 1] * turn, image.imag])
    mapped[symmetry, 1] = 0
    mapped[base, 2] = 0

    corner = mapped[cells]
    volume = np.einsum(
        "ij,ij->i", np.cross(corner[:, 1] - corner[:, 0], corner[:, 3] - corner[:, 0]), corner[:, 4] - corner[:, 0]
    )
    turned = volume < 0
    cells[turned] = cells[turned][:, [4, 5, 6, 7, 0, 1, 2, 3]]
    # No code should be given a tangled mesh.
    from_corner = [(0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7), (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3)]
    corner = mapped[cells]
    for o, a, b, c in from_corner:
        x = [corner[:, n] - corner[:, o] for n in (a, b, c)]
        assert (np.einsum("ij,ij->i", np.cross(x[0], x[1]), x[2]) > 0).all(), "tangled mesh"
    return mapped, cells, set(np.flatnonzero(flat)), set(np.flatnonzero(base)), set(np.flatnonzero(symmetry))


if __name__ == "__main__":
    import sys

    points, cells, top, base, symmetry = half_hemisphere(int(sys.argv[1]))
    print(len(points), "points", len(cells), "cells", len(top), len(base), len(symmetry))
    print("omega_0", DEPTH, "contact radius", CONTACT_RADIUS)
