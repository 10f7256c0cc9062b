#!/usr/bin/env python3
"""Where jumps over load cycles lose or gain growth: what each has brought,
against a run of every cycle.

    jump_parts.py EVERY,JUMP [EVERY,JUMP ...]

Each pair names the folders of two runs of one specimen. From the last cycle
before the wear to where the observation after it begins (CycleJump/settled and
observed as by default), in per cent of what the run of every cycle has grown by
there: `brought`; `its rates`: the power law through the rates that the run with
jumps has observed on both sides, by which it is judged; `true rates`: the same
law through those of the run of every cycle in the same cycles. Then the rates
observed after the jumps over the true ones. Sums over all jumps of a pair, and
the worst single one of what was brought.
"""
import csv
import pathlib
import sys

from bench_runs import table
from jump_floor import COLUMNS, gain

SETTLED, OBSERVED = 7, 4


def growth_of(folder, column):
    """By cycle, and whether it stands for others."""
    with open(pathlib.Path(folder) / "cycles.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return ({round(float(row["cycle_1"])): float(row[column]) for row in rows},
            [(round(float(row["cycle_1"])), float(row["stands_for_1"]) > 1)
             for row in rows])


def jumps_of(cycles):
    """The last cycle before each wear, and the last of the wear."""
    for k in range(1, len(cycles)):
        (before, was_wear), (cycle, is_wear) = cycles[k - 1:k + 1]
        if is_wear and not was_wear:
            start = before
        if is_wear and (k + 1 == len(cycles) or not cycles[k + 1][1]):
            yield start, cycle


def parts(every, jump, cycles):
    """Of each jump: true, brought, by its rates, by true rates, rates after."""
    def rate(run, end):
        return (run[end] - run[end - OBSERVED]) / OBSERVED
    for start, worn in jumps_of(cycles):
        begin = worn + 1 + SETTLED
        end = begin + OBSERVED
        if end not in jump:
            continue
        laws = [gain((start - OBSERVED / 2, rate(run, start)),
                     (end - OBSERVED / 2, rate(run, end)), start, begin)
                for run in (jump, every)]
        yield (every[begin] - every[start], jump[begin] - jump[start], *laws,
               rate(jump, end), rate(every, end))


def per_cent(ratio):
    return f"{100 * (ratio - 1):+.1f} %".replace("-", "−")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    lines = []
    for pair in sys.argv[1:]:
        for column, name in COLUMNS.items():
            (every, _), (jump, cycles) = (growth_of(folder, column)
                                          for folder in pair.split(","))
            found = list(parts(every, jump, cycles))
            true, brought, own, law, after, true_after = map(sum, zip(*found))
            worst = max((one[1] / one[0] for one in found),
                        key=lambda ratio: abs(ratio - 1))
            lines.append([pair.split(",")[1], name, len(found),
                          *(per_cent(part / true)
                            for part in (brought, own, law)),
                          per_cent(after / true_after), per_cent(worst)])
    print(table(["run", "growth", "jumps", "brought", "its rates", "true rates",
                 "rates after", "worst jump"], lines))


if __name__ == "__main__":
    main()
