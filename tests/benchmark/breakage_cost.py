#!/usr/bin/env python3
"""What breakage costs where nothing breaks: a packing of particles with it and
without, program by program in turn.

    breakage_cost.py SPALL [--particles N] [--settle STEPS] [--repeat N]
"""
import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile

from bench_runs import bench, spread, table

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHAPES = ROOT / "data/shapes/limestone_blocky"


def closed_packing(spall, n_particles, folder):
    lattice = pathlib.Path(folder) / "lattice.csv"
    closed = pathlib.Path(folder) / "closed.csv"
    subprocess.run([sys.executable, ROOT / "tests/benchmark/make_packing.py",
                    str(n_particles), lattice], check=True,
                   stdout=subprocess.DEVNULL)
    bench(spall, lattice, "--shapes", SHAPES, "--geometry", "radial", "--save",
          closed, "--steps", 1, "--settle", 0)
    return closed


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("spall")
    parser.add_argument("--particles", type=int, default=2000)
    parser.add_argument("--settle", type=int, default=8000)
    parser.add_argument("--repeat", type=int, default=9)
    options = parser.parse_args()
    found = {"off": [], "on": []}
    with tempfile.TemporaryDirectory() as folder:
        packing = closed_packing(options.spall, options.particles, folder)
        for _ in range(options.repeat):
            for name, words in (("off", []), ("on", ["--breakage"])):
                run = bench(options.spall, packing, "--shapes", SHAPES,
                            "--geometry", "radial", "--settle", options.settle,
                            "--steps", 400, "--repeat", 3, *words)
                if run["median"]["events"]:
                    sys.exit("something breaks: nothing to compare")
                found[name].append(1e6 * run["median"]["cpu_s"] /
                                   run["median"]["steps"])
    median = {name: statistics.median(us) for name, us in found.items()}
    print(table(["particles", "steps before", "off, us a step", "on", "on / off"],
                [[options.particles, options.settle,
                  *(f"{median[name]:.1f} ± {100 * spread(found[name]):.0f} %"
                    for name in ("off", "on")),
                  f"{median['on'] / median['off']:.3f}"]]))


if __name__ == "__main__":
    main()
