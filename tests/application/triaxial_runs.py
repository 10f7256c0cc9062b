"""Runs of the small dynamic triaxial test, and what they leave, for the tests.
"""
import csv
import json
import os
import pathlib
import re
import subprocess

DATA = pathlib.Path(__file__).resolve().parent / "data"
CASE = DATA / "small_membrane.prm"
LATERALS = ("membrane", "rigid")
# Short cycles: what is asked is equality, not physics.
QUICK = ("Loading/frequency=200",)
# Waiting threads make room: other tests run on the same cores.
ENVIRONMENT = {**os.environ, "OMP_WAIT_POLICY": "passive"}


def command(spall, folder, lateral, *options, settings=(), threads=1):
    words = [spall, "run", str(CASE), "--out", str(folder),
             "--threads", str(threads), *options]
    for setting in (f"Boundary/lateral={lateral}", *settings):
        words += ["--set", setting]
    return words


def run(spall, folder, lateral, *options, **keys):
    """Runs to the end; a failure ends the test with what the program said."""
    ended = subprocess.run(command(spall, folder, lateral, *options, **keys),
                           capture_output=True, text=True, timeout=900,
                           check=False, env=ENVIRONMENT)
    if ended.returncode != 0:
        raise SystemExit(f"{' '.join(ended.args)}: status "
                         f"{ended.returncode}\n{ended.stderr}")


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def summary_faults(mine, other, left_out=()):
    """Where two summaries differ, what a run has cost left out."""
    costs = {"wall_clock_s", "processor_s", "loading_processor_s",
             "loading_wall_clock_s", "peak_memory_B",
             "threads",  # as many as are quickest at the end
             *left_out}
    return [f"{key} is {mine.get(key)}, was {value}"
            for key, value in other.items()
            if key not in costs and mine.get(key) != value]


def rows(folder, name):
    """Header and rows (numbers by column name) of a CSV file of a run."""
    with open(folder / name, newline="") as stream:
        reader = csv.DictReader(stream)
        table = [{key: float(text) for key, text in row.items()}
                 for row in reader]
    return ",".join(reader.fieldnames), table


def differing(folder, other, names):
    """Which of these files are not equal byte for byte."""
    return [name for name in names
            if ((folder / name).exists() or (other / name).exists()) and
            not ((folder / name).exists() and (other / name).exists() and
                 (folder / name).read_bytes() == (other / name).read_bytes())]


def report_faults(faults):
    """Prints them; exit status of the test."""
    faults = list(faults)
    for fault in faults:
        print(fault)
    print("failed" if faults else "passed")
    return 1 if faults else 0


def named_frames(folder):
    """Files that run.pvd names."""
    return re.findall(r'file="([^"]+)"', (folder / "run.pvd").read_text())


def missing_frame_faults(folder):
    return [f"run.pvd names {frame}, which is not there"
            for frame in named_frames(folder)
            if not (folder / frame).is_file()]
