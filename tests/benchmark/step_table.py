#!/usr/bin/env python3
"""The small triaxial test with a series of time steps: docs/performance.

    step_table.py SPALL [--page PAGE] [--runs FOLDER] [--variants N]

All runs go on from one state, the end of the first load cycle of a run with
the smallest step, and take the next two cycles. Every step is run several
times; the variants differ in the ninth digit of what was given, which no
physics sees: their spread is what chaos alone makes of a number. A difference
between two steps below it says nothing. PAGE has the table between two marks,
the rest of it is left alone.
"""
import argparse
import math
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "application"))

from triaxial_runs import CASE, ENVIRONMENT, rows, summary  # noqa: E402

FIXED = (0.25, 0.5, 1., 2., 2.5, 4.)  # us; all divide a row of the history
EARLY = 10  # rows in which runs have not drifted apart: a fifth of a cycle
MARKS = ("<!-- table of step_table.py -->", "<!-- end of the table -->")


def rules():
    """Name, and settings of variant n."""
    for step in FIXED:
        yield f"fixed, {step:g} µs", lambda n, step=step: (
            "Time/step=fixed",
            f"Time/fixed_step={1e-6 * step * (1. + 1e-9 * n):.12g}")
    yield "stable, 0.8", lambda n: (
        "Time/step=stable", f"Time/safety={0.8 * (1. + 1e-9 * n):.12g}")
    for name, tolerance in (("0.1 %", 1e-3), ("0.01 %", 1e-4)):
        yield f"error, {name}", lambda n, tolerance=tolerance: (
            "Time/step=error", f"Time/safety={0.8 * (1. + 1e-9 * n):.12g}",
            f"Time/force_tolerance={tolerance:g}",
            f"Time/energy_tolerance={tolerance:g}")


def run(spall, folder, lateral, *options, settings):
    words = [spall, "run", str(CASE), "--out", str(folder), "--threads", "1",
             *options]
    for setting in (f"Boundary/lateral={lateral}", "Loading/cycles=3",
                    "Output/frames_per_cycle=0", *settings):
        words += ["--set", setting]
    subprocess.run(words, stdout=subprocess.DEVNULL, check=True,
                   env={**ENVIRONMENT, "OMP_NUM_THREADS": "1"})


def state(folder):
    found = summary(folder)
    history = [row for row in rows(folder, "history.csv")[1]
               if row["stage_1"] == 2.]
    return found, history


def numbers(folder, start):
    """What the cycles after `start` came to."""
    found, history = state(folder)
    before, _ = start
    later = history[len(start[1]):]
    clock, clock_before = found["wall_clock_s"], before["wall_clock_s"]
    wall = clock["total"] - clock_before["total"]
    spent = sum(clock[key] - clock_before[key]
                for key in ("step_watch", "step_probe"))
    work = later[-1]["external_work_J"] - start[1][-1]["external_work_J"]
    residual = (later[-1]["energy_residual_J"] -
                start[1][-1]["energy_residual_J"])
    n_steps = found["n_steps"] - before["n_steps"]
    return {
        "steps": [found.get("shortest_step_s", found["time_step_s"]),
                  found.get("longest_step_s", found["time_step_s"])],
        "wall": wall, "watch": spent / wall,
        "probes": found.get("n_probe_steps", 0) / n_steps,
        "energy": abs(residual / work),
        "events": found["n_events"] - before["n_events"],
        "strain": 100. * (found["permanent_axial_strain_1"] -
                          before["permanent_axial_strain_1"]),
        "laa": found["laa_percent"] - before["laa_percent"],
        "over": found.get("step_over_limit_1"),
        "stress": [row["axial_stress_Pa"] for row in later],
    }


def force_error(stress, reference, n_rows):
    """Root mean square over the first rows, over the peak [-]."""
    square = statistics.fmean(
        (a - b) ** 2 for a, b in zip(stress[:n_rows], reference[:n_rows]))
    return math.sqrt(square) / max(reference)


def cell(values, digits):
    spread = statistics.stdev(values) if len(values) > 1 else 0.
    return f"{statistics.fmean(values):.{digits}f} ± {spread:.{digits}f}"


def errors(found, reference, n_rows):
    """Mean in per cent of all pairs of two different runs."""
    return 100. * statistics.fmean(
        force_error(one["stress"], other["stress"], n_rows)
        for one in found for other in reference if one is not other)


def line(name, found, reference):
    steps = [1e6 * step for one in found for step in one["steps"]]
    text = (f"{min(steps):.2f}" if max(steps) - min(steps) < 1e-3 else
            f"{min(steps):.2f} to {max(steps):.2f}")
    over = [one["over"] for one in found if one["over"] is not None]
    extra = 100. * statistics.fmean(one["probes"] for one in found)
    watch = 100. * statistics.fmean(one["watch"] for one in found)
    cells = [
        name, text, f"{max(over):.2f}" if over else "up to 0.8",
        f"{min(one['wall'] for one in found):.2f}",
        f"{watch:.1f}", f"{extra:.0f}",
        f"{errors(found, reference, EARLY):.2g}",
        f"{errors(found, reference, 10 ** 6):.2g}",
        f"{100. * statistics.fmean(one['energy'] for one in found):.2g}",
        cell([one["events"] for one in found], 0),
        cell([one["strain"] for one in found], 2),
        cell([one["laa"] for one in found], 4)]
    return "| " + " | ".join(cells) + " |"


HEAD = """| rule | step (µs) | / limit | wall (s) | watch (%) | probes (%) \
| force, early (%) | force (%) | energy (%) | Nb | strain (%) | LAA (%) |
|---|---|---|---|---|---|---|---|---|---|---|---|"""


def table(spall, lateral, n_variants, root):
    base = root / lateral
    run(spall, base, lateral, "--until", "1",
        settings=("Time/step=fixed", f"Time/fixed_step={FIXED[0]}e-6"))
    start = state(base)
    found, text = {}, [f"**{lateral} sides**, {n_variants} variants each:", "",
                       HEAD]
    for number, (name, settings) in enumerate(rules()):
        found[name] = []
        for variant in range(n_variants):
            folder = root / f"{lateral}_{number}_{variant}"
            shutil.copytree(base, folder)
            run(spall, folder, lateral, "--resume", settings=settings(variant))
            found[name].append(numbers(folder, start))
        text.append(line(name, found[name], next(iter(found.values()))))
        print(lateral, text[-1], flush=True)
    return "\n".join(text) + "\n"


def put_into(page, text):
    whole = page.read_text()
    before, rest = whole.split(MARKS[0])
    after = rest.split(MARKS[1])[1]
    page.write_text(f"{before}{MARKS[0]}\n{text}{MARKS[1]}{after}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("spall", type=pathlib.Path)
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--runs", type=pathlib.Path)
    parser.add_argument("--variants", type=int, default=4)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        root = options.runs or pathlib.Path(name)
        root.mkdir(parents=True, exist_ok=True)
        text = "\n".join(table(str(options.spall.resolve()), lateral,
                               options.variants, root)
                         for lateral in ("rigid", "membrane"))
    if options.page:
        put_into(options.page, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
