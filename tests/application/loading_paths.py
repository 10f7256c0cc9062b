#!/usr/bin/env python3
"""Loading paths of small specimens of spheres against their closed forms.

    loading_paths.py SPALL rigid|membrane
    loading_paths.py SPALL restart

Every stage has the length, the targets and the end that its row asks for, and
plate and sides follow the targets. A path of one haversine has the bits of its
short form. A run that was stopped, and one whose path has become longer, have
those of the unbroken run.
"""
import math
import pathlib
import subprocess
import sys
import tempfile

from triaxial_runs import (command, differing, report_faults, rows, run,
                           summary)

SPHERES = ("Specimen/shapes=", "Contact/geometry=sphere",
           "Breakage/is_active=false", "Time/step=stable",
           "Boundary/plate_mass=1", "Loading/form=path",
           "Loading/consolidation_stress_tolerance=0.02",
           "Loading/consolidation_unbalanced_ratio=1e-3")
CONFINEMENT = 30e3  # Pa, of the case
HEADER = ("name,axial_stress_Pa,lateral_stress_Pa,duration_s,wave,"
          "amplitude_Pa,frequency_Hz,rest_s,cycles_1,"
          "axial_strain_rate_1_per_s,axial_strain_1,until_stress_ratio_1,"
          "until_unbalanced_force_ratio_1,lateral_rule,lateral_over_axial_1")
CONFINE, WAVE, REST, TRIANGLE, K_PATH, SHEAR, CONSTANT_P, UNDRAINED = STAGES = (
    "confine,60e3,50e3,0.05,,,,,,,,,,,",
    "wave,,,,haversine,20e3,40,0.025,2,,,,,,",
    "rest,,,0.05,,,,,,,,,1e-3,,",
    "triangle,,,,triangular,15e3,20,,1,,,,,,",
    "k path,70e3,,0.05,,,,,,,,,,,0.5",
    "shear,,,,,,,,,0.3,0.02,0.8,,,",
    "constant p,,,,,,,,,0.3,0.03,,,constant_p,",
    "undrained,,,,,,,,,0.3,0.045,,,constant_volume,")
N_STRESS_STAGES = 5  # the plate is driven in the others
# A plate of 1 kg on a specimen of 0.3 kg lags behind the stress: 2 % between
# rigid sides; a membrane bears some of the force, 9 %. Other seeds have 8 to
# 18 %, and other last digits are like another seed: 6 %.
AXIAL_TOLERANCE = {"rigid": 0.04, "membrane": 0.12}
# Means over a stage: 0.7 % and 3.2 %.
AXIAL_MEAN = {"rigid": 0.015, "membrane": 0.04}
SIDE_TOLERANCE = 0.006  # of the servo, 0.3 %; a pressure has no error
P_TOLERANCE = 0.004  # of a constant mean stress, 0.2 %; of its mean at
P_MEAN = 0.001       # the end, 0.05 %: a ratio off by 1 % makes 0.2 %
VOLUME_TOLERANCE = 1e-8  # of a constant volume, 7e-12


def path_of(folder, *stages, name="path.csv"):
    file = folder / name
    file.write_text("\n".join((HEADER, *stages)) + "\n")
    return f"Loading/path={file}"


def loading_of(folder):
    """Rows of history.csv by stage of the path."""
    stages = {}
    for row in rows(folder, "history.csv")[1]:
        if row["stage_1"] == 2.:
            stages.setdefault(round(row["loading_stage_1"]), []).append(row)
    return [stages[k] for k in sorted(stages)]


def haversine(phase):
    return math.sin(math.pi * phase) ** 2 if phase < 1. else 0.


def targets(number, share):
    """Axial and lateral target at a share of a stage [Pa]."""
    cycle = 2. * share % 1. if share < 1. else 0.
    return {
        1: (30e3 + 30e3 * share, 30e3 + 20e3 * share),
        2: (60e3 + 20e3 * haversine(2. * cycle), 50e3),
        3: (60e3, 50e3),
        4: (60e3 + 15e3 * (1. - abs(2. * share - 1.)), 50e3),
        5: (60e3 + 10e3 * share, 50e3 + 5e3 * share),
        6: (math.nan, 55e3)}.get(number, (math.nan, math.nan))


def stress_faults(lateral, stages, table):
    """Targets are those of the closed form, and what is measured follows."""
    faults = []
    for number, stage in enumerate(stages[:N_STRESS_STAGES], 1):
        start, end = table[number - 1]["start_time_s"], table[number - 1]["time_s"]
        length = {3: 0.05}.get(number, end - start)
        errors = []
        for row in stage:
            axial, side = targets(number, (row["time_s"] - start) / length)
            # Times have some 15 digits, the wave is steep by 5e6 Pa/s.
            if abs(row["axial_target_Pa"] - axial) > 1e-6 * axial or \
                    abs(row["lateral_target_Pa"] - side) > 1e-6 * side:
                faults.append(f"stage {number} at {row['time_s']} s: targets "
                              f"{row['axial_target_Pa']}, "
                              f"{row['lateral_target_Pa']}: {axial}, {side}")
            errors.append(abs(row["axial_stress_Pa"] / axial - 1.))
            sides = 1e-9 if lateral == "membrane" else SIDE_TOLERANCE
            if abs(row["lateral_stress_Pa"] / side - 1.) > sides:
                faults.append(f"stage {number} at {row['time_s']} s: lateral "
                              f"stress {row['lateral_stress_Pa']}")
        if max(errors) > AXIAL_TOLERANCE[lateral] or \
                sum(errors) / len(errors) > AXIAL_MEAN[lateral]:
            faults.append(f"stage {number}: axial stress off by up to "
                          f"{max(errors)}")
    return faults


def stage_faults(table, cycles):
    """Lengths, ends and numbers of cycles."""
    faults = []
    lengths = [row["time_s"] - row["start_time_s"] for row in table]
    # 2 cycles of 1 / 40 s and 0.025 s of rest; the rest ends when it is one.
    for k, length in ((0, 0.05), (1, 0.1), (3, 0.05), (4, 0.05)):
        if abs(lengths[k] - length) > 1e-9:
            faults.append(f"stage {k + 1} took {lengths[k]} s")
    for a, b in zip(table, table[1:]):
        if a["time_s"] != b["start_time_s"]:
            faults.append(f"stage {b['loading_stage_1']} begins at "
                          f"{b['start_time_s']}, not {a['time_s']} s")
    if [row["cycles_1"] for row in table[:4]] != [0., 2., 0., 1.]:
        faults.append("cycles of the stages are wrong")
    found = [(row["loading_stage_1"], row["cycle_of_stage_1"])
             for row in cycles]
    if found != [(2., 1.), (2., 2.), (4., 1.)]:
        faults.append(f"cycles.csv has {found}")
    met = [row["is_met_1"] for row in table]
    if met[2] != 1. or not table[2]["unbalanced_force_ratio_1"] < 1e-3 \
            or met[5] != 1. or sum(met) != 2.:
        faults.append(f"end conditions: {met}")
    return faults


def mean_stress(row):
    return (row["axial_stress_Pa"] + 2. * row["lateral_stress_Pa"]) / 3.


def driven_faults(stages, table):
    """Shear to a stress ratio, constant mean stress, constant volume."""
    faults = []
    ratio = [(row["axial_stress_Pa"] - row["lateral_stress_Pa"]) /
             mean_stress(row) for row in stages[5]]
    # The condition reads running means and is checked 50 times.
    if not 0.78 < ratio[-1] < 0.85 or max(ratio[:-1]) > 0.82:
        faults.append(f"shear ended at q / p = {ratio[-1]}")
    rate = ((stages[5][-1]["axial_strain_1"] - stages[5][4]["axial_strain_1"]) /
            (stages[5][-1]["time_s"] - stages[5][4]["time_s"]))
    # A hundredth of the time is spent on getting up to speed.
    if abs(rate / 0.3 - 1.) > 0.01:
        faults.append(f"rate of shear {rate} 1/s")
    asked = mean_stress(stages[5][-1])
    for row in stages[6]:
        if abs(mean_stress(row) / asked - 1.) > P_TOLERANCE:
            faults.append(f"mean stress {mean_stress(row)} instead of {asked}")
    mean = sum(mean_stress(row) for row in stages[6][-10:]) / 10.
    start = sum(mean_stress(row) for row in stages[6][:3]) / 3.
    print(f"mean stress at the end {mean / start} of that at the start")
    if abs(mean / start - 1.) > P_MEAN:
        faults.append(f"mean stress ends at {mean}, began at {start} Pa")
    if len(stages) > 7:
        volumes = [table[6]["permanent_volumetric_strain_1"]] + [
            row["volumetric_strain_1"] for row in stages[7]]
        if max(volumes) - min(volumes) > VOLUME_TOLERANCE:
            faults.append(f"volume changed by {max(volumes) - min(volumes)}")
    for stage, strain in zip(stages[6:], (0.03, 0.045)):
        if abs(stage[-1]["axial_strain_1"] - strain) > 2e-4:
            faults.append(f"strain {stage[-1]['axial_strain_1']}, {strain} "
                          "was asked for")
    return faults


def path_faults(spall, lateral):
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        wanted = STAGES if lateral == "rigid" else STAGES[:-1]
        run(spall, root / "run", lateral,
            settings=(*SPHERES, path_of(root, *wanted)))
        stages = loading_of(root / "run")
        table = rows(root / "run", "stages.csv")[1]
        if not len(stages) == len(table) == len(wanted):
            return [f"{len(stages)} stages in history.csv"]
        faults = (stress_faults(lateral, stages, table) +
                  stage_faults(table, rows(root / "run", "cycles.csv")[1]) +
                  driven_faults(stages, table))
        if summary(root / "run")["energy_residual_ratio_1"] > 2e-3:
            faults.append("energies do not close")
        return faults


def apart_faults(spall):
    """Stresses of x and y apart, then strains of both sides."""
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        file = root / "apart.csv"
        file.write_text("x_stress_Pa,y_stress_Pa,lateral_strain_1,"
                        "axial_strain_rate_1_per_s,duration_s\n"
                        "40e3,25e3,,,0.05\n,,-0.005,0.2,0.05\n")
        run(spall, root / "run", "rigid",
            settings=(*SPHERES, f"Loading/path={file}"))
        stress, strain = loading_of(root / "run")
    faults = [f"{key} ends at {stress[-1][key]}, {asked} Pa was asked for"
              for key, asked in (("x_stress_Pa", 40e3), ("y_stress_Pa", 25e3))
              if abs(stress[-1][key] / asked - 1.) > SIDE_TOLERANCE]
    # Sides have stretched each way while x and y stresses went apart.
    start, end = stress[-1], strain[-1]
    across = ((1. - start["volumetric_strain_1"]) /
              (1. - start["axial_strain_1"]))
    volume = 1. - (1. - end["axial_strain_1"]) * 1.005 ** 2
    if abs(across - 1.) < 1e-4 or \
            abs(end["volumetric_strain_1"] - volume) > 1e-8:
        faults.append(f"volumetric strain {end['volumetric_strain_1']}: "
                      f"{volume}")
    return faults


def short_form_faults(spall, root):
    """One haversine, once by its short form."""
    file = root / "one.csv"
    file.write_text("name,wave,amplitude_Pa,frequency_Hz,cycles_1,section\n"
                    "block,haversine,100e3,200,2,first\n")
    run(spall, root / "short", "membrane", settings=("Loading/frequency=200",))
    run(spall, root / "one", "membrane",
        settings=("Loading/form=path", f"Loading/path={file}"))
    return [f"one haversine: {path} differs" for path in differing(
        root / "short", root / "one",
        ("history.csv", "cycles.csv", "events.csv", "ledger.csv"))]


def restart_faults(spall, root):
    """Stopped within a path, and with more stages at its end."""
    settings = (*SPHERES, path_of(root, CONFINE, WAVE, K_PATH, SHEAR, UNDRAINED))
    tables = ("history.csv", "cycles.csv", "stages.csv")
    run(spall, root / "whole", "rigid", settings=settings)
    faults = []
    for until in (2, 5):
        folder = root / f"until{until}"
        run(spall, folder, "rigid", "--until", str(until), settings=settings)
        run(spall, folder, "rigid", "--resume", settings=settings)
        faults += [f"--until {until}: {path} differs" for path in
                   differing(folder, root / "whole", tables)]
    fewer = path_of(root, CONFINE, WAVE.replace("025,2", "025,1"),
                    name="grows.csv")
    grown = root / "grown"
    run(spall, grown, "rigid", settings=(*SPHERES, fewer))
    path_of(root, CONFINE, WAVE, K_PATH, SHEAR, UNDRAINED, name="grows.csv")
    run(spall, grown, "rigid", "--resume", settings=(*SPHERES, fewer))
    # A stage that was over has a row already.
    faults += [f"longer path: {path} differs" for path in
               differing(grown, root / "whole", ("history.csv", "cycles.csv"))]
    path_of(root, CONFINE.replace("60e3", "61e3"), WAVE, name="grows.csv")
    ended = subprocess.run(
        command(spall, grown, "rigid", "--resume", settings=(*SPHERES, fewer)),
        capture_output=True, text=True, check=False)
    if ended.returncode != 1 or len(ended.stderr.splitlines()) != 1 or \
            "has begun stage 1 of the loading path" not in ended.stderr:
        faults.append(f"changed stage: status {ended.returncode}, "
                      f"{ended.stderr}")
    return faults


def main():
    spall, what = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2]
    if what != "restart":
        return report_faults(path_faults(spall, what) + (
            apart_faults(spall) if what == "rigid" else []))
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        return report_faults(short_form_faults(spall, root) +
                             restart_faults(spall, root))


if __name__ == "__main__":
    sys.exit(main())
