#!/usr/bin/env python3
"""Where jumps over load cycles lose or gain growth: what each has brought,
against a run of every cycle.

    jump_parts.py EVERY,JUMP [EVERY,JUMP ...] [--csv FILE]

Each pair names the folders of two runs of one specimen. From the last cycle
before the wear to where the observation after it begins (CycleJump/settled and
observed as by default), in per cent of what the run of every cycle has grown by
there: `brought`; `its rates`: the power law through the rates that the run with
jumps has observed on both sides, by which it is judged; `true rates`: the same
law through those of the run of every cycle in the same cycles. Then the rates
observed after the jumps over the true ones. Sums over all jumps of a pair, and
the worst single one of what was brought and of the rates.
"""
import sys

from after_jumps import cycles_of
from bench_runs import csv_option, table, write_csv
from jump_errors import per_cent
from jump_floor import gain

SETTLED, OBSERVED = 7, 4


def jumps_of(cycles):
    """The last cycle before each wear, and the last of the wear."""
    for (cycle, stands_for, _), (_, its, _) in zip(cycles, cycles[1:]):
        if stands_for == 1 and its > 1:
            start = cycle
        elif stands_for > 1 and its == 1:
            yield start, cycle


def parts(every, jump, jumps):
    """Of each: true, brought, by its rates, by true rates, rate after, true."""
    def rate(run, end):
        return (run[end] - run[end - OBSERVED]) / OBSERVED
    for start, worn in jumps:
        begin = worn + 1 + SETTLED
        end = begin + OBSERVED
        if end not in jump or end not in every:
            continue
        laws = [gain((start - OBSERVED / 2, rate(run, start)),
                     (end - OBSERVED / 2, rate(run, end)), start, begin)
                for run in (jump, every)]
        yield (every[begin] - every[start], jump[begin] - jump[start], *laws,
               rate(jump, end), rate(every, end))


def worst(ratios):
    return max((ratio - 1 for ratio in ratios), key=abs)


def main():
    path = csv_option(sys.argv)
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    lines = []
    for pair in sys.argv[1:]:
        every, jump = map(cycles_of, pair.split(","))
        jumps = list(jumps_of(jump))
        for k, name in enumerate(("strain", "abrasion")):
            found = list(parts(*({cycle: values[k] for cycle, _, values in run}
                                 for run in (every, jump)), jumps))
            if not found:
                sys.exit(f"{pair}: no jump that was judged")
            true, brought, own, law, after, true_after = map(sum, zip(*found))
            shares = [part / true - 1 for part in (brought, own, law)]
            lines.append([pair.split(",")[1], name, len(found), *map(per_cent, (
                *shares, after / true_after - 1,
                worst(one[1] / one[0] for one in found),
                worst(one[4] / one[5] for one in found)))])
    head = ["run", "growth", "jumps", "brought", "its rates", "true rates",
            "rates after", "worst jump", "worst rate"]
    print(table(head, lines))
    if path:
        write_csv(path, [*head[:3], *(f"{name} (%)" for name in head[3:])],
                  lines)


if __name__ == "__main__":
    main()
