#!/usr/bin/env python3
"""Whether what wears in one run is what wears in another.

    wear_by_particle.py RUN,OTHER [RUN,OTHER ...]

Each pair names the folders of two runs of one specimen. From their events.csv:
how many particles and contacts (of two particles, or of a particle and a boundary) have
lost material in the other run, and how well the volumes that each particle, and
each contact, has lost in both go together: 1 where they are in proportion, 0
where the one says nothing of the other (Pearson's correlation).
"""
import collections
import csv
import pathlib
import statistics
import sys

from bench_runs import table

PARTICLE = "0"  # kind_1 of events.csv: the other side is a particle


def removed(folder):
    """Volume [m^3] by particle, and by contact."""
    particles, contacts = collections.Counter(), collections.Counter()
    with open(pathlib.Path(folder) / "events.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            sides = row["particle_1"], row["other_1"]
            if row["kind_1"] == PARTICLE:
                sides = tuple(sorted(sides))
            volume = float(row["removed_volume_m3"])
            particles[row["particle_1"]] += volume
            contacts[(row["kind_1"], *sides)] += volume
    return particles, contacts


def correlation(one, other):
    keys = sorted(one.keys() | other.keys())
    return statistics.correlation([one[key] for key in keys],
                                  [other[key] for key in keys])


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    lines = []
    for pair in sys.argv[1:]:
        folders = pair.split(",")
        one, other = map(removed, folders)
        lines.append([folders[1], *map(len, other),
                      *(f"{correlation(*maps):.3f}"
                        for maps in zip(one, other))])
    print(table(["run", "particles", "contacts", "by particle", "by contact"], lines))


if __name__ == "__main__":
    main()
