#!/usr/bin/env python3
"""What a specimen of another width would give: outcomes after so many load
cycles (10 if not given) as a + b / width, since the share of particles at the
walls goes with the inverse of the width.

    size_of_specimen.py CYCLES.csv WIDTH_MM [CYCLE]

CYCLES.csv is the table of claims_size.prm by cycles_of_study.py. The least
squares count a width by its number of specimens. The last column is a check:
the largest specimen by a fit of the smaller ones, less what it gave, over that.
"""
import csv
import sys

OUTCOMES = (("strain without breakage (%)", "strain (%)", "false"),
            ("strain with breakage (%)", "strain (%)", "true"),
            ("abrasion LAA (%)", "LAA (%)", "true"),
            ("coordination number", "coordination number", "true"),
            ("mean contact force (N)", "mean contact force (N)", "true"),
            ("resilient modulus (MPa)", "resilient modulus (MPa)", "true"))


def points_of(rows, column, is_breaking, cycle):
    """(1 / width (1/mm), value, specimens), the narrowest first."""
    return sorted(((1. / float(row["Variants"].removeprefix("mm")),
                    float(row[column]), float(row["specimens"]))
                   for row in rows if row["cycle"] == cycle and
                   row["Breakage/is_active"] == is_breaking), reverse=True)


def fit(points):
    """Offset and slope of the weighted least squares."""
    total = sum(w for _, _, w in points)
    mean_x = sum(w * x for x, _, w in points) / total
    mean_y = sum(w * y for _, y, w in points) / total
    slope = (sum(w * (x - mean_x) * (y - mean_y) for x, y, w in points) /
             sum(w * (x - mean_x) ** 2 for x, _, w in points))
    return mean_y - slope * mean_x, slope


def main():
    if len(sys.argv) not in (3, 4):
        raise SystemExit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    width, cycle = float(sys.argv[2]), (sys.argv[3:] or ["10"])[0]
    print(f"{'outcome':30}{width:6g} mm   largest by the others")
    for name, column, is_breaking in OUTCOMES:
        points = points_of(rows, column, is_breaking, cycle)
        offset, slope = fit(points)
        x, y, _ = points[-1]
        before, rise = fit(points[:-1])
        print(f"{name:30}{offset + slope / width:9.4g}"
              f"{100. * ((before + rise * x) / y - 1.):+16.1f} %")


if __name__ == "__main__":
    main()
