#!/usr/bin/env python3
"""docs/pictures/theory_membrane_contact.svg: a sphere on a membrane of facets,
the contact radius c and the features that carry the sphere."""
import math

from svg import BLUE, GREY, LIGHT_BLUE, RED, Drawing

WIDTH, HEIGHT = 780, 300


def profile(drawing):
    """Section: the sheet follows the sphere up to c, then falls off."""
    radius, c, slope = 120., 62., 62. / 120.
    centre = (205., 178.)
    low = centre[1] - radius
    drawing.circle(*centre, radius, fill=LIGHT_BLUE)

    def sheet(x):
        s = abs(x)
        if s <= c:
            return centre[1] - math.sqrt(radius**2 - s**2)
        edge = centre[1] - math.sqrt(radius**2 - c**2)
        return edge + slope * c * math.log(s / c)

    cell = 25.
    nodes = [(centre[0] + x, sheet(x))
             for x in [cell * k for k in range(-7, 8)]]
    drawing.line(*nodes, stroke=RED, width=2.2)
    for p in nodes:
        drawing.dot(*p, colour=RED, radius=3.)
    drawing.dot(*centre)
    drawing.arrow(*centre, centre[0], centre[1] - 62.)
    drawing.text(centre[0] + 8, centre[1] - 50, "W", anchor="start",
                 is_italic=True)
    drawing.line(centre, (centre[0] - 104., centre[1] + 60.), stroke=BLUE)
    drawing.text(centre[0] - 58, centre[1] + 42, "R", colour=BLUE,
                 is_italic=True)
    drawing.arrow(centre[0], low - 24., centre[0] + c, low - 24., colour=BLUE,
                  is_double=True)
    drawing.text(centre[0] + c / 2, low - 42., "c", colour=BLUE,
                 is_italic=True)
    for x in (0., c):
        drawing.line((centre[0] + x, low - 30.),
                     (centre[0] + x, sheet(x)), stroke=BLUE, width=0.8,
                     dash="3 3")
    end = nodes[-1]
    drawing.arrow(*end, end[0] + 40., end[1] + 11., colour=RED)
    drawing.text(end[0] + 34., end[1] + 20., "T", colour=RED, is_italic=True)


def seen_from_above(drawing):
    """Quads as four triangles each; features that the sphere overlaps."""
    left, bottom, cell, n = 470., 62., 56., 4
    middle, reach = (left + 1.6 * cell, bottom + 1.7 * cell), 66.

    def node(i, j):
        return (left + i * cell, bottom + j * cell)

    for i in range(n):
        for j in range(n - 1):
            corners = [node(i, j), node(i + 1, j), node(i + 1, j + 1),
                       node(i, j + 1)]
            centre = (left + (i + 0.5) * cell, bottom + (j + 0.5) * cell)
            for a, b in zip(corners, corners[1:] + corners[:1]):
                third = ((a[0] + b[0] + centre[0]) / 3,
                         (a[1] + b[1] + centre[1]) / 3)
                is_in = math.dist(third, middle) < reach
                drawing.polygon([a, b, centre],
                                fill=LIGHT_BLUE if is_in else "#ffffff",
                                stroke=GREY, width=0.8)
    drawing.circle(*middle, reach, stroke=RED, width=2., dash="5 3")
    for i in range(n + 1):
        for j in range(n):
            p = node(i, j)
            if math.dist(p, middle) < reach:
                drawing.dot(*p, colour=RED, radius=4.)
    for i in range(n):
        for j in range(n - 1):
            p = (left + (i + 0.5) * cell, bottom + (j + 0.5) * cell)
            if math.dist(p, middle) < reach:
                drawing.dot(*p, colour=BLUE, radius=3.)
    drawing.text(582, 36, "facets +1, edges −1, vertices +1", size=13)


def main():
    drawing = Drawing(WIDTH, HEIGHT,
                      "A sphere on a membrane of facets",
                      is_upward=True)
    profile(drawing)
    seen_from_above(drawing)
    drawing.text(60, HEIGHT - 284, "section", colour=GREY, size=12)
    drawing.text(582, HEIGHT - 284, "seen along the normal", colour=GREY,
                 size=12)
    drawing.save("theory_membrane_contact")


if __name__ == "__main__":
    main()
