#!/usr/bin/env python3
"""A dense packing on a lattice, as `spall bench` reads it.

    make_packing.py COUNT FILE [--seed N]

Body-centred lattice in a cube, nearest to COUNT particles. Radii are scattered by
0.2 % about 5 mm, ten micrometres as the overlaps in a packing under 30 kPa,
and the lattice is as narrow as it must be for five of the eight nearest
neighbours of a particle to touch it. Cost and memory per particle are then those of
a packing at rest for any count. Particles stand in random order. The same seed
gives the same file. FILE may end in .gz.
"""
import argparse
import gzip
import math
import random

MEAN_RADIUS = 0.005  # [m]
SCATTER = 0.002  # radii are uniform in 1 -+ this [-]
TOUCHING = 5. / 8.  # share of the nearest neighbours


def nearest_distance():
    """Distance at which this share of the pairs touches [m].

    The sum of two radii less its mean has a triangular distribution on
    -+ 2 SCATTER MEAN_RADIUS; the distance is its (1 - TOUCHING) quantile.
    """
    quantile = math.sqrt(2. * (1. - TOUCHING)) - 1.
    return 2. * MEAN_RADIUS * (1. + SCATTER * quantile)


def lattice(n, random_numbers):
    """Rows x, y, z, radius in random order, and the side of the box [m]."""
    nearest = nearest_distance()
    cell = 2. * nearest / math.sqrt(3.)
    # The walls press on the outer layers as these do on each other.
    first = 0.5 * nearest
    particles = []
    for k in range(2 * n ** 3):
        i, shift = k // 2, 0.5 * (k % 2)
        site = (i % n, i // n % n, i // n ** 2)
        radius = MEAN_RADIUS * (1. + SCATTER * random_numbers.uniform(-1., 1.))
        particles.append([first + cell * (p + shift) for p in site] + [radius])
    random_numbers.shuffle(particles)
    return particles, 2. * first + cell * (n - 0.5)


def write(path, particles, side):
    opened = gzip.open if path.endswith(".gz") else open
    with opened(path, "wt", encoding="ascii") as out:
        out.write(f"# box {side:.12g} {side:.12g} {side:.12g}\n")
        out.write("x,y,z,radius\n")
        for particle in particles:
            out.write(",".join(f"{value:.12g}" for value in particle) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("count", type=int)
    parser.add_argument("file")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if options.count < 1:
        parser.error("COUNT must be at least 1")
    n = max(1, round((options.count / 2) ** (1. / 3.)))
    particles, side = lattice(n, random.Random(options.seed))
    write(options.file, particles, side)
    print(f"{options.file}: {len(particles)} particles in a box of {side:.4f} m")


if __name__ == "__main__":
    main()
