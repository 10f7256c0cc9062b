#!/usr/bin/env python3
"""A small triaxial test: set, run, read (docs/user/python.md).

    first_run.py [FOLDER]      runs are written there, default runs/python
"""
import pathlib
import sys

import spall


def small_case():
    """Ninety spheres between rigid sides under ten load cycles."""
    case = spall.Case.from_template("dynamic_triaxial", preset="fast")
    case.update({
        "Case/title": "Ninety spheres under ten load cycles",
        "Specimen/side": 0.05,                     # m
        "Specimen/solid_fraction": 0.6,
        "Specimen/initial_solid_fraction": 0.2,
        "Specimen/gradation": "gradations/narrow_10_14mm.csv",
        "Specimen/shapes": "",                     # spheres
        "Preparation/pressure": 60e3,              # Pa
        "Preparation/friction": 0.1,
        "Preparation/stress_tolerance": 0.02,
        "Wall/normal_stiffness": 2e6,              # N/m
        "Wall/shear_stiffness": 1.7e6,
        "Breakage/is_active": False,
        "Boundary/lateral": "rigid",
        "Boundary/plate_mass": 0.1,                # kg, half of the spheres'
        "Loading/confining_pressure": 60e3,        # Pa
        "Loading/amplitude": 230e3,
        "Loading/frequency": 60,                   # Hz
        "Loading/cycles": 10,
        "CycleJump/tolerance": 0,                  # every cycle
        "Output/surfaces": "ends",
        "Output/frames_per_cycle": 0,
    })
    return case


def show(step):
    """A line of progress."""
    left = "" if step.seconds_left is None else f", {step.seconds_left:.0f} s"
    print(f"{step.phase}: {100 * step.share:.0f} %{left}")


def run_case(case, folder):
    """The run of the folder; made if it is not there."""
    if (folder / "summary.json").exists():
        return spall.Run(folder)
    return case.run(folder, progress=show, overwrite=True)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "runs/python")
    case = small_case()
    runs = []
    for friction in (0.1, 0.5):
        case["Particle/rolling_friction"] = friction
        runs.append(run_case(case, folder / f"rolling_{friction}"))
    for run in runs:
        strain = 100 * run.cycles["permanent_axial_strain"]
        print(f"{run.name}: {strain[0]:.2f} % after the first cycle, "
              f"{strain[-1]:.2f} % after the tenth")
    compared = spall.compare(runs)
    print("differ in", *compared.differences)
    particles = runs[0].particles()
    print(f"{particles.n_rows} particles of "
          f"{particles['mass'].sum():.3f} {particles.unit('mass')}")
    runs[0].write_mesh(-1, folder / "specimen.stl", scale=1000)


if __name__ == "__main__":
    main()
