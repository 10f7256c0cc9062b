#!/usr/bin/env python3
"""Growth in the cycles after a landing against that of a run of every cycle.

    after_jumps.py EVERY,JUMP [EVERY,JUMP ...]

Each pair names the folders of two runs of one specimen, one with jumps over
load cycles. For each position after the landing, strain and abrasion of that cycle
over those of the other run at the same time, means over all jumps (sums over
sums); the other run is taken over eight cycles before and after. `wear`: the
cycles that stand for many.
"""
import csv
import pathlib
import sys

from bench_runs import table

COLUMNS = ("permanent_axial_strain_1", "laa_percent")
BESIDE = 8  # cycles
SHOWN = 12  # after the landing


def cycles_of(folder):
    with open(pathlib.Path(folder) / "cycles.csv", encoding="utf-8") as file:
        return [(round(float(row["cycle_1"])), float(row["stands_for_1"]),
                 [float(row[column]) for column in COLUMNS])
                for row in csv.DictReader(file)]


def positions(cycles):
    """`wear`, or how many cycles after it; none before the first jump."""
    position = None
    for _, stands_for, _ in cycles[1:]:
        if stands_for > 1:
            position = 0
        elif position is not None:
            position += 1
        yield "wear" if position == 0 else position


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sums = {}
    for pair in sys.argv[1:]:
        every, jump = map(cycles_of, pair.split(","))
        of_cycle = {cycle: values for cycle, _, values in every}
        for position, before, (cycle, stands_for, values) in zip(
                positions(jump), jump, jump[1:]):
            if position is None:
                continue
            first = max(min(of_cycle), before[0] - BESIDE)
            last = min(max(of_cycle), cycle + BESIDE)
            count = sums.setdefault(position, [0, [0., 0.], [0., 0.]])
            count[0] += 1
            for k in range(len(COLUMNS)):
                count[1][k] += (values[k] - before[2][k]) / stands_for
                count[2][k] += ((of_cycle[last][k] - of_cycle[first][k]) /
                                (last - first))
    shown = ["wear", *(n for n in range(1, SHOWN + 1) if n in sums)]
    print(table(["cycle after the wear", "cycles", "strain", "abrasion"],
                [[str(position), str(sums[position][0]),
                  *(f"{mine / other:.2f}"
                    for mine, other in zip(*sums[position][1:]))]
                 for position in shown if position in sums]))


if __name__ == "__main__":
    main()
