#!/usr/bin/python3
"""What it costs and changes that contacts remember in double what float is
enough for, as a table.

    columns.py SPALL WIDE_SPALL [--keep DIR]

WIDE_SPALL is a build with -DSPALL_WIDE_COLUMNS=ON. Both run the reference of
data/studies/speed_against_error.prm for its five seeds, in turn, each with
specimens of its own: its checkpoints are no other's. Differences are in pairs
with the same seed, mean and 95 % interval, and over the standard deviation of
the seeds.
"""
import argparse
import json
import pathlib
import re
import statistics
import subprocess
import tempfile

from bench_runs import table

DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
STUDY = DATA / "studies" / "speed_against_error.prm"
SEEDS = (1, 2, 3, 4, 5)
STUDENT = 2.776  # four degrees of freedom, 95 %
COSTS = ("loading_processor_s", "peak_memory_B")


def base_settings():
    """Of the section Base, in its order."""
    section = re.search(r"subsection Base\n(.*?)\nend", STUDY.read_text(),
                        re.DOTALL)[1]
    for line in section.splitlines():
        found = re.match(r"\s*set (\S+)\s*=\s*([^#]*)", line)
        if found:
            yield f"{found[1]}={found[2].strip()}"


def outcomes():
    line = re.search(r"set outcomes\s*=\s*(.*)", STUDY.read_text())[1]
    return [name.strip() for name in line.split(",")]


def run(spall, seed, folder):
    words = [spall, "run", DATA / "cases" / "dynamic_triaxial_quick.prm",
             "--out", folder, "--threads", 1]
    for setting in (*base_settings(), f"Specimen/seed={seed}"):
        words += ["--set", setting]
    subprocess.run(list(map(str, words)), check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads((folder / "summary.json").read_text())


def row(name, narrow, wide):
    gaps = [b[name] - a[name] for a, b in zip(narrow, wide)]
    spread = statistics.stdev(summary[name] for summary in narrow)
    mean = statistics.mean(gaps)
    interval = STUDENT * statistics.stdev(gaps) / len(gaps) ** 0.5
    return [name, f"{statistics.mean(s[name] for s in narrow):.4g}",
            f"{mean:.2g} ± {interval:.2g}", f"{mean / spread:+.2f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("spall")
    parser.add_argument("wide_spall")
    parser.add_argument("--keep")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(given.keep or scratch)
        narrow, wide = [], []
        for seed in SEEDS:
            narrow.append(run(given.spall, seed, root / f"narrow_{seed}"))
            wide.append(run(given.wide_spall, seed, root / f"wide_{seed}"))
    rows = [row(name, narrow, wide) for name in outcomes()]
    for name in COSTS:
        ratios = [b[name] / a[name] for a, b in zip(narrow, wide)]
        rows.append([name, f"{statistics.mean(s[name] for s in narrow):.4g}",
                     f"{statistics.mean(ratios):.3f} times", ""])
    print(table(["outcome", "float", "double less float", "over the spread"],
                rows))


if __name__ == "__main__":
    main()
