#!/usr/bin/env python3
"""What true surfaces cost in a membrane: a case with `radial` and spheres on the
membrane, and with true surfaces on everything, at equal steps.

    surface_price.py PROGRAM [--before PROGRAM] [--case CASE.prm] [--repeat N]
                     [--set Section/key=value ...]

The runs go in turn, so that a slow minute of the machine falls on all. Each
packs its specimen once; times are milliseconds of a step after the preparation,
on one thread, by what the steps do (rows and files are left out).
"""
import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import tempfile

from bench_runs import spread, table

ROOT = pathlib.Path(__file__).resolve().parents[2]
QUICK = ROOT / "data" / "cases" / "dynamic_triaxial_quick.prm"
PHASES = ("contacts", "search", "motion", "bodies", "guards", "transfer")
# Ten milliseconds at the confinement, then a fast cycle.
SETTINGS = ("Time/fixed_step=1e-6", "Loading/cycles=1", "Loading/frequency=200",
            "Loading/consolidation_time=0.01",
            "Loading/consolidation_stress_tolerance=0.5",
            "Loading/consolidation_unbalanced_ratio=0.1",
            "Time/allow_unstable_step=true")
GEOMETRIES = {
    "radial": ("Contact/geometry=radial", "Contact/wall_geometry=sphere"),
    "surface": ("Contact/geometry=surface", "Contact/wall_geometry=surface"),
}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--before", type=pathlib.Path)
    parser.add_argument("--case", type=pathlib.Path, default=QUICK)
    parser.add_argument("--repeat", type=int, default=2)
    parser.add_argument("--set", action="append", default=[])
    return parser.parse_args()


def run(program, options, geometry, folder):
    """Milliseconds of a step by phase."""
    words = [program, "run", options.case, "--out", folder / "run",
             "--overwrite", "--threads", 1, "--preparations", folder / "kept"]
    for setting in (*SETTINGS, *GEOMETRIES[geometry], *options.set):
        words += ["--set", setting]
    subprocess.run(list(map(str, words)), check=True,
                   stdout=subprocess.DEVNULL)
    summary = json.loads((folder / "run" / "summary.json").read_text())
    clock = summary["wall_clock_s"]
    with open(folder / "run" / "history.csv") as rows:
        times = [float(row["time_s"]) for row in csv.DictReader(rows)
                 if row["stage_1"] != "0"]
    n_steps = (times[-1] - times[0]) / summary["time_step_s"]
    return {phase: 1e3 * clock[phase] / n_steps for phase in PHASES}


def main():
    options = arguments()
    programs = {"now": options.program.resolve()}
    if options.before:
        programs["before"] = options.before.resolve()
    found = {(version, geometry): []
             for version in programs for geometry in GEOMETRIES}
    with tempfile.TemporaryDirectory() as name:
        for _ in range(options.repeat):
            for (version, geometry), runs in found.items():
                folder = pathlib.Path(name) / version / geometry
                folder.mkdir(parents=True, exist_ok=True)
                runs.append(run(programs[version], options, geometry, folder))
    rows = []
    for (version, geometry), runs in found.items():
        base = [sum(one.values()) for one in found[version, "radial"]]
        ratios = [sum(one.values()) / of for one, of in zip(runs, base)]
        middle = statistics.median(ratios)
        rows.append([version, geometry,
                     *(f"{statistics.median(one[phase] for one in runs):.3f}"
                       for phase in PHASES),
                     f"{statistics.median(sum(one.values()) for one in runs):.3f}",
                     f"{middle:.2f} ± {middle * spread(ratios):.2f}"])
    print(table(["version", "contacts of", *PHASES, "ms per step",
                 "to radial"], rows))


if __name__ == "__main__":
    main()
