#!/usr/bin/env python3
"""docs/pictures/theory_facet_depth.svg: the deepest point of a wall in a
particle, on a face and on a convex edge, and a fold that is concave towards the
particle."""
import math

from svg import GREEN, GREY, INK, LIGHT_BLUE, RED, Drawing, Outline

WIDTH, HEIGHT, PANEL = 780, 260, 260
WAVES = [(2, 0.16, 0.4), (3, 0.05, 1.9)]
MEAN = 72.


def deepest(outline, wall, n=1500):
    """Point of the wall that is deepest, and the point of the outline next to
    it with its normal."""
    ring = [(outline.at(2. * math.pi * k / n), 2. * math.pi * k / n)
            for k in range(n)]
    best = None
    for a, b in zip(wall, wall[1:]):
        for k in range(201):
            s = k / 200.
            y = (a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]))
            if not outline.contains(y):
                continue
            x, angle = min(ring, key=lambda p: math.dist(p[0], y))
            depth = math.dist(x, y)
            if best is None or depth > best[0]:
                best = (depth, y, x, outline.normal(angle))
    return best[1:]


def panel(drawing, number, wall, centre, words):
    left = number * PANEL
    outline = Outline((centre[0] + left, centre[1]), MEAN, WAVES)
    wall = [(x + left, y) for x, y in wall]
    drawing.polygon(outline.points(), fill=LIGHT_BLUE)
    drawing.line(*wall, stroke=INK, width=2.4)
    for p in wall[1:-1]:
        drawing.dot(*p, colour=INK, radius=2.6)
    y, x, n = deepest(outline, wall)
    drawing.line(x, y, stroke=GREEN, width=2.4)
    drawing.dot(*x, colour=GREEN)
    drawing.dot(*y, colour=RED)
    middle = ((x[0] + y[0]) / 2., (x[1] + y[1]) / 2.)
    drawing.arrow(*y, y[0] + 46. * n[0], y[1] + 46. * n[1], colour=RED,
                  width=2.)
    drawing.text(y[0] + 54. * n[0] + 8., y[1] + 54. * n[1] - 6., "n",
                 colour=RED, is_italic=True)
    drawing.text(y[0] - 12., y[1] + 8., "y", anchor="end", colour=RED,
                 is_italic=True)
    drawing.text(x[0] - 10., x[1] - 12., "x", anchor="end", colour=GREEN,
                 is_italic=True)
    drawing.text(middle[0] + 8., middle[1] - 4., "D", anchor="start",
                 colour=GREEN, is_italic=True)
    drawing.text(left + 130., 14., words, size=12, colour=GREY)


def main():
    drawing = Drawing(WIDTH, HEIGHT,
                      "Depth of a wall in a particle on a face, "
                      "an edge and a concave fold",
                      is_upward=True)
    panel(drawing, 0, [(10., 106.), (130., 106.), (250., 106.)], (130., 150.),
          "face: n is its normal")
    panel(drawing, 1, [(10., 60.), (150., 122.), (250., 66.)], (130., 164.),
          "convex edge: n is between its faces")
    panel(drawing, 2, [(8., 150.), (120., 66.), (232., 182.)], (130., 150.),
          "concave fold: the deeper of two maxima")
    drawing.save("theory_facet_depth")


if __name__ == "__main__":
    main()
