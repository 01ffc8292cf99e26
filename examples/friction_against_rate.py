#!/usr/bin/env python3
"""Friction against slip rate from a table: python3 friction_against_rate.py table.nc figure.png

Needs: pip install xarray netCDF4 matplotlib
"""
import sys

import matplotlib.pyplot as plt
import xarray as xr

table = xr.open_dataset(sys.argv[1])
done = table.where((table["status"] == 0) & (table["slip_rate"] > 0))
figure, axes = plt.subplots(layout="constrained")
for interference, marker in zip(table["interference"].values, "os^Dv*Px" * 9):
    row = done.sel(interference=interference)
    axes.errorbar(row["slip_rate"], row["mu"], row["mu_error"], marker=marker, capsize=3,
                  label=f"{interference:.3g} $\\omega_c$")
axes.set_xscale("log")
axes.set_xlabel(f"slip rate V ({table['slip_rate'].units})")
axes.set_ylabel(f"{table['mu'].long_name} (-)")
axes.legend()
figure.savefig(sys.argv[2])
