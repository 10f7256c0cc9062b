#!/usr/bin/env python3
"""Copies of a prepared specimen side by side, as the start of a larger one.

    join_copies.py RUN COUNT FILE [--gap GAP]

RUN is the folder of a run that has ended and in which nothing broke. FILE gets
COUNT copies of its particles along each axis, at rest, as Specimen/particles
reads them. GAP is between the equivalent spheres of two copies, so that
surfaces that reach further do not overlap. Flat particles lie closer to a wall
than their spheres reach: a GAP below 0 may do. The preparation closes what is
left.
"""
import argparse
import csv
import itertools
import pathlib


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("run", type=pathlib.Path)
    words.add_argument("count", type=int)
    words.add_argument("file", type=pathlib.Path)
    words.add_argument("--gap", type=float, default=2e-3,
                       help="between equivalent spheres; may be below 0 [m]")
    options = words.parse_args()
    with open(options.run / "particles.csv", newline="") as stream:
        rows = list(csv.DictReader(stream))
    kept = ("radius", "qw", "qx", "qy", "qz", "shape", "material")
    period = []
    for axis in "xyz":
        ends = [float(row[axis]) + sign * float(row["radius"])
                for row in rows for sign in (-1., 1.)]
        period.append(max(ends) - min(ends) + options.gap)
    with open(options.file, "w", encoding="ascii", newline="") as stream:
        out = csv.writer(stream)
        out.writerow(["x", "y", "z", *kept])
        for copy in itertools.product(range(options.count), repeat=3):
            for row in rows:
                at = [f"{float(row[axis]) + n * step:.9g}"
                      for axis, n, step in zip("xyz", copy, period)]
                out.writerow([*at, *(row[name] for name in kept)])
    print(f"{len(rows) * options.count ** 3} particles, period "
          + " by ".join(f"{p:.4g}" for p in period) + " m")


if __name__ == "__main__":
    main()
