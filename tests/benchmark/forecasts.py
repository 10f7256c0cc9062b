#!/usr/bin/python3
"""What `spall check` predicts against what the run takes, as a table.

    forecasts.py SPALL [--keep DIR] [CASE ...]

Time is that of the processor on one thread, after the preparation: the run
that is timed takes its particles from those kept by one before (--preparations),
whose summary says what the preparation took.
CASE is a name of the table; without one those of the first list are run, a
quarter of an hour. Those of the second take longer: surfaces in a membrane a
quarter of an hour, the full subgrade an hour. `--keep`: the runs stay in
DIR/CASE/run.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from bench_runs import table

CASES = pathlib.Path(__file__).resolve().parents[2] / "data" / "cases"
SURFACES = ["Contact/geometry=surface", "Contact/wall_geometry=surface",
            "Particle/rolling_friction=0"]
# Few weak particles between rigid sides.
SMALL = ["CycleJump/tolerance=0", "Specimen/side=0.075",
         "Specimen/initial_solid_fraction=0.2", "Boundary/lateral=rigid",
         "Coupling/exchange=none", "Breakage/fracture_energy=2e3",
         "Loading/cycles=3", "Output/frames_per_cycle=0",
         "Output/surfaces=none"]
# Name in the table: case, settings, and those that shorten the run that does
# nothing but prepare.
USUAL = {
    "dynamic_triaxial_quick": ("dynamic_triaxial_quick", []),
    "triaxial_cylinder_quick": ("triaxial_cylinder_quick", []),
    "vibratory_compaction_quick": ("vibratory_compaction_quick", []),
    "subgrade_quick": ("subgrade_quick", []),
    "single_particle": ("single_particle", []),
    "los_angeles": ("los_angeles", ["Drum/turns=5"]),
    "surfaces": ("dynamic_triaxial_quick", ["preset=standard", *SMALL]),
}
LONG = {
    "surfaces_in_membrane": ("dynamic_triaxial_quick",
                             [*SURFACES, "Loading/cycles=1"]),
    "subgrade": ("subgrade", [], ["Pulse/form=haversine", "Pulse/cycles=1",
                                  "Pulse/rest=0.01"]),
}
ROWS = {**USUAL, **LONG}
UNPREPARED = ("single_particle", "los_angeles")


def call(spall, *words):
    """Output, seconds of the processor and MiB at the peak of one call."""
    with subprocess.Popen(
            [str(spall), *map(str, words)], text=True, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env={**os.environ, "OMP_NUM_THREADS": "1"}) as process:
        said = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"forecasts.py: spall {' '.join(map(str, words))}:\n{said}")
    return said, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def number(label, said):
    return float(re.search(label + r"\s+([\d.e+-]+)", said)[1])


def forecast(spall, words):
    """Seconds of the test, MiB, seconds of the preparation or None."""
    said = call(spall, "check", *words)[0]
    preparing = re.search(r"to prepare +about ([\d.e+-]+) s", said)
    return (number("predicted time", said), number("memory", said),
            float(preparing[1]) if preparing else None)


def ratio(predicted, taken):
    return f"{predicted:.3g} ({predicted / taken:.2f})"


def sets(settings=()):
    return [word for setting in settings for word in ("--set", setting)]


def row(spall, name, folder):
    """Forecasts of one case and what the run after its preparation took."""
    case, settings, *shorter = ROWS[name]
    words = [CASES / f"{case}.prm", *sets(["Run/threads=1", *settings])]
    time, memory, preparing = forecast(spall, words)
    kept, prepared = None, None
    if name not in UNPREPARED:
        words += ["--preparations", f"{folder}/store"]
        call(spall, "run", *words, *sets(*shorter), "--out",
             f"{folder}/first")
        found = json.loads(
            pathlib.Path(folder, "first", "summary.json").read_text())
        prepared = found["processor_s"] - found["loading_processor_s"]
        kept, *_ = forecast(spall, words)
    _, taken, peak = call(spall, "run", *words, "--out", f"{folder}/run")
    return [name, f"{prepared:.3g}" if prepared else "",
            ratio(preparing, prepared) if prepared else "",
            f"{taken:.3g}", ratio(time, taken),
            ratio(kept, taken) if kept else "", f"{peak:.0f}",
            ratio(memory, peak)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("spall")
    parser.add_argument("--keep")
    parser.add_argument("cases", nargs="*", choices=[[], *ROWS])
    given = parser.parse_intermixed_args()
    rows = []
    for name in given.cases or USUAL:
        with tempfile.TemporaryDirectory() as folder:
            if given.keep:
                folder = f"{given.keep}/{name}"
            rows.append(row(given.spall, name, folder))
    print(table(["case", "preparation, s", "forecast (ratio)", "run, s",
                 "forecast (ratio)",
                 "forecast from kept particles (ratio)", "peak, MiB",
                 "forecast (ratio)"], rows))


if __name__ == "__main__":
    main()
