#!/usr/bin/env python3
"""One case on several ranks, in turn, and what a whole run pays for them.

    run_ranks.py PROGRAM CASE.prm [--ranks 1,2] [--repeat N] [--mpirun WORDS]
                 [--set Section/key=value ...]

The runs go in turn, so that a slow minute of the machine falls on all. Times
are wall-clock of the whole run, preparation included; `gathered` is what copies
of the whole scene take (rows, checks of the step, checkpoints), `exchange` what
the loading waits for other ranks. The histories must be equal.
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


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("case")
    parser.add_argument("--ranks", default="1,2",
                        type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--set", action="append", default=[])
    return parser.parse_args()


def run(options, ranks, folder):
    """Summary and history of one run."""
    words = [*options.mpirun.split(), "-n", ranks, options.program, "run",
             options.case, "--out", folder, "--overwrite", "--threads", 1]
    for setting in options.set:
        words += ["--set", setting]
    subprocess.run(list(map(str, words)), check=True,
                   stdout=subprocess.DEVNULL,
                   env={**os.environ, "OMP_NUM_THREADS": "1"})
    return (json.loads((folder / "summary.json").read_text()),
            (folder / "history.csv").read_bytes())


def main():
    options = arguments()
    clocks = {ranks: [] for ranks in options.ranks}
    histories = set()
    with tempfile.TemporaryDirectory() as name:
        for _ in range(options.repeat):
            for ranks in options.ranks:
                summary, history = run(options, ranks,
                                       pathlib.Path(name) / str(ranks))
                clocks[ranks].append(summary["wall_clock_s"])
                histories.add(history)
    base = [clock["total"] for clock in clocks[options.ranks[0]]]
    rows = []
    for ranks, runs in clocks.items():
        total = [clock["total"] for clock in runs]
        ratios = [one / other for one, other in zip(base, total)]

        def share(phase, of=runs):
            return statistics.median(clock.get(phase, 0.) / clock["total"]
                                     for clock in of)
        rows.append([ranks, f"{statistics.median(total):.1f}",
                     f"{statistics.median(ratios):.2f} ± "
                     f"{spread(ratios) * statistics.median(ratios):.2f}",
                     f"{100. * share('gathering'):.1f} %",
                     f"{100. * share('step_watch'):.1f} %",
                     f"{100. * share('exchange'):.1f} %"])
    print(table(["ranks", "s", "speed", "gathered", "checks of the step",
                 "exchange"], rows))
    if len(histories) > 1:
        print("the histories differ")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
