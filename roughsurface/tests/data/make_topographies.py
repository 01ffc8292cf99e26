"""Topographies in every format and what SurfaceTopography says about them.

    pip install SurfaceTopography==1.27.1 sdfio==2.0.0
    python3 make_topographies.py

writes the files beside it. The numbers in reference.json are computed by SurfaceTopography alone:
its readers, its detrending, its filter, its Fourier derivatives.
"""

import json

import numpy as np
import sdfio
import SurfaceTopography
from SurfaceTopography import Topography, UniformLineScan, read_topography
from SurfaceTopography.Generation import fourier_synthesis

np.random.seed(7)
N, LENGTH = 64, 12.8  # points a side, um
PIXEL = LENGTH / N
CUTOFF = 8 * PIXEL  # um

periodic = fourier_synthesis((N, N), (LENGTH, LENGTH), 0.8, rms_slope=0.1, long_cutoff=LENGTH / 4,
                             unit="um")
heights = periodic.heights()
periodic.to_netcdf("periodic.nc")

# What an instrument gives: a tilted map that does not continue.
x, y = periodic.positions()
tilted = Topography(heights + 0.02 * x - 0.05 * y + 3.0, (LENGTH, LENGTH), unit="um")
tilted.to_netcdf("map.nc")
tilted.to_x3p("map.x3p")
tilted.to_x3p("map-int16.x3p", dtype="I")
of_16_bits = sdfio.Metadata(revision=sdfio.Revision.ISO_1_0, data_type=sdfio.DataType.INT16)
sdfio.write("map-int16.sdf", tilted.heights().T * 1e-6, x_scale=PIXEL * 1e-6, y_scale=PIXEL * 1e-6, metadata=of_16_bits)
np.savetxt("map-um.txt", tilted.heights().T, fmt="%.7e")
np.save("map-um.npy", tilted.heights().T.astype("<f4"))
rows = [(px, py, pz) for px, py, pz in zip(x.ravel(), y.ravel(), tilted.heights().ravel())]
np.savetxt("map-xyz-um.txt", rows, fmt="%.7e")

# Gwyddion Simple Field, after the Gwyddion user guide: rows from the top.
header = (f"Gwyddion Simple Field 1.0\nXRes = {N}\nYRes = {N}\nXReal = {LENGTH * 1e-6:.10e}\n"
          f"YReal = {LENGTH * 1e-6:.10e}\nXYUnits = m\nZUnits = m\n").encode()
with open("map.gsf", "wb") as file:
    file.write(header + b"\0" * (4 - len(header) % 4))
    file.write((tilted.heights().T * 1e-6).astype("<f4").tobytes())

profile = UniformLineScan(tilted.heights()[:, 5], LENGTH, unit="um")
profile.to_netcdf("profile.nc")
np.savetxt("profile-um.txt", np.column_stack([np.arange(N) * PIXEL, profile.heights()]), fmt="%.7e")


def gaussian(q):
    """Gaussian filter of ISO 16610: one half at the cut-off."""
    return np.exp(-np.log(2) * (CUTOFF * q / (2 * np.pi)) ** 2)


def moments(topography):
    """m0, m2, m4 in SI of a topography taken as periodic, after the filter: SurfaceTopography's
    moments of the power spectrum, of |grad z|^2 and (laplacian z)^2 for maps."""
    isotropic = {"isotropic": True} if topography.dim == 2 else {}
    filtered = topography.filter(filter_function=gaussian, **isotropic)
    share = (1, 1 / 2, 3 / 8) if topography.dim == 2 else (1, 1, 1)
    m = [share[n] * filtered.moment_power_spectrum(2 * n, reliable=False) for n in range(3)]
    return {"m0": m[0] * 1e-12, "m2": m[1], "m4": m[2] * 1e12}


def as_periodic(topography):
    sizes = topography.physical_sizes
    kind = Topography if topography.dim == 2 else UniformLineScan
    sizes = sizes if topography.dim == 2 else sizes[0]
    return kind(topography.heights(), sizes, periodic=True, unit="um")


reference = {"version": SurfaceTopography.__version__, "cutoff": CUTOFF * 1e-6}
for name in ["periodic.nc", "map.nc", "map.x3p", "map-int16.x3p", "profile.nc"]:
    read = read_topography(name)
    read = read.to_unit("um") if hasattr(read, "to_unit") else read
    flat = read.detrend("center" if read.is_periodic else "height")
    flat = as_periodic(flat)
    rms = flat.rms_height_from_area() if flat.dim == 2 else flat.rms_height_from_profile()
    reference[name] = {"rms_height": rms * 1e-6, **moments(flat)}
with open("reference.json", "w") as file:
    json.dump(reference, file, indent=1)
