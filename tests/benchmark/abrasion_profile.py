#!/usr/bin/env python3
"""Where in a specimen particles break.

    abrasion_profile.py FOLDER [--csv FILE]

FOLDER is that of a study of triaxial tests. For every combination of its keys
the table has, for each fifth of the height from the base on, the abrasion of
the particles whose centre lies there at the end, over that of the specimen, as
mean and standard deviation of the specimens; and the shares that the tenth of
the particles with the greatest loss has of the lost volume, and the contacts
with plates and sides.
"""
import collections
import csv
import math
import pathlib
import statistics
import sys

from bench_runs import csv_option, group, table, write_csv

N_LAYERS = 5
PARTICLE = "0"  # kind_1 of events.csv: the other side is a particle


def rows_of(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def profile(folder):
    """Abrasion of each layer over that of the specimen, the share of the most
    worn tenth of the particles, and that of the boundary [-]; nothing without
    breakage."""
    particles = rows_of(folder / "particles.csv")
    lost, at_boundary = collections.Counter(), 0.
    for event in rows_of(folder / "events.csv"):
        volume = float(event["removed_volume_m3"])
        lost[int(event["particle_1"])] += volume
        if event["kind_1"] != PARTICLE:
            at_boundary += volume
    total = sum(lost.values())
    if not total:
        return None
    lowest = min(float(row["z"]) - float(row["radius"]) for row in particles)
    highest = max(float(row["z"]) + float(row["radius"]) for row in particles)
    whole, lost_by_layer = [0.] * N_LAYERS, [0.] * N_LAYERS
    for index, row in enumerate(particles):
        share = (float(row["z"]) - lowest) / (highest - lowest)
        layer = int(N_LAYERS * share)
        whole[layer] += (4. / 3. * math.pi * float(row["radius"])**3 +
                         lost[index])
        lost_by_layer[layer] += lost[index]
    mean = total / sum(whole)
    most_worn = sorted(lost.values())[-round(0.1 * len(particles)):]
    return [*(part / volume / mean
              for part, volume in zip(lost_by_layer, whole)),
            sum(most_worn) / total, at_boundary / total]


def main():
    path = csv_option(sys.argv)
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    cases = [row for row in rows_of(folder / "study.csv")
             if row["is_done_1"] == "1"]
    names = list(cases[0])
    keys = names[2:names.index("seed")]
    head = [*keys, "specimens"]
    for name in [*(f"layer {layer + 1}" for layer in range(N_LAYERS)),
                 "most worn tenth", "boundary"]:
        head += [name, f"{name} deviation"]
    lines = []
    for values, of_case in group(cases, *keys).items():
        runs = [profile(folder / case["run"]) for case in of_case]
        if None in runs:
            continue
        cells = [len(runs)]
        for column in zip(*runs):
            cells += [f"{statistics.mean(column):.3g}",
                      f"{statistics.stdev(column):.2g}"
                      if len(column) > 1 else ""]
        lines.append([*values, *cells])
    print(table(head, lines))
    if path:
        write_csv(path, head, lines)


if __name__ == "__main__":
    main()
