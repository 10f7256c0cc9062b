#!/usr/bin/env python3
"""Instructions per contact update, by function (valgrind's callgrind).

    instructions.py SPALL [--packing P.csv] [--scene rest] [--shapes DIR]
                    [--breakage] [--steps 20,60] [--rows 16]

Two runs that differ in the number of timed steps only, so that start-up and
warm-up cancel. Without --packing a lattice of 2000 particles is made. Names of
functions come from the symbol table; what the compiler has inlined counts
for its caller. Valgrind shows an AVX2 machine: wider units are not counted.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from bench_runs import bench, table

HERE = pathlib.Path(__file__).resolve().parent


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("spall", type=pathlib.Path)
    parser.add_argument("--packing", type=pathlib.Path)
    parser.add_argument("--scene", default="rest")
    parser.add_argument("--shapes")
    parser.add_argument("--breakage", action="store_true")
    parser.add_argument("--steps", default="20,60")
    parser.add_argument("--rows", type=int, default=16)
    return parser.parse_args()


def profile(spall, words, steps, out):
    """Instructions by function, and in all."""
    subprocess.run(["valgrind", "--tool=callgrind",
                    f"--callgrind-out-file={out}", spall, "bench", *words,
                    "--steps", str(steps)], check=True, capture_output=True,
                   env={**os.environ, "OMP_NUM_THREADS": "1"})
    text = subprocess.run(["callgrind_annotate", "--threshold=100",
                           "--auto=no", out], check=True, capture_output=True,
                          text=True).stdout
    counts, total = {}, 0
    for line in text.splitlines():
        match = re.match(r"\s*([\d,]+) \(\s*[\d.]+%\)\s+(.*)", line)
        if not match:
            continue
        count = int(match[1].replace(",", ""))
        if match[2].startswith("PROGRAM TOTALS"):
            total = count
            continue
        name = re.sub(r" \[.*\]$", "", re.sub(r"^\S*?:", "", match[2]))
        counts[name] = counts.get(name, 0) + count
    return counts, total


def short(name):
    """The function without its namespaces' noise and its arguments."""
    name = name.replace("(anonymous namespace)::", "").replace("dem::", "")
    return re.sub(r"\(.*", "", name)[:60].replace("|", "/")


def main():
    options = arguments()
    if not shutil.which("valgrind"):
        print("no valgrind on this machine: skipped")
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        packing = options.packing
        if packing is None:
            packing = folder / "lattice.csv"
            subprocess.run([sys.executable, HERE / "make_packing.py", "2000",
                            packing], check=True, stdout=subprocess.DEVNULL)
        words = ["--packing", packing, "--scene", options.scene,
                 "--settle", "0"]
        words += ["--shapes", options.shapes] if options.shapes else []
        words += ["--breakage"] if options.breakage else []
        few, more = map(int, options.steps.split(","))
        before, total = profile(options.spall, words, few, folder / "few")
        after, total_more = profile(options.spall, words, more,
                                    folder / "more")
        sample = bench(options.spall, packing, *words[2:], "--steps",
                       more)["median"]
    updates = sample["updates"] / more * (more - few)
    total = total_more - total
    rows = sorted(((after[name] - before.get(name, 0), name)
                   for name in after), reverse=True)[:options.rows]
    print(f"{total / updates:.0f} instructions per contact update\n")
    print(table(["instructions per update", "share", "function"],
                [[f"{n / updates:.1f}", f"{100 * n / total:.1f} %",
                  f"`{short(name)}`"] for n, name in rows]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
