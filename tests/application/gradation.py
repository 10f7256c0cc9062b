#!/usr/bin/env python3
"""A run follows the gradation table that it was given, and shows it.

    gradation.py SPALL

Drums of a few thousandths of a turn: a table with flat rows, one with a gap.
"""
import pathlib
import sys
import tempfile

from lab import spall_run, write_prm
from triaxial_runs import report_faults, rows, summary

DRUM = {
    "Case": {"kind": "los_angeles"},
    "Charge": {"mass": 20, "balls": 0, "shapes": ""},
    "Drum": {"radius": 0.5, "length": 0.8, "lifter_height": 0, "turns": 0.0005,
             "settling_time": 0},
}
FLAT = [(0.0001, 0), (0.020, 0), (0.025, 1), (0.0315, 1)]
GAP = [(0.004, 0), (0.008, 0.05), (0.04, 0.05), (0.0415, 1)]
# One sphere of 40 mm is 0.45 % of the gap-graded mass.
ONE_PARTICLE = 0.0045


def run_drum(spall, root, name, table):
    """Passing at each sieve, from the particles of the run."""
    (root / f"{name}.csv").write_text("diameter_m,passing_1\n" + "".join(
        f"{diameter},{passing}\n" for diameter, passing in table))
    case = write_prm(root / f"{name}.prm", DRUM | {
        "Charge": DRUM["Charge"] | {"gradation": f"{name}.csv"}})
    spall_run([spall, "run", case, "--out", root / name, "--threads", 1])
    particles = rows(root / name, "roundness_0s.csv")[1]
    mass = sum(particle["mass_kg"] for particle in particles)
    return [sum(particle["mass_kg"] for particle in particles
                if particle["diameter_m"] <= diameter * (1. + 1e-9)) / mass
            for diameter, _ in table]


def table_faults(folder, table, found):
    """gradation.csv, summary and log agree with the particles."""
    written = {row["diameter_m"]: row for row in rows(folder, "gradation.csv")[1]}
    faults = [f"{folder.name}: gradation.csv at {diameter} m: "
              f"{written.get(diameter)}, found {passing}"
              for (diameter, asked), passing in zip(table, found)
              if diameter in written and
              (abs(written[diameter]["obtained_passing_1"] - passing) > 1e-9 or
               abs(written[diameter]["asked_passing_1"] - asked) > 1e-9)]
    error = max(abs(row["obtained_passing_1"] - row["asked_passing_1"])
                for row in written.values())
    if abs(summary(folder)["gradation_error_1"] - error) > 1e-12:
        faults.append(f"{folder.name}: gradation_error_1 must be {error}")
    if "mass passing differs" not in (folder / "log.txt").read_text():
        faults.append(f"{folder.name}: no line on the gradation in the log")
    return faults


def follows_tables(spall, root):
    faults = []
    for name, table in (("flat", FLAT), ("gap", GAP)):
        found = run_drum(spall, root, name, table)
        faults += [f"{name}: {passing} passes {diameter} m, {asked} was asked"
                   for (diameter, asked), passing in zip(table, found)
                   if abs(passing - asked) > ONE_PARTICLE]
        faults += table_faults(root / name, table, found)
    if found[0] != 0.:
        faults.append(f"gap: {found[0]} passes the smallest sieve")
    spall_run([spall, "report", root / "gap"])
    if '<figure id="gradation">' not in (root / "gap" /
                                         "report.html").read_text():
        faults.append("the report does not show the gradation")
    return faults


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        sys.exit(report_faults(follows_tables(
            str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(name))))
