"""Prints extremes of the body at each instant of `asperity run SCENE.toml -o run.nc --vtu DIR`.

    python examples/read_body.py DIR/body.pvd        needs: pip install meshio

A start for evaluations of one's own; ParaView opens the same file.
"""

import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import meshio
import numpy as np

collection = Path(sys.argv[1])
print("s/a0     mises (MPa)   plastic strain   T (K)     uz (um)")
for entry in xml.parse(collection).iter("DataSet"):
    body = meshio.read(collection.parent / entry.get("file"))
    fields = body.point_data

    # (xx, yy, zz, xy, yz, xz): von Mises' stress is the one in the file.
    xx, yy, zz, xy, yz, xz = fields["stress"].T
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    mises = np.sqrt(0.5 * normal + 3 * (xy**2 + yz**2 + xz**2))
    assert np.allclose(mises, fields["von_mises_stress"], rtol=1e-9)

    print(
        f"{float(entry.get('timestep')):<8.3f} {mises.max() / 1e6:<13.1f} "
        f"{fields['plastic_strain'].max():<16.4f} {fields['temperature'].max():<9.1f} "
        f"{fields['displacement'][:, 2].min() * 1e6:.3f}"
    )
