#!/usr/bin/env python3
"""What jumps over load cycles could do at best: how well a few cycles tell the
growth of all.

    jump_floor.py CYCLES.csv ...

Each file is that of a run of every cycle. The first twenty cycles and the last
ones are taken as they are; of every so many between only some are looked at,
and between these the growth follows the power law through their rates. No jump,
wear or landing is there, so what is off is what growth in bursts hides from any
extrapolation: mean and standard deviation over all cycles at which the looks
may begin.
"""
import csv
import math
import statistics
import sys

from bench_runs import table

COLUMNS = {"permanent_axial_strain_1": "strain", "laa_percent": "abrasion"}
FIRST = 20
LOOKS = ((11, 66), (4, 44), (11, 110), (4, 100), (4, 200))


def gain(before, after, start, end):
    """Integral of the power law through two (cycle, rate), as PowerLaw."""
    (x_a, r_a), (x_b, r_b) = before, after
    if r_a <= 0 or r_b <= 0:
        slope = (r_b - r_a) / (x_b - x_a)
        return (end - start) * (r_a + slope * ((start + end) / 2 - x_a))
    power = math.log(r_b / r_a) / math.log(x_b / x_a)
    if abs(power + 1) < 1e-6:
        return r_a * x_a * math.log(end / start)
    return r_a * x_a / (power + 1) * ((end / x_a) ** (power + 1) -
                                      (start / x_a) ** (power + 1))


def errors(growth, seen, every):
    """Of the end value, over where the looks begin; growth[c] after c cycles.
    """
    end = len(growth) - 1
    for offset in range(1, every + 1):
        stops = [FIRST, *range(FIRST + seen + offset, end - seen, every), end]
        rates = [(stop - seen / 2, (growth[stop] - growth[stop - seen]) / seen)
                 for stop in stops]
        total = growth[FIRST]
        for k, stop in enumerate(stops[1:]):
            total += gain(rates[k], rates[k + 1], stops[k], stop - seen)
            total += growth[stop] - growth[stop - seen]
        yield total / growth[end] - 1


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    lines = []
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        for seen, every in LOOKS:
            line = [path, f"{seen} of {every}"]
            for column in COLUMNS:
                found = list(errors([0.] + [float(row[column])
                                            for row in rows], seen, every))
                line.append(f"{100 * statistics.mean(found):+.1f} ± "
                            f"{100 * statistics.pstdev(found):.1f} %"
                            .replace("-", "−"))
            lines.append(line)
    print(table(["run", "cycles looked at", *COLUMNS.values()], lines))


if __name__ == "__main__":
    main()
