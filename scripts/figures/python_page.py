#!/usr/bin/env python3
"""Figures of docs/user/python.md from the runs of its examples.

    PYTHONPATH=apps/python python_page.py RUNS CALIBRATION [OUT]

RUNS is the folder of apps/python/examples/first_run.py, CALIBRATION that of
apps/python/examples/ballast_calibration.py; figures go to docs/pictures/python.
"""
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as pyplot  # noqa: E402
import numpy as np  # noqa: E402

import spall  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "apps" / "python" / "examples"))
from ballast_calibration import measured_strain  # noqa: E402

# Greys that are legible on white and on black.
GREY = "#808080"
STYLE = {"svg.fonttype": "none", "svg.hashsalt": "spall", "font.size": 10,
         "text.color": GREY, "axes.labelcolor": GREY, "axes.edgecolor": GREY,
         "xtick.color": GREY, "ytick.color": GREY, "axes.facecolor": "none",
         "figure.facecolor": "none", "savefig.facecolor": "none",
         "legend.frameon": False, "figure.figsize": (5.6, 3.6),
         "path.simplify_threshold": 0.5}


def save(axes, path):
    axes.figure.savefig(path, metadata={"Date": None})
    pyplot.close(axes.figure)
    # Without blanks at line ends.
    path.write_text("\n".join(line.rstrip() for line in
                              path.read_text().splitlines()) + "\n")


def calibration_chart(folder):
    """Strain over cycles of the lowest, the best and the highest friction."""
    sets = spall.Table.read(folder / "sets.csv")
    name = "Particle/friction"
    best = sets[name][np.argmin(sets["residual"])]
    runs = [spall.Run(path.parent)
            for path in sorted(folder.glob("set_*/seed_*/summary.json"))]
    axes = pyplot.subplots(layout="constrained")[1]
    for value, colour in ((sets[name].min(), "#b45f06"), (best, "#3d85c6"),
                          (sets[name].max(), "#6aa84f")):
        chosen = [run for run in runs if run.case[name] == value]
        for k, run in enumerate(chosen):
            axes.semilogx(run.cycles["cycle"],
                          100 * run.cycles["permanent_axial_strain"],
                          color=colour, linewidth=1,
                          label=None if k else f"friction {value:.2f}")
    points = measured_strain(10)
    axes.plot(points.keys(), [100 * one for one in points.values()], "o",
              color=GREY, label="measured")
    axes.set_xticks([1, 2, 5, 10], ["1", "2", "5", "10"], minor=False)
    axes.minorticks_off()
    axes.set_xlabel("Load cycle")
    axes.set_ylabel("Permanent axial strain (%)")
    axes.legend()
    return axes


def main():
    runs, calibration = map(pathlib.Path, sys.argv[1:3])
    out = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else \
        ROOT / "docs" / "pictures" / "python"
    out.mkdir(parents=True, exist_ok=True)
    with pyplot.rc_context(STYLE):
        save(spall.Run(runs / "rolling_0.5").plot.loops(cycles=[1, 2, 10]),
             out / "loops.svg")
        save(calibration_chart(calibration), out / "calibration.svg")


if __name__ == "__main__":
    main()
