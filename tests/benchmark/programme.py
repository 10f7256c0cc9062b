#!/usr/bin/env python3
"""Hours for the whole programme of the article, from `spall check`.

    programme.py SPALL [--page PAGE]
    programme.py --measured RUN ...

The article: Xiao et al., Infrastructures 2026, 11(8), 264: single-particle
sweeps, 2000 turns of the drum, 350 s of vibratory compaction, 18 triaxial runs
of 1000 cycles at full size. Every run is timed by `spall check` (steps on this
machine, now: let it be idle) and has one core; on several cores, runs are given
out one by one, the longest first. PAGE has the table between two marks.

--measured: processor time per simulated second of consolidation and loading of
folders of triaxial runs, over that of the first one, and the hours of the 18
runs on one core if the time grows with the number of particles.
"""
import argparse
import csv
import heapq
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MARKS = ("<!-- table of programme.py -->", "<!-- end of the table -->")
CORES = (1, 2, 16)
FREQUENCIES = (10, 15, 20, 25, 30)  # Hz, at 120 kPa
AMPLITUDES = (80, 100, 140, 160)  # kPa, at 20 Hz
PRESETS = ("reference", "standard", "fast")  # of the triaxial case
FULL_SIZE = 34000  # particles
SWEEP_CASES = 105  # of data/studies/single_particle_sensitivity.prm


def predicted_seconds(spall, case, settings=()):
    words = [spall, "check", str(ROOT / "data" / "cases" / f"{case}.prm"),
             "--set", "Run/threads=1"]
    for setting in settings:
        words += ["--set", setting]
    said = subprocess.run(words, capture_output=True, text=True, check=True)
    found = re.search(r"^predicted time\s+([0-9.e+]+) s", said.stdout, re.M)
    if not found:
        sys.exit(f"no prediction for {case}:\n{said.stdout}")
    return float(found.group(1))


def triaxial_runs(spall, settings):
    """Seconds of the 18 runs; the steps in a cycle go with 1 / frequency."""
    at_20 = predicted_seconds(spall, "dynamic_triaxial", settings)
    one = [at_20 * 20. / f for f in FREQUENCIES] + [at_20 for _ in AMPLITUDES]
    return one + one  # with breakage and without


def makespan(runs, n_cores):
    """The longest first, each to the core that is free first."""
    free = [0.] * n_cores
    for seconds in sorted(runs, reverse=True):
        heapq.heappush(free, heapq.heappop(free) + seconds)
    return max(free)


def parts(spall):
    yield (f"single particle, {SWEEP_CASES} runs",
           [predicted_seconds(spall, "single_particle")] * SWEEP_CASES)
    yield "Los Angeles drum, 2000 turns", [
        predicted_seconds(spall, "los_angeles")]
    yield "vibratory compaction, 350 s", [
        predicted_seconds(spall, "vibratory_compaction")]
    yield "triaxial, 18 runs of 1000 cycles", triaxial_runs(spall, ())


def table(rows):
    """`rows`: parts of the programme."""
    lines = ["| | runs | " + " | ".join(
        f"{n} core{'s' if n > 1 else ''} [h]" for n in CORES) + " |",
        "|---|---|" + "---|" * len(CORES)]
    everything = []
    for name, runs in rows:
        everything += runs
        lines.append(line(name, runs))
    lines.append(line("**all**", everything))
    return "\n".join(lines) + "\n"


def preset_lines(spall, others):
    """The triaxial runs again, every cycle simulated, without preparation, and
    all with them; `others`: seconds of the other runs.
    """
    text = ""
    for name in PRESETS:
        runs = triaxial_runs(spall, (f"preset={name}", "CycleJump/tolerance=0"))
        text += line(f"triaxial, preset `{name}`", runs) + "\n"
        text += line(f"**all**, triaxial by `{name}`", others + runs) + "\n"
    return text


def line(name, runs):
    hours = [f"{makespan(runs, n) / 3600.:.3g}" for n in CORES]
    return f"| {name} | {len(runs)} | " + " | ".join(hours) + " |"


def measured_lines(folders):
    """A line for each run; costs are over that of the first."""
    yield ("| run | particles | step [µs] | processor time for a second [s] | "
           "over the first | 18 runs, 1 core [h] |")
    yield "|---|---|---|---|---|---|"
    # In lengths of the run at 20 Hz: the others have the same cycles.
    n_runs = 2 * (sum(20. / f for f in FREQUENCIES) + len(AMPLITUDES))
    seconds = n_runs * 1000 / 20.
    first = None
    for folder in folders:
        found = json.loads((folder / "summary.json").read_text())
        with open(folder / "history.csv", newline="") as stream:
            times = [float(row["time_s"]) for row in csv.DictReader(stream)
                     if float(row["stage_1"]) >= 1.]
        cost = found["loading_processor_s"] / (times[-1] - times[0])
        first = first or cost
        hours = cost * FULL_SIZE / found["n_particles"] * seconds / 3600.
        yield (f"| {folder.name} | {found['n_particles']} | "
               f"{1e6 * found['shortest_step_s']:.1f} to "
               f"{1e6 * found['longest_step_s']:.1f} | {cost:.0f} | "
               f"{cost / first:.2f} | {hours:.0f} |")


def main():
    words = argparse.ArgumentParser()
    words.add_argument("spall", nargs="?")
    words.add_argument("--page", type=pathlib.Path)
    words.add_argument("--measured", type=pathlib.Path, nargs="+")
    options = words.parse_args()
    if options.measured:
        print("\n".join(measured_lines(options.measured)))
        return
    if not options.spall:
        words.error("SPALL or --measured")
    rows = list(parts(options.spall))
    others = [seconds for _, runs in rows[:-1] for seconds in runs]
    text = table(rows) + preset_lines(options.spall, others)
    print(text)
    if options.page:
        before, rest = options.page.read_text().split(MARKS[0])
        after = rest.split(MARKS[1])[1]
        options.page.write_text(
            f"{before}{MARKS[0]}\n\n{text}\n{MARKS[1]}{after}")


if __name__ == "__main__":
    main()
