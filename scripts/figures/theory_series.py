#!/usr/bin/env python3
"""docs/pictures/theory_series.svg: sections of two shapes of data/shapes whose
series are cut at several orders."""
import json
import math
import pathlib

from svg import BLUE, GREEN, GREY, INK, LIGHT_BLUE, RED, Drawing

WIDTH, HEIGHT = 780, 330
SHAPES = pathlib.Path(__file__).resolve().parents[2] / "data/shapes"
CASES = (("rounded_cube/rounded_cube.json", "rounded cube"),
         ("limestone/MA111-7-coarse-00012.json", "scanned limestone"))
ORDERS = ((4, GREEN), (8, BLUE), (20, RED))


def legendre(order, x):
    """P_n^m(x) of all degrees, without the Condon-Shortley phase."""
    root = math.sqrt(max(0., 1. - x * x))
    p = {(0, 0): 1.}
    for m in range(order + 1):
        if m:
            p[m, m] = (2 * m - 1) * root * p[m - 1, m - 1]
        if m < order:
            p[m + 1, m] = (2 * m + 1) * x * p[m, m]
        for n in range(m + 2, order + 1):
            p[n, m] = ((2 * n - 1) * x * p[n - 1, m]
                       - (n + m - 1) * p[n - 2, m]) / (n - m)
    return p


def radius(coefficients, order, z, longitude):
    """The series of docs/theory/shape.md up to an order."""
    p, total = legendre(order, z), 0.
    for n in range(order + 1):
        for m in range(-n, n + 1):
            k = abs(m)
            norm = math.sqrt((2 * n + 1) / (4. * math.pi)
                             * math.factorial(n - k) / math.factorial(n + k))
            wave = (math.sqrt(2.) * math.cos(k * longitude) if m > 0 else
                    math.sqrt(2.) * math.sin(k * longitude) if m < 0 else 1.)
            total += coefficients[n * (n + 1) + m] * norm * p[n, k] * wave
    return total


def section(coefficients, order, n=240):
    """Points of the section across z."""
    points = []
    for k in range(n):
        t = 2. * math.pi * k / n
        r = radius(coefficients, order, 0., t)
        points.append((r * math.cos(t), r * math.sin(t)))
    return points


def main():
    drawing = Drawing(WIDTH, HEIGHT,
                      "Sections of shapes whose series are cut "
                      "at order 4, 8 and 20",
                      is_upward=True)
    for number, (name, words) in enumerate(CASES):
        stored = json.loads((SHAPES / name).read_text(encoding="utf-8"))
        coefficients = stored["coefficients"]
        if isinstance(coefficients[0], list):
            coefficients = sum(coefficients, [])
        highest = math.isqrt(len(coefficients)) - 1
        outer = max(math.hypot(*p) for p in section(coefficients, highest))
        scale = 124. / outer
        centre = (190. + 380. * number, 176.)
        for order, colour in ORDERS:
            points = [(centre[0] + scale * x, centre[1] + scale * y)
                      for x, y in section(coefficients, min(order, highest))]
            drawing.polygon(points, fill=LIGHT_BLUE if order == 4 else "none",
                            stroke=colour, width=1.8,
                            dash="" if order == 20 else "5 3")
        drawing.dot(*centre, colour=INK, radius=2.4)
        drawing.text(centre[0], 24., words, size=13, colour=GREY)
    for k, (order, colour) in enumerate(ORDERS):
        y = 300. - 18. * k
        drawing.line((338., y), (362., y), stroke=colour, width=2.,
                     dash="" if order == 20 else "5 3")
        drawing.text(368., y - 4., f"order {order}", anchor="start",
                     colour=colour, size=12)
    drawing.save("theory_series")


if __name__ == "__main__":
    main()
