#!/usr/bin/env python3
"""Writes the series of the cube x^6 + y^6 + z^6 = a^6, a = 20 mm, as a shape,
or the cube itself as a mesh.

    rounded_cube.py ORDER > SHAPE.json
    rounded_cube.py --mesh N > MESH.obj    N x N quads on each face, in metres

r(s) = a / (x^6 + y^6 + z^6)^(1/6), projected on real orthonormal harmonics by
Gauss-Legendre rings of equal steps. No package is needed.
"""
import json
import math
import sys

HALF_EDGE = 0.02  # a [m]
RINGS = 120


def gauss_legendre(n):
    """Nodes and weights on [-1, 1] by Newton."""
    rule = []
    for k in range(n):
        x = math.cos(math.pi * (k + 0.75) / (n + 0.5))
        for _ in range(100):
            before, value = 1., x
            for m in range(2, n + 1):
                before, value = value, ((2 * m - 1) * x * value -
                                        (m - 1) * before) / m
            slope = n * (x * value - before) / (x * x - 1.)
            x -= value / slope
        rule.append((x, 2. / ((1. - x * x) * slope * slope)))
    return rule


def legendre(order, x):
    """N_nm P_nm(x), no Condon-Shortley phase, rows n, columns m."""
    root = math.sqrt(max(0., 1. - x * x))
    p = [[0.] * (order + 1) for _ in range(order + 1)]
    p[0][0] = math.sqrt(1. / (4. * math.pi))
    for m in range(1, order + 1):
        p[m][m] = math.sqrt((2. * m + 1.) / (2. * m)) * root * p[m - 1][m - 1]
    for m in range(order + 1):
        for n in range(m + 1, order + 1):
            a = math.sqrt((4. * n * n - 1.) / (n * n - m * m))
            b = (math.sqrt(((n - 1.) ** 2 - m * m) / (4. * (n - 1.) ** 2 - 1.))
                 if n - 1 > m else 0.)
            p[n][m] = a * (x * p[n - 1][m] - b * (p[n - 2][m] if n > 1 else 0.))
    return p


def project(order):
    coefficients = [0.] * (order + 1) ** 2
    n_azimuth = 2 * RINGS
    for z, weight in gauss_legendre(RINGS):
        root = math.sqrt(1. - z * z)
        values = []
        for k in range(n_azimuth):
            phi = 2. * math.pi * k / n_azimuth
            x, y = root * math.cos(phi), root * math.sin(phi)
            values.append(HALF_EDGE / (x ** 6 + y ** 6 + z ** 6) ** (1. / 6.))
        p = legendre(order, z)
        for m in range(order + 1):
            share = weight * 2. * math.pi / n_azimuth
            angles = [2. * math.pi * ((m * k) % n_azimuth) / n_azimuth
                      for k in range(n_azimuth)]
            cosine = share * sum(r * math.cos(t)
                                 for r, t in zip(values, angles))
            sine = share * sum(r * math.sin(t) for r, t in zip(values, angles))
            factor = 1. if m == 0 else math.sqrt(2.)
            for n in range(m, order + 1):
                coefficients[n * (n + 1) + m] += factor * p[n][m] * cosine
                if m > 0:
                    coefficients[n * (n + 1) - m] += factor * p[n][m] * sine
    # What symmetry makes zero is left at zero.
    return [a if abs(a) > 1e-15 else 0. for a in coefficients]


def face_point(face, i, j, n):
    """A point of a face on the cube: i, j = 0 .. n at equal angles."""
    axis, side = face // 2, 1. if face % 2 == 0 else -1.
    point = [0., 0., 0.]
    point[axis] = side
    point[(axis + 1) % 3] = side * math.tan(math.pi / 4. * (2. * i / n - 1.))
    point[(axis + 2) % 3] = math.tan(math.pi / 4. * (2. * j / n - 1.))
    scale = HALF_EDGE / sum(x ** 6 for x in point) ** (1. / 6.)
    return tuple(round(scale * x, 12) + 0. for x in point)


def write_mesh(n, out):
    """Points on the exact surface, counter-clockwise from outside."""
    numbers, quads = {}, []
    for face in range(6):
        for i in range(n):
            for j in range(n):
                quads.append([numbers.setdefault(face_point(face, a, b, n),
                                                 len(numbers) + 1)
                              for a, b in ((i, j), (i + 1, j), (i + 1, j + 1),
                                           (i, j + 1))])
    for point in numbers:
        out.write("v {} {} {}\n".format(*point))
    for a, b, c, d in quads:
        out.write(f"f {a} {b} {c}\nf {a} {c} {d}\n")


def main():
    if sys.argv[1] == "--mesh":
        write_mesh(int(sys.argv[2]), sys.stdout)
        return
    order = int(sys.argv[1])
    json.dump({
        "name": "rounded_cube",
        "order": order,
        "convention": "real orthonormal, no Condon-Shortley phase, "
                      "j = n (n + 1) + m",
        "unit": "m",
        "source": "x^6 + y^6 + z^6 = (20 mm)^6, scripts/rounded_cube.py",
        "licence": "LGPL-2.1-or-later, part of Spall",
        "coefficients": project(order)}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
