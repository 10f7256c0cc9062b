#!/usr/bin/env python3
"""Outcomes of a study over its load cycles, means of the specimens.

    cycles_of_study.py FOLDER [--csv FILE]

FOLDER is that of a study of triaxial tests. For every combination of its keys
the table has means and standard deviations over the seeds after cycles 1, 2, 5,
10, ... as far as all seeds came, from cycles.csv of each case. Where cycles
were jumped over a value is linear between two rows.
"""
import csv
import pathlib
import statistics
import sys

from bench_runs import csv_option, group, table, write_csv

COLUMNS = {"permanent_axial_strain_1": "strain (%)",
           "laa_percent": "LAA (%)",
           "coordination_number_1": "coordination number",
           "mean_contact_force_N": "mean contact force (N)",
           "resilient_modulus_Pa": "resilient modulus (MPa)"}
SCALES = {"permanent_axial_strain_1": 100., "resilient_modulus_Pa": 1e-6}
CYCLES = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000]


def after(rows, cycle, column):
    """A column after this cycle; none if the run did not come so far."""
    before = None
    for row in rows:
        x, y = float(row["cycle_1"]), float(row[column])
        if y != y:  # a cycle that was not observed
            continue
        if x == cycle:
            return y
        if x > cycle:
            return before and before[1] + (y - before[1]) * (
                cycle - before[0]) / (x - before[0])
        before = x, y
    return None


def line_of(runs, cycle):
    """Number of seeds, mean and deviation of each column; none if a run did
    not come so far."""
    cells = [len(runs)]
    for column in COLUMNS:
        values = [after(rows, cycle, column) for rows in runs]
        if None in values:
            return None
        values = [SCALES.get(column, 1.) * value for value in values]
        cells += [f"{statistics.mean(values):.4g}",
                  f"{statistics.stdev(values):.2g}" if len(values) > 1 else ""]
    return cells


def main():
    path = csv_option(sys.argv)
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    with open(folder / "study.csv", encoding="utf-8") as file:
        cases = [row for row in csv.DictReader(file) if row["is_done_1"] == "1"]
    names = list(cases[0])
    keys = names[2:names.index("seed")]
    head = keys + ["cycle", "specimens"]
    for name in COLUMNS.values():
        head += [name, name.split(" (")[0] + " deviation"]
    lines = []
    for values, of_case in group(cases, *keys).items():
        runs = []
        for case in of_case:
            with open(folder / case["run"] / "cycles.csv",
                      encoding="utf-8") as file:
                runs.append(list(csv.DictReader(file)))
        for cycle in CYCLES:
            if cells := line_of(runs, cycle):
                lines.append([*values, cycle, *cells])
    print(table(head, lines))
    if path:
        write_csv(path, head, lines)


if __name__ == "__main__":
    main()
