#!/usr/bin/env python3
"""Friction of spheres fitted to tests of ballast.

    ballast_calibration.py [FOLDER]     default runs/ballast_calibration

Measured is the permanent axial strain of ballast at 60 kPa under 230 kPa at
60 Hz after the first and the tenth cycle, from data/reference. The specimens
are cubes of ninety spheres, far too few for a statement on ballast: the example
shows how a calibration goes. What has been run is taken from the folder.
"""
import csv
import pathlib
import sys

import spall
from first_run import small_case

ROOT = pathlib.Path(__file__).resolve().parents[3]
MEASURED = ROOT / "data" / "reference" / "ballast_strain.csv"
FREQUENCY, PRESSURE = 60.0, 60e3  # Hz, Pa


def measured_strain(last_cycle):
    """Cycle -> permanent axial strain [1]."""
    with open(MEASURED, newline="", encoding="utf-8") as file:
        return {float(row["cycle_1"]): float(row["axial_strain_1"])
                for row in csv.DictReader(file)
                if float(row["Loading/frequency"]) == FREQUENCY
                and float(row["Loading/confining_pressure"]) == PRESSURE
                and float(row["cycle_1"]) <= last_cycle}


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else "runs/ballast_calibration"
    case = small_case()
    case["Output/surfaces"] = "none"
    # Read off plots to about 0.1 % of strain.
    target = spall.Curve("cycle", "permanent_axial_strain",
                         measured_strain(10), deviation=0.001)
    found = spall.calibrate(
        case, target, {"Particle/friction": (0.2, 0.5, 0.8)},
        seeds=(1, 2, 3), folder=folder, step=0.15, tolerance=0.05,
        max_sets=15, jobs=2, progress=print)
    print(found)
    for cycle, measured, computed, spread in zip(
            target.points, found.measured, found.computed,
            found.seed_deviation):
        print(f"cycle {cycle:.0f}: measured {100 * measured:.2f} %, computed "
              f"{100 * computed:.2f} ± {100 * spread:.2f} %")


if __name__ == "__main__":
    main()
