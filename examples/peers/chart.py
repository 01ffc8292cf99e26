#!/usr/bin/env python3
"""Draws error against processor time from what compare.py --rows has written.

    chart.py rows.jsonl figure.svg

Errors are those of load and area after the slide against the limit that asperity's own meshes show
(Richardson's extrapolation of the two finest, order 1.5). asperity presses in full stick and the others with
the friction of the slide, so that their limits differ by some tenths of a per cent: below that, the curves of
the others say nothing. Marks have the number of elements, those of the others also that of increments. Runs that were
stopped are arrows. Needs matplotlib.
"""
import json
import sys

import matplotlib.pyplot as plt

rows = [json.loads(line) for line in open(sys.argv[1])]
runs, stopped = {}, []
for row in rows:
    if row.get("finished"):
        runs.setdefault(row["code"], {})[row["elements"], row.get("increments", 0)] = row
    elif row["stopped"]:
        stopped.append(row)
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
            panel.annotate(label, (x, y), xytext=(5, 4), textcoords="offset points", fontsize=8)
    # Runs that were stopped have a time, and no error.
    for code in sorted({row["code"] for row in stopped}):
        ended = sorted((row["elements"], row["seconds"]) for row in stopped if row["code"] == code)
        for _, seconds in ended:
            panel.plot(seconds, 0.06, marker=">", color="gray", transform=panel.get_xaxis_transform())
        sizes = ", ".join(str(elements) for elements, _ in ended)
        panel.annotate(f"{NAMES[code]}: {sizes} stopped", (ended[0][1], 0.06), xytext=(0, 7),
                       xycoords=panel.get_xaxis_transform(), textcoords="offset points", fontsize=7,
                       rotation=90, ha="center", va="bottom", color="gray")  # fmt: skip
    panel.set_title(title)
    panel.set_xlabel("processor time (s)")
    panel.grid(True, which="major", alpha=0.3)
axes[0].set_ylabel("error (%)")
axes[0].legend(frameon=False)
figure.savefig(sys.argv[2])
