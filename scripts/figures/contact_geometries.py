#!/usr/bin/env python3
"""docs/pictures/contact_geometries.svg: one pair in one pose, with the
overlap, the normal and the contact point of each contact geometry."""
import math

from svg import (BLUE, GREEN, GREY, INK, LIGHT_BLUE, LIGHT_RED, RED, Drawing,
                 Outline, subscripts)

WIDTH, HEIGHT, PANEL = 780, 312, 260
WAVES_A = [(2, 0.14, 0.5), (3, 0.06, 0.2), (5, 0.03, 1.0)]
WAVES_B = [(2, 0.15, 2.3), (3, 0.05, 1.4), (4, 0.03, 0.4)]
A, B, MEAN = (78., 112.), (163., 198.), 68.


def pair(left):
    return (Outline((A[0] + left, A[1]), MEAN, WAVES_A),
            Outline((B[0] + left, B[1]), MEAN, WAVES_B))


def lens(inside, n=720):
    """Polygon of the common area of two regions, by their outlines."""
    points = []
    for own, other in (inside, inside[::-1]):
        points += [p for p in own.points(n) if other.contains(p)]
    middle = (sum(p[0] for p in points) / len(points),
              sum(p[1] for p in points) / len(points))
    return sorted(points, key=lambda p: math.atan2(p[1] - middle[1],
                                                   p[0] - middle[0]))


def common_normal(a, b):
    """Angles of the deepest pair of points with opposite normals."""
    best = None
    for i in range(3600):
        t = 2. * math.pi * i / 3600
        p = a.at(t)
        if not b.contains(p):
            continue
        n = a.normal(t)
        for j in range(720):
            s = 2. * math.pi * j / 720
            m = b.normal(s)
            if n[0] * m[0] + n[1] * m[1] > -0.9999:
                continue
            q = b.at(s)
            d = (p[0] - q[0], p[1] - q[1])
            depth = d[0] * n[0] + d[1] * n[1]
            across = abs(d[0] * n[1] - d[1] * n[0])
            if depth > 0. and (best is None or across < best[0]):
                best = (across, p, q, n)
    return best[1:]


def particles(drawing, outlines, dashed):
    for outline in outlines:
        if dashed:
            drawing.polygon(outline.points(), stroke=GREY, width=1.,
                            dash="3 3")
        else:
            drawing.polygon(outline.points(), fill=LIGHT_BLUE)


def panel(drawing, number, name, words):
    left = number * PANEL
    drawing.text(left + 130, HEIGHT - 20, name, is_bold=True)
    drawing.text(left + 130, 14, words, colour=GREY, size=12)
    return pair(left)


def along(p, e, length):
    return (p[0] + length * e[0], p[1] + length * e[1])


def marks(drawing, ends, normal, contact, side):
    drawing.arrow(*contact, *along(contact, normal, 52.), colour=RED,
                  width=2.2)
    drawing.text(*along(along(contact, normal, 58.), (-normal[1], normal[0]),
                       10. * side), "n", colour=RED, is_italic=True)
    across = (-normal[1], normal[0])
    shifted = [along(p, across, -34. * side) for p in ends]
    for p, q in zip(ends, shifted):
        drawing.line(p, along(q, across, -4. * side), stroke=RED, width=0.8)
    drawing.line(shifted[0], shifted[1], stroke=RED, width=2.)
    drawing.text(*along(shifted[0], across, -14. * side), "δ", colour=RED,
                 is_italic=True)
    drawing.dot(*contact, colour=RED)


def main():
    drawing = Drawing(WIDTH, HEIGHT,
                      "Overlap, normal and contact point of the three "
                      "contact geometries",
                      is_upward=True)
    angle = math.atan2(B[1] - A[1], B[0] - A[0])
    u = (math.cos(angle), math.sin(angle))

    a, b = panel(drawing, 0, "sphere", "equivalent spheres, normal = branch")
    spheres = [Outline(a.centre, MEAN, []), Outline(b.centre, MEAN, [])]
    for sphere in spheres:
        drawing.circle(*sphere.centre, MEAN, fill=LIGHT_BLUE)
    particles(drawing, (a, b), True)
    drawing.polygon(lens(tuple(spheres)), fill=LIGHT_RED, stroke="none")
    ends = [along(a.centre, u, MEAN), along(b.centre, u, -MEAN)]
    drawing.line(a.centre, b.centre, stroke=BLUE, width=1.)
    marks(drawing, ends, u, ((ends[0][0] + ends[1][0]) / 2,
                             (ends[0][1] + ends[1][1]) / 2), 1.)

    a, b = panel(drawing, 1, "radial", "radii along the branch")
    particles(drawing, (a, b), False)
    drawing.polygon(lens((a, b)), fill=LIGHT_RED, stroke="none")
    particles(drawing, (a, b), True)
    ends = [a.at(angle), b.at(angle + math.pi)]
    drawing.line(a.centre, b.centre, stroke=BLUE, width=1.)
    drawing.text(a.centre[0] + 12, a.centre[1] + 30, subscripts("r_A"),
                 colour=BLUE, is_italic=True)
    drawing.text(b.centre[0] - 10, b.centre[1] - 40, subscripts("r_B"),
                 colour=BLUE, is_italic=True, anchor="start")
    marks(drawing, ends, u, ((ends[0][0] + ends[1][0]) / 2,
                             (ends[0][1] + ends[1][1]) / 2), 1.)

    a, b = panel(drawing, 2, "surface", "common normal of both surfaces")
    particles(drawing, (a, b), False)
    drawing.polygon(lens((a, b)), fill=LIGHT_RED, stroke="none")
    particles(drawing, (a, b), True)
    p, q, n = common_normal(a, b)
    marks(drawing, [p, q], n, ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2), 1.)
    drawing.text(p[0] + 2, p[1] + 12, subscripts("x_A"), colour=GREEN, size=12,
                 anchor="start")
    drawing.text(q[0] - 6, q[1] - 16, subscripts("x_B"), colour=GREEN, size=12,
                 anchor="end")
    drawing.dot(*p, colour=GREEN, radius=2.4)
    drawing.dot(*q, colour=GREEN, radius=2.4)
    for left in range(3):
        for centre, name, side in ((A, "A", -14), (B, "B", 10)):
            drawing.dot(centre[0] + PANEL * left, centre[1], colour=INK,
                        radius=2.4)
            drawing.text(centre[0] + PANEL * left + side, centre[1] + side / 2,
                         name, is_bold=True)
    drawing.save("contact_geometries")


if __name__ == "__main__":
    main()
