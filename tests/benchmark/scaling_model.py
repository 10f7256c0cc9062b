#!/usr/bin/env python3
"""How fast a packing would run on many ranks, from counts of real runs.

    scaling_model.py PROGRAM --packing P.csv [--ranks 16,64,256]
                     [--latency S] [--bandwidth B_PER_S] [--neighbours N]
                     [--measured RANKS:MS,...] [--mpirun WORDS]

The packing is spread over each number of ranks for one step, as so many
processes on one machine: particles, ghosts, imbalance and bytes of a rank are
counted, times are not. The time t per particle is that of a run on one rank.
The time of a step is then

    imbalance * (particles * t + ghosts * t / 10)
    + messages * latency + bytes / bandwidth
    + collectives * latency * log2(ranks).

A step has two messages to each neighbour (states of ghosts, and loads back) and
five collectives: speeds, sums of loads, and three within the exchange of
Zoltan. Whoever has a cluster puts measured times beside it by --measured.
"""
import argparse
import json
import math
import os
import pathlib
import subprocess
import tempfile

from bench_runs import table

COLLECTIVES = 5


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--packing", required=True)
    parser.add_argument("--ranks", default="16,64,256",
                        type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--geometry", default="sphere")
    parser.add_argument("--steps", type=int, default=200,
                        help="of the run on one rank")
    parser.add_argument("--latency", type=float, default=1.5e-6, help="[s]")
    parser.add_argument("--bandwidth", type=float, default=1e10,
                        help="of a rank [B/s]")
    parser.add_argument("--neighbours", type=int, default=12)
    parser.add_argument("--measured", default="",
                        help="ms per step, by ranks: 16:0.4,64:0.2")
    parser.add_argument("--mpirun", default="mpirun --oversubscribe "
                        "--bind-to none --mca mpi_yield_when_idle 1")
    return parser.parse_args()


def run(options, ranks, steps):
    """What `spall bench` found."""
    with tempfile.TemporaryDirectory() as folder:
        result = pathlib.Path(folder) / "bench.json"
        words = [*options.mpirun.split(), "-n", ranks, options.program, "bench",
                 "--packing", options.packing, "--geometry", options.geometry,
                 "--steps", steps, "--settle", 1, "--threads", 1,
                 "--repeat", 1, "--json", result]
        subprocess.run(list(map(str, words)), check=True,
                       stdout=subprocess.DEVNULL,
                       env={**os.environ, "OMP_NUM_THREADS": "1"})
        return json.loads(result.read_text())


def seconds(options, ranks, counts, n_particles, of_particle):
    """Of a step, and the part of it that is communication."""
    work = counts["imbalance_1"] * of_particle * (
        n_particles / ranks + 0.1 * counts["mean_ghosts"])
    waiting = (2 * options.neighbours * options.latency +
               counts["most_bytes_per_step"] / options.bandwidth +
               COLLECTIVES * options.latency * math.log2(ranks))
    return work + waiting, waiting


def main():
    options = arguments()
    measured = {int(pair.split(":")[0]): float(pair.split(":")[1])
                for pair in options.measured.split(",") if pair}
    alone = run(options, 1, options.steps)
    n_particles = alone["particles"]
    one = alone["median"]["wall_s"] / options.steps
    rows = []
    for ranks in options.ranks:
        counts = run(options, ranks, 1)["median"]
        step, waiting = seconds(options, ranks, counts, n_particles,
                                one / n_particles)
        rows.append([
            ranks, f"{n_particles / ranks:.0f}", f"{counts['mean_ghosts']:.0f}",
            f"{counts['most_ghosts']:.0f}", f"{counts['imbalance_1']:.3f}",
            f"{1e-3 * counts['most_bytes_per_step']:.0f}",
            f"{1e3 * step:.3f}", f"{100 * waiting / step:.0f}",
            f"{one / step / ranks:.2f}",
            f"{measured[ranks]:.3f}" if ranks in measured else ""])
    print(f"{n_particles} particles, {1e3 * one:.2f} ms per step on one rank; "
          f"latency {1e6 * options.latency:g} us, bandwidth "
          f"{1e-9 * options.bandwidth:g} GB/s, {options.neighbours} neighbours\n")
    print(table(["ranks", "particles", "ghosts, mean", "most", "imbalance",
                 "kB per step", "ms per step", "communication %", "efficiency",
                 "measured ms"], rows))


if __name__ == "__main__":
    main()
