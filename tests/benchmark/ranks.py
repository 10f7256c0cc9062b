#!/usr/bin/env python3
"""One packing on several ranks, in turn, and on as many threads.

    ranks.py PROGRAM [--packing P.csv] [--ranks 1,2] [--threads 1,2]
             [--scenes rest,collapse] [--steps N] [--repeat N] [--settle N]
             [--shapes DIR] [--geometry G] [--mpirun WORDS]

The runs go in turn, so that a slow minute of the machine falls on all. Ratios
are of wall time, over one rank and one thread; the spread is half the range of
the single turns. The positions at the end must have the same checksum. Without
--packing a lattice of 30 000 spheres is made (make_packing.py).
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from bench_runs import spread, table

HERE = pathlib.Path(__file__).resolve().parent


def numbers(text):
    return [int(word) for word in text.split(",")]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--packing", type=pathlib.Path)
    parser.add_argument("--ranks", type=numbers, default=[1, 2])
    parser.add_argument("--threads", type=numbers, default=[1, 2])
    parser.add_argument("--scenes", default="rest,collapse")
    parser.add_argument("--steps", type=int, default=500)
    parser.add_argument("--settle", type=int)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--shapes")
    parser.add_argument("--geometry")
    parser.add_argument("--mpirun", default="mpirun")
    return parser.parse_args()


def run(options, packing, scene, ranks, threads):
    """One run of `spall bench`, as a dictionary."""
    with tempfile.TemporaryDirectory() as folder:
        result = pathlib.Path(folder) / "bench.json"
        words = [*options.mpirun.split(), "-n", ranks, options.program,
                 "bench", "--packing", packing, "--scene", scene,
                 "--steps", options.steps, "--threads", threads,
                 "--json", result]
        for name in ("settle", "shapes", "geometry"):
            value = getattr(options, name)
            if value is not None:
                words += [f"--{name}", value]
        subprocess.run(list(map(str, words)), check=True,
                       stdout=subprocess.DEVNULL,
                       env={**os.environ, "OMP_NUM_THREADS": str(threads)})
        return json.loads(result.read_text())["median"]


def main():
    options = arguments()
    plans = [(ranks, 1) for ranks in options.ranks]
    plans += [(1, threads) for threads in options.threads if threads > 1]
    rows, checksums = [], {}
    with tempfile.TemporaryDirectory() as folder:
        packing = options.packing or pathlib.Path(folder) / "lattice.csv"
        if not options.packing:
            subprocess.run([sys.executable, HERE / "make_packing.py", "30000",
                            packing], check=True, stdout=subprocess.DEVNULL)
        for scene in options.scenes.split(","):
            runs = {plan: [] for plan in plans}
            for _ in range(options.repeat):
                for plan in plans:
                    runs[plan].append(run(options, packing, scene, *plan))
            one = [each["wall_s"] for each in runs[plans[0]]]
            for (ranks, threads), found in runs.items():
                wall = [each["wall_s"] for each in found]
                ratios = [a / b for a, b in zip(one, wall)]
                last = found[-1]
                checksums.setdefault(scene, set()).update(
                    each["checksum"] for each in found)
                rows.append([
                    scene, ranks, threads,
                    f"{1e3 * statistics.median(wall) / options.steps:.2f}",
                    f"{statistics.median(ratios):.2f} "
                    f"± {spread(ratios) * statistics.median(ratios):.2f}",
                    f"{last['mean_ghosts']:.0f}", f"{last['most_ghosts']:.0f}",
                    f"{1e-3 * last['most_bytes_per_step']:.0f}",
                    f"{last['imbalance_1']:.3f}",
                    f"{100 * last['phases_s']['exchange'] / last['wall_s']:.1f}"])
    print(table(["scene", "ranks", "threads", "ms per step", "speed",
                 "ghosts, mean", "most", "kB per step", "imbalance",
                 "exchange %"], rows))
    if any(len(found) > 1 for found in checksums.values()):
        sys.exit("not the same bits: " + str(checksums))
    print("\nThe same bits in all runs of a scene.")


if __name__ == "__main__":
    main()
