#!/usr/bin/env python3
"""The template of the dynamic triaxial test, small: its specimens come to rest.

    templates.py SPALL [Section/key=value ...]
"""
import pathlib
import subprocess
import sys
import tempfile

from triaxial_runs import DATA, ENVIRONMENT, report_faults, summary

# Some tens of stones, a longer step for softer walls, and one short cycle
# between rigid sides: shapes, laws and targets are the template's.
SMALL = (f"Specimen/gradation={DATA / 'small_gradation.csv'}",
         "Specimen/side=0.04", "Specimen/diameter=0.04", "Specimen/height=0.05",
         "Wall/normal_stiffness=1e7", "Wall/shear_stiffness=0.85e7",
         "Time/fixed_step=2e-6", "Boundary/lateral=rigid",
         "Loading/frequency=1000", "Loading/cycles=1",
         "Loading/consolidation_time=0", "Output/frames_per_cycle=0")


def run_faults(spall, root, form, settings):
    folder = root / form
    words = [spall, "run", str(root / "case.prm"), "--out", str(folder),
             "--threads", "1"]
    for setting in (*SMALL, f"Specimen/form={form}", *settings):
        words += ["--set", setting]
    ended = subprocess.run(words, capture_output=True, text=True, timeout=900,
                           check=False, env=ENVIRONMENT)
    if ended.returncode != 0:
        return [f"{form}: status {ended.returncode}: {ended.stderr}"]
    ratio = summary(folder)["preparation"]["unbalanced_force_ratio_1"]
    return [] if ratio <= 1e-3 else [f"{form}: unbalanced ratio {ratio}"]


def main():
    spall = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        printed = subprocess.run([spall, "template", "dynamic_triaxial"],
                                 capture_output=True, text=True, check=True)
        (root / "case.prm").write_text(printed.stdout)
        faults = [fault for form in ("box", "cylinder")
                  for fault in run_faults(spall, root, form, sys.argv[2:])]
    return report_faults(faults)


if __name__ == "__main__":
    sys.exit(main())
