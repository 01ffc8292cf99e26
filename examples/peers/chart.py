#!/usr/bin/env python3
"""Draws error against processor time from what compare.py --rows has written.

    chart.py rows.jsonl figure.svg

Errors are those of load and area after the slide against the limit that asperity's own meshes show
(Richardson's extrapolation of the two finest, order 1.5). asperity presses in full stick and the others with
the friction of the slide, so that their limits differ by some tenths of a per cent: below that, the curves of
the others say nothing. Marks have the number of elements, those of the others also that of increments. Needs matplotlib.
"""
import json
import sys

import matplotlib.pyplot as plt

rows = [json.loads(line) for line in open(sys.argv[1])]
runs = {}
for row in rows:
    if row.get("finished"):
        runs.setdefault(row["code"], {})[row["elements"], row.get("increments", 0)] = row
ours = {elements: row for (elements, _), row in runs["asperity"].items()}
coarse, fine = sorted(ours)[-2:]


def limit(name):
    gain = (fine / coarse) ** 1.5
    return (gain * ours[fine][name] - ours[coarse][name]) / (gain - 1.0)


NAMES = {"asperity": "asperity, main run", "calculix": "CalculiX 2.20", "getfem": "GetFEM 5.4"}
figure, axes = plt.subplots(1, 2, figsize=(8, 3.6), layout="constrained", sharey=True, sharex=True)
for panel, name, title in zip(axes, ("P", "A"), ("load", "contact area")):
    exact = limit(name)
    for code, marker, style in (("asperity", "o", "-"), ("calculix", "s", ""), ("getfem", "^", "")):
        done = [row for _, row in sorted(runs.get(code, {}).items()) if row["elements"] != fine or code != "asperity"]
        done = [row for row in done if row.get(name) is not None]
        if not done:
            continue
        seconds = [row["seconds"] * row.get("main", 1.0) for row in done]
        errors = [100 * abs(row[name] / exact - 1) for row in done]
        panel.loglog(seconds, errors, marker=marker, linestyle=style, color="black", markerfacecolor="white",
                     label=NAMES[code])
        for row, x, y in zip(done, seconds, errors):
            label = f"{row['elements']}, {row['increments']}" if "increments" in row else row["elements"]
            beside = (-9, -24) if code == "getfem" else (2, 5)
            panel.annotate(label, (x, y), xytext=beside, textcoords="offset points", fontsize=7, rotation=60)
    panel.margins(x=0.1, y=0.12)
    panel.set_title(title)
    panel.set_xlabel("processor time (s)")
    panel.grid(True, which="major", alpha=0.3)
axes[0].set_ylabel("error (%)")
axes[0].legend(frameon=False, loc="upper left", bbox_to_anchor=(0.0, 0.99))
figure.savefig(sys.argv[2])
