#!/usr/bin/env python3
"""The small triaxial test with true surfaces and no rolling resistance.

    surfaces.py SPALL rigid|periodic|membrane

It comes to rest, keeps its energy, and gives the same digits with one thread
and with two.
"""
import pathlib
import sys
import tempfile

from triaxial_runs import rows, run, summary

SURFACES = ("Contact/geometry=surface", "Contact/wall_geometry=surface",
            "Particle/rolling_friction=0", "Breakage/is_active=false",
            # A particle has several contact points on a wall: a stiffer mount.
            "Time/fixed_step=7e-7",
            # Surfaces must not overlap in the cloud.
            "Specimen/initial_solid_fraction=0.12",
            "Loading/frequency=200", "Loading/cycles=1")
# A membrane pressed round particles lets them rest. Where the deepest face alone
# carried a particle the ratio stayed at 2e-3 to 4e-3.
REST = ("Loading/consolidation_unbalanced_ratio=5e-4",
        "Loading/consolidation_max_time=0.08")


def faults(folder):
    found = []
    result = summary(folder)
    # Second order in the step: 1e-5 was found.
    if result["energy_residual_ratio_1"] > 1e-3:
        found.append(f"energy residual {result['energy_residual_ratio_1']}")
    if result["preparation"]["unbalanced_force_ratio_1"] > 1e-3:
        found.append("not at rest")
    _, table = rows(folder, "history.csv")
    last = table[-1]
    # With radii along the branch it is some per cent.
    share = abs(last["non_conservative_work_J"]) / last["external_work_J"]
    if share > 5e-3:
        found.append(f"non-conservative work is {share} of the external work")
    # A hundred particles, those without a load counted too: 3.0 to 3.8 was found
    # over nine seeds.
    if not 2.5 < result["coordination_start_1"] < 6.:
        found.append(f"coordination {result['coordination_start_1']}")
    if "contact_point_events" not in result:
        found.append("no entry contact_point_events")
    return found


def main():
    settings = SURFACES + (REST if sys.argv[2] == "membrane" else ())
    with tempfile.TemporaryDirectory() as scratch:
        folders = [pathlib.Path(scratch) / name for name in ("one", "two")]
        for threads, folder in enumerate(folders, start=1):
            run(sys.argv[1], folder, sys.argv[2], settings=settings,
                threads=threads)
        found = faults(folders[0])
        texts = [(folder / "history.csv").read_text() for folder in folders]
        if texts[0] != texts[1]:
            found.append("two threads give other digits")
    for fault in found:
        print(fault)
    if found:
        raise SystemExit("failed")


if __name__ == "__main__":
    main()
