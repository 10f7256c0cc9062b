#!/usr/bin/env python3
"""The small dynamic triaxial test, flexible and rigid, against references.

    triaxial.py SPALL             compares, checks the run folders, reports
    triaxial.py SPALL --write     writes the references anew

A packing of a hundred particles is chaotic: one unit in the ninth digit of a
modulus changes what depends on the last position of single particles. So numbers of
the packing are compared widely, and what is a promise of the method (balance,
energy, rest, sums) is held to its own limit.
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

from report_pages import SECTIONS, page_faults
from run_views import view_faults
from slices import slice_faults
from triaxial_runs import (CASE, DATA, LATERALS, missing_frame_faults,
                           named_frames, report_faults, rows, run, summary)

# Key of summary.json: largest relative difference from the reference.
TOLERANCES = {
    "n_particles": 0.,            # drawn, not computed
    "n_breakable": 0.,         # likewise
    "time_step_s": 0.,         # given
    "cycles_1": 0.,            # given
    "exchange_gain_1": 1e-6,   # from masses and an iterated frequency (1e-8)
    "exchange_gain_limit_1": 1e-12,   # closed form
    "solid_volume_m3": 1e-3,   # quadrature, but for the little that breaks
    # Chaotic. Six runs whose modulus differed in the ninth digit spread by
    # 3.7 % in porosity, by a factor of 2.5 in permanent strain.
    "initial_porosity": 0.05,
}
STRAIN_FACTOR = 3.  # permanent strain, up or down, of its reference
# Residual of the external work. Four perturbed runs gave 4e-4 to 1.3e-3; work
# that was booked where a facet contact no longer was gave 2e-2.
LIMIT_MEMBRANE = 0.01

NETWORK = [
    ("coordination_number", "1"), ("mean_contact_force", "N"),
    ("strong_contact_share", "1"), ("force_chain_share", "1"),
    ("n_force_chains", "1"), ("force_chain_length", "1"),
    ("fabric_anisotropy", "1"), ("sliding_fraction", "1"),
    ("inside_axial_stress", "Pa"), ("wall_axial_stress", "Pa"),
    ("inside_lateral_stress", "Pa"), ("wall_lateral_stress", "Pa"),
    ("specimen_axial_stress", "Pa"), ("specimen_lateral_stress", "Pa"),
    ("membrane_axial_stress", "Pa"), ("membrane_lateral_stress", "Pa")]
AXES = [f"{what}_{axis}_{unit}" for what, unit in (("force", "N"),
                                                   ("moment", "Nm"))
        for axis in "xyz"]
BOUNDARIES = [f"{name}_{column}" for name in
              ("x_min", "x_max", "y_min", "y_max", "base", "plate")
              for column in [*AXES, "removed_mass_kg"]]
OF_MEMBRANE = [f"membrane_{column}"
               for column in [*AXES, "friction_J", "removed_mass_kg"]]
SLICES = "height_share_1,particle_1,spalled_1,loop_1,x_m,y_m"
HEADERS = {
    "history.csv":
        "time_s,stage_1,cycle_1,axial_stress_Pa,lateral_stress_Pa,"
        "axial_strain_1,volumetric_strain_1,laa_percent,"
        "coordination_number_1,mean_contact_force_N,roundness_1,n_contacts_1,"
        "n_events_1,unbalanced_force_ratio_1,external_work_J,kinetic_energy_J,"
        "elastic_energy_J,friction_dissipation_J,rolling_dissipation_J,"
        "damping_dissipation_J,breakage_energy_J,non_conservative_work_J,"
        "membrane_strain_energy_J,energy_residual_J,"
        "membrane_axial_stress_Pa,membrane_lateral_stress_Pa,"
        "porosity_1,overlap_over_radius_1,loading_stage_1,axial_target_Pa,"
        "lateral_target_Pa,x_stress_Pa,y_stress_Pa," +
        ",".join([*BOUNDARIES, *OF_MEMBRANE, "planes_friction_J"]),
    "events.csv":
        "time_s,cycle_1,particle_1,other_1,kind_1,mode_1,force_before_N,"
        "force_after_N,overlap_m,elastic_energy_J,fracture_energy_J,"
        "released_energy_J,removed_volume_m3,kernel_width_rad,depth_m,"
        "equivalent_radius_m",
    "ledger.csv":
        "time_s,work_given_J,work_taken_J,work_residual_1,"
        "impulse_given_x_Ns,impulse_given_y_Ns,impulse_given_z_Ns,"
        "impulse_taken_x_Ns,impulse_taken_y_Ns,impulse_taken_z_Ns,"
        "impulse_residual_1,gain_1,passes_1,gap_m,membrane_work_J,"
        "plate_work_J,energy_residual_J",
    "cycles.csv": ",".join(
        ["cycle_1", "time_s", "permanent_axial_strain_1",
         "permanent_volumetric_strain_1", "resilient_axial_strain_1",
         "resilient_modulus_Pa", "damping_ratio_1", "laa_percent",
         "roundness_1", "n_events_1", "friction_dissipation_J",
         "rolling_dissipation_J", "damping_dissipation_J",
         "breakage_energy_J", "external_work_J", "non_conservative_work_J",
         "energy_residual_J", "elastic_energy_J", "kinetic_energy_J",
         "membrane_strain_energy_J", "stands_for_1",
         *(f"{name}{when}_{unit}" for when in ("", "_peak")
           for name, unit in NETWORK),
         "loading_stage_1", "cycle_of_stage_1"]),
    "boundary_profile_end.csv":
        "distance_m,porosity_lateral_1,coordination_lateral_1,"
        "n_particles_lateral_1,porosity_platens_1,coordination_platens_1,"
        "n_particles_platens_1",
    "sections_end.csv": "height_share_1,section_m2",
    "slices_start.csv": SLICES,
    "slices_end.csv": SLICES,
}
DENSITY = 2750.  # kg/m^3, of the material file


def reference_faults(found, reference):
    faults = []
    for key, tolerance in TOLERANCES.items():
        if (key in found) != (key in reference):
            faults.append(f"{key}: in only one of summary and reference")
        elif key in found and (abs(found[key] - reference[key]) >
                               tolerance * abs(reference[key])):
            faults.append(f"{key} = {found[key]}: reference {reference[key]}, "
                          f"tolerance {tolerance} of it")
    ratio = (found["permanent_axial_strain_1"] /
             reference["permanent_axial_strain_1"])
    if not 1. / STRAIN_FACTOR < ratio < STRAIN_FACTOR:
        faults.append(f"permanent_axial_strain_1 is {ratio} of its reference")
    return faults


def promise_faults(found):
    """What holds for every packing."""
    is_membrane = found["lateral"] == "membrane"
    prepared = found["preparation"]
    worst = max(abs(stress / 30e3 - 1.) for stress in prepared["stress_Pa"])
    limits = {
        "stress against target": (worst, 0.02),  # as the case asks
        "unbalanced_force_ratio_1":
            (prepared["unbalanced_force_ratio_1"], 1e-3),  # likewise
        # Rigid: velocity Verlet, measured 6e-5 to 3e-4. Membrane: see
        # LIMIT_MEMBRANE.
        "energy_residual_ratio_1":
            (found["energy_residual_ratio_1"],
             LIMIT_MEMBRANE if is_membrane else 1e-3),
        # Events change loads between two steps, else round-off.
        "interface energy error":
            (found.get("interface", {}).get("work_residual_1", 0.), 1e-3),
        "interface impulse error":
            (found.get("interface", {}).get("impulse_residual_1", 0.), 1e-3),
        "exchange gain": (found.get("exchange_gain_1", 0.),
                          found.get("exchange_gain_limit_1", 1.)),
    }
    faults = [f"{name} = {value}: must be below {limit}"
              for name, (value, limit) in limits.items() if not value < limit]
    for key in ("interface", "exchange_gain_1"):
        if (key in found) != is_membrane:
            faults.append(f"{key}: only with a membrane, and always then")
    return faults


def file_faults(folder, found):
    """The run folder holds what it is to hold."""
    is_membrane = found["lateral"] == "membrane"
    faults = []
    for name, header in HEADERS.items():
        if not is_membrane:
            header = ",".join(column for column in header.split(",")
                              if column not in OF_MEMBRANE)
        if name == "ledger.csv" and not is_membrane:
            if (folder / name).exists():
                faults.append(f"{name} without a membrane")
        elif rows(folder, name)[0] != header:
            faults.append(f"{name}: header is {rows(folder, name)[0]}")
    if not (folder / "checkpoint" / "state.bin").is_file():
        faults.append("no checkpoint")
    faults += missing_frame_faults(folder)
    parts = {pathlib.Path(frame).name.split("_")[0]
             for frame in named_frames(folder)}
    if parts != {"particles", "contacts", "surfaces",
                 *(["membrane"] if is_membrane else [])}:
        faults.append(f"run.pvd names {sorted(parts)}")
    return faults


def row_faults(folder, found):
    """Sums over the rows are the numbers of the summary."""
    history, events = rows(folder, "history.csv")[1], \
        rows(folder, "events.csv")[1]
    last, faults = history[-1], []
    # Two decimal places of the double are lost in the sum of some thousand.
    initial_mass = DENSITY * (found["solid_volume_m3"] +
                              sum(e["removed_volume_m3"] for e in events))
    laa = 100. * DENSITY * sum(e["removed_volume_m3"]
                               for e in events) / initial_mass
    pairs = {
        "laa_percent, events": (found["laa_percent"], laa),
        "laa_percent, history": (found["laa_percent"], last["laa_percent"]),
        "n_events": (found["n_events"], len(events)),
        "cycle": (last["cycle_1"], found["cycles_1"]),
        "permanent strain": (last["axial_strain_1"],
                             found["permanent_axial_strain_1"]),
    }
    faults += [f"{name}: {a} is not {b}" for name, (a, b) in pairs.items()
               if not abs(a - b) <= 1e-9 * abs(b)]
    hits = [e for e in events if e["kind_1"] == 0.]
    if not hits:
        faults.append("no event of particle on particle")
    elif not (sum(e["force_after_N"] for e in hits) <
              sum(e["force_before_N"] for e in hits)):
        faults.append("breakage does not lower the force on average")
    times = [row["time_s"] for row in history]
    if times != sorted(times) or history[0]["stage_1"] != 0. \
            or last["stage_1"] != 2.:
        faults.append("history does not go from preparation to loading")
    if any(not 0. <= e["cycle_1"] <= found["cycles_1"] for e in events):
        faults.append("an event outside of the load cycles")
    return faults


def loop_of(points):
    """Resilient strain, modulus, damping ratio of (strain, stress) points."""
    strains = [strain for strain, _ in points]
    stresses = [stress for _, stress in points]
    top = strains.index(max(strains))
    resilient = max(strains) - min(strains[top:])
    cyclic = max(stresses) - min(stresses)
    closed = [*points, points[0]]
    area = sum(0.5 * (q + r) * (b - a)
               for (a, q), (b, r) in zip(closed, closed[1:]))
    return (resilient, cyclic / resilient if resilient else math.nan,
            2. * area / (math.pi * cyclic * resilient)
            if resilient else math.nan)


def cycle_faults(folder, found):
    """The cycles are what the history says, and the summary the last of them.
    """
    history = [row for row in rows(folder, "history.csv")[1]
               if row["stage_1"] == 2.]
    cycles, faults = rows(folder, "cycles.csv")[1], []
    if [row["cycle_1"] for row in cycles] != \
            [1. + k for k in range(round(found["cycles_1"]))]:
        return ["cycles.csv has not one row for each cycle"]
    for row in cycles:
        n = row["cycle_1"]
        part = [h for h in history if n - 1.001 < h["cycle_1"] < n + 0.001]
        resilient, modulus, ratio = loop_of(
            [(h["axial_strain_1"],
              h["axial_stress_Pa"] - h["lateral_stress_Pa"]) for h in part])
        first, last = part[0], part[-1]
        pairs = {
            "resilient_axial_strain_1": resilient,
            "resilient_modulus_Pa": modulus,
            "damping_ratio_1": ratio,
            "permanent_axial_strain_1": last["axial_strain_1"],
            "permanent_volumetric_strain_1": last["volumetric_strain_1"],
            "coordination_number_1": last["coordination_number_1"],
            "mean_contact_force_N": last["mean_contact_force_N"],
            "wall_axial_stress_Pa": last["axial_stress_Pa"],
            "n_events_1": last["n_events_1"] - first["n_events_1"],
        }
        pairs.update({key: last[key] - first[key] for key in (
            "friction_dissipation_J", "rolling_dissipation_J",
            "damping_dissipation_J", "external_work_J", "non_conservative_work_J")})
        pairs.update({key: last[key] for key in (
            "elastic_energy_J", "kinetic_energy_J",
            "membrane_strain_energy_J")})
        faults += [f"cycle {n}: {key} = {row[key]}, from the history {value}"
                   for key, value in pairs.items()
                   if not (math.isnan(row[key]) and math.isnan(value)) and
                   not abs(row[key] - value) <= 1e-9 * abs(value)]
        shares = [key for key in row if "share" in key or "fraction" in key]
        faults += [f"cycle {n}: {key} = {row[key]}" for key in shares
                   if not 0. < row[key] < 1.]
    for key in ("force_chain_share_1", "fabric_anisotropy_1",
                "sliding_fraction_1", "inside_axial_stress_Pa"):
        if found[key] != cycles[-1][key]:
            faults.append(f"{key}: not that of the last cycle")
    faults += [f"{key} = {found[key]}" for key in
               ("coordination_skin_1", "coordination_inside_1")
               if not 2. <= found[key] < 9.]
    # Between a dense packing with sizes and a loose one of single particles.
    if not 0.3 < found["porosity_inside_1"] < 0.55:
        faults.append(f"porosity inside {found['porosity_inside_1']}")
    return faults


def reread_faults(spall, folder):
    """The resolved case is a case."""
    ended = subprocess.run([spall, "check", str(folder / "case.prm")],
                           capture_output=True, text=True, check=False)
    return [] if ended.returncode == 0 else [
        f"case.prm does not read again: {ended.stderr}"]


def report_is_written(spall, folders, page):
    ended = subprocess.run(
        [spall, "report", *map(str, folders), "--out", str(page)],
        capture_output=True, text=True, check=False)
    if ended.returncode != 0 or not page.is_file():
        return [f"report: status {ended.returncode}: {ended.stderr}"]
    text = page.read_text()
    return [f"report does not say {lateral}" for lateral in LATERALS
            if lateral not in text] + page_faults(page, SECTIONS)


def check_faults(spall):
    """The step that is said is that of the loading: nodes, lighter than particles,
    limit it, to 0.14 of what particles stand here; in the preparation it is 0.8.
    """
    said = subprocess.run(
        [spall, "check", str(CASE), "--set", "Time/step=stable", "--set",
         "MembraneContact/normal_stiffness=1e8"],
        capture_output=True, text=True, check=False)
    found = re.search(r"time step\s+(\S+) s, stable up to (\S+) s", said.stdout)
    if not found:
        return [f"check: {said.stdout}{said.stderr}"]
    share = float(found[1]) / float(found[2])
    return [] if 0.1 < share < 0.2 else [f"check: {share} of the stable step"]


def write_reference(path, found):
    keys = [*TOLERANCES, "permanent_axial_strain_1"]
    path.write_text(json.dumps({key: found[key] for key in keys
                                if key in found}, indent=2) + "\n")


def main():
    spall = str(pathlib.Path(sys.argv[1]).resolve())
    faults = check_faults(spall)
    with tempfile.TemporaryDirectory() as name:
        folders = [pathlib.Path(name) / lateral for lateral in LATERALS]
        for folder, lateral in zip(folders, LATERALS):
            run(spall, folder, lateral)
            found = summary(folder)
            path = DATA / f"small_{lateral}.json"
            if "--write" in sys.argv:
                write_reference(path, found)
            found_faults = (
                reference_faults(found, json.loads(path.read_text())) +
                promise_faults(found) + file_faults(folder, found) +
                row_faults(folder, found) + cycle_faults(folder, found) +
                reread_faults(spall, folder) + view_faults(folder) +
                slice_faults(folder))
            faults += [f"{lateral}: {fault}" for fault in found_faults]
        faults += report_is_written(spall, folders,
                                    pathlib.Path(name) / "report.html")
    return report_faults(faults)


if __name__ == "__main__":
    sys.exit(main())
