#!/usr/bin/env python3
"""Triaxial compression of a small specimen of spheres, rigid sides.

    compression.py SPALL

The plate goes as far as asked at an even rate, the sides keep their stress, and
the energies close.
"""
import pathlib
import sys
import tempfile

from triaxial_runs import report_faults, rows, run, summary

CONFINEMENT = 30e3  # Pa
STRAIN = 0.03
SETTINGS = ("Loading/form=compression", f"Loading/final_strain={STRAIN}",
            "Loading/strain_rate=1", f"Loading/confining_pressure={CONFINEMENT}",
            "Specimen/shapes=", "Contact/geometry=sphere",
            "Breakage/is_active=false", "Output/samples_per_cycle=200",
            "Time/step=stable")


def faults(folder):
    found = []
    result = summary(folder)
    _, table = rows(folder, "history.csv")
    loading = [row for row in table if row["stage_1"] >= 2.]
    last = loading[-1]
    if abs(last["axial_strain_1"] / STRAIN - 1.) > 1e-3:
        found.append(f"went to a strain of {last['axial_strain_1']}")
    middle = loading[len(loading) // 2]
    # A hundredth of the time is spent on getting up to speed.
    if abs(middle["axial_strain_1"] / STRAIN - 0.495 / 0.995) > 5e-3:
        found.append(f"strain {middle['axial_strain_1']} after half the time")
    mean = sum(row["lateral_stress_Pa"] for row in loading) / len(loading)
    if abs(mean / CONFINEMENT - 1.) > 0.05:
        found.append(f"lateral stress {mean} Pa")
    if result["energy_residual_ratio_1"] > 2e-3:
        found.append(f"energy residual {result['energy_residual_ratio_1']}")
    if result["peak_axial_stress_Pa"] != max(row["axial_stress_Pa"]
                                             for row in loading):
        found.append("peak stress is not that of the history")
    # A frictional assembly: sigma_1 / sigma_3 of 2 to 6 at these strains.
    ratio = last["axial_stress_Pa"] / last["lateral_stress_Pa"]
    if not 1.5 < ratio < 7.:
        found.append(f"stress ratio {ratio}")
    return found


def main():
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "run"
        run(sys.argv[1], folder, "rigid", settings=SETTINGS)
        raise SystemExit(report_faults(faults(folder)))


if __name__ == "__main__":
    main()
