#!/usr/bin/env python3
"""Errors of jumps over load cycles, against what a specimen comes to.

    jump_errors.py STUDY.csv [--csv FILE]

STUDY.csv is that of data/studies/cycle_jump.prm or cycle_jump_large.prm. Growth
comes in bursts on which the last digit decides, so that one run of every cycle
is one draw: for each seed jumps are compared with the mean of all runs of every
cycle, and the standard deviation of one of those is given beside them where
there are several.
"""
import csv
import statistics
import sys

from bench_runs import csv_option, group, table, write_csv

OUTCOMES = {"permanent_axial_strain_1": "strain", "laa_percent": "abrasion",
            "n_events": "events", "coordination_end_1": "coordination number",
            "mean_contact_force_end_N": "mean force",
            "resilient_modulus_Pa": "resilient modulus",
            "loading_processor_s": "processor time"}


def per_cent(part):
    return f"{100 * part:+.1f} %".replace("-", "−")


def means(rows):
    return {name: statistics.mean(float(row[name]) for row in rows)
            for name in OUTCOMES}


def compared(seed, rows):
    """Rows of the table: the jumps of this seed, their mean, the spread."""
    jumps = [row for row in rows if row["Variants"].startswith("jump")]
    every = [row for row in rows if row not in jumps]
    true = means(every)
    for row in jumps:
        yield [seed, row["Variants"],
               *(per_cent(float(row[name]) / true[name] - 1.)
                 for name in OUTCOMES)]
    if len(jumps) > 1:
        yield [seed, f"mean of the {len(jumps)} with jumps",
               *(per_cent(value / true[name] - 1.)
                 for name, value in means(jumps).items())]
    if len(every) > 1:
        yield [seed, f"one of {len(every)} runs of every cycle",
               *("± " + per_cent(statistics.stdev(float(row[name])
                                                  for row in every) /
                                 true[name])[1:] for name in OUTCOMES)]


def main():
    path = csv_option(sys.argv)
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["is_done_1"] == "1"]
    lines = [line for (seed,), of_seed in group(rows, "seed").items()
             for line in compared(seed, of_seed)]
    print(table(["seed", "", *OUTCOMES.values()], lines))
    if path:
        write_csv(path, ["seed", "run", *(f"{name} (%)"
                                          for name in OUTCOMES.values())],
                  lines)


if __name__ == "__main__":
    main()
