#!/usr/bin/env python3
"""Triaxial compression of a small specimen of spheres, rigid sides.

    compression.py SPALL

The plate goes as far as asked at an even rate, the sides keep their stress, the
energies close, and strength and inertial number are those of the tables.
"""
import csv
import math
import pathlib
import re
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


def strength(row):
    """q, q / p and mobilised friction angle (degrees) of a row."""
    axial, lateral = row["axial_stress_Pa"], row["lateral_stress_Pa"]
    q = axial - lateral
    return (q, 3. * q / (axial + 2. * lateral),
            math.degrees(math.asin(q / (axial + lateral))))


def inertial_number(folder):
    """From the particles of the run; their density is that of the case."""
    with open(folder / "particles.csv", newline="") as file:
        radii = [float(row["radius"]) for row in csv.DictReader(file)]
    case = (folder / "case.prm").read_text()
    density = float(re.search(r"subsection Particle.*?set density = (\S+)",
                              case, re.DOTALL).group(1))
    mean = 2. * sum(radii) / len(radii)
    return mean * math.sqrt(density / CONFINEMENT)  # at a rate of 1/s


def strength_faults(folder, result, loading):
    at_peak = max(loading, key=lambda row: strength(row)[0])
    peaks = [max(strength(row)[k] for row in loading) for k in range(3)]
    for key, expected in (
            ("peak_deviatoric_stress_Pa", peaks[0]),
            ("axial_strain_at_peak_1", at_peak["axial_strain_1"]),
            ("peak_stress_ratio_1", peaks[1]),
            ("peak_friction_angle_deg", peaks[2]),
            ("inertial_number_1", inertial_number(folder))):
        if abs(result[key] / expected - 1.) > 1e-9:
            yield f"{key} = {result[key]}, expected {expected}"


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
    found += strength_faults(folder, result, loading)
    for at, row in (("start", loading[0]), ("end", last)):
        void_ratio = row["porosity_1"] / (1. - row["porosity_1"])
        if abs(result[f"void_ratio_{at}_1"] / void_ratio - 1.) > 1e-9:
            found.append(f"void ratio at the {at} is not {void_ratio}")
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
