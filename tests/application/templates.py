#!/usr/bin/env python3
"""The templates, made small: they run to their end, and specimens of the
dynamic triaxial test come to rest.

    templates.py SPALL [Section/key=value ...]
"""
import pathlib
import subprocess
import sys
import tempfile

from compaction import SMALL as COMPACTION
from lab import CUBE, DRUM
from subgrade import SCENE
from triaxial_runs import DATA, ENVIRONMENT, report_faults, summary

# Some tens of particles, a longer step for softer walls, and one short cycle
# between rigid sides: shapes, laws and targets are the template's.
TRIAXIAL = (f"Specimen/gradation={DATA / 'small_gradation.csv'}",
            "Specimen/side=0.04", "Specimen/diameter=0.04",
            "Specimen/height=0.05", "Wall/normal_stiffness=1e7",
            "Wall/shear_stiffness=0.85e7", "Time/fixed_step=2e-6",
            "Boundary/lateral=rigid", "Loading/frequency=1000",
            "Loading/cycles=1", "Loading/consolidation_time=0",
            "Output/frames_per_cycle=0")
# Sizes and loads of the small cases of other tests.
OTHERS = {"single_particle": CUBE, "los_angeles": DRUM,
          "vibratory_compaction": COMPACTION, "subgrade": SCENE}


def run(spall, root, kind, name, settings):
    """Summary of a run of the template; None and what it said if it failed."""
    printed = subprocess.run([spall, "template", kind], capture_output=True,
                             text=True, check=True)
    case = root / f"{kind}.prm"
    case.write_text(printed.stdout)
    words = [spall, "run", case, "--out", root / name, "--threads", 1]
    for setting in settings:
        words += ["--set", setting]
    ended = subprocess.run(list(map(str, words)), capture_output=True,
                           text=True, timeout=900, check=False,
                           env=ENVIRONMENT)
    if ended.returncode != 0:
        return None, f"{name}: status {ended.returncode}: {ended.stderr}"
    return summary(root / name), ""


def triaxial_faults(spall, root, settings):
    for form in ("box", "cylinder"):
        found, said = run(spall, root, "dynamic_triaxial", form,
                          (*TRIAXIAL, f"Specimen/form={form}", *settings))
        ratio = found and found["preparation"]["unbalanced_force_ratio_1"]
        if not found:
            yield said
        elif ratio > 1e-3:
            yield f"{form}: unbalanced ratio {ratio}"


def other_faults(spall, root, settings):
    (root / "particles.csv").write_text(
        "diameter_m,passing_1\n0.016,0\n0.028,1\n")
    for kind, sections in OTHERS.items():
        small = [f"{section}/{key}={value}"
                 for section, entries in sections.items() if section != "Case"
                 for key, value in entries.items()]
        found, said = run(spall, root, kind, kind, (*small, *settings))
        if not found:
            yield said
        elif not found["is_complete"]:
            yield f"{kind}: not complete"


def main():
    spall, settings = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2:]
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        faults = [*triaxial_faults(spall, root, settings),
                  *other_faults(spall, root, settings)]
    return report_faults(faults)


if __name__ == "__main__":
    sys.exit(main())
