#!/usr/bin/env python3
"""docs/pictures/breakage_event.svg: a corner before and after a breakage
event: cap of the criterion, kernel and new outline."""
import math

from svg import (BLUE, GREY, LIGHT_BLUE, LIGHT_RED, RED, Drawing, Outline,
                 subscripts)

WIDTH, HEIGHT = 780, 330
WAVES = [(2, 0.10, 0.3), (3, 0.13, math.pi / 2), (6, 0.02, math.pi / 2)]
MEAN, DEPTH, WIDTH_OF_KERNEL = 108., 14., 0.26
UP = math.pi / 2


class Chipped(Outline):
    """r - theta exp(-gamma^2 / 2 lambda^2)."""

    def radius(self, angle):
        gamma = (angle - UP + math.pi) % (2. * math.pi) - math.pi
        return super().radius(angle) - DEPTH * math.exp(
            -0.5 * (gamma / WIDTH_OF_KERNEL)**2)


def main():
    drawing = Drawing(WIDTH, HEIGHT,
                      "A particle before and after a breakage "
                      "event",
                      is_upward=True)
    overlap = 2. * DEPTH  # the depth of the patch width, s = 1
    before = Outline((195., 118.), MEAN, WAVES)
    after = Chipped((585., 118.), MEAN, WAVES)
    level = before.at(UP)[1] - overlap
    for left, outline in ((0., before), (390., after)):
        points = outline.points(480)
        drawing.polygon(points, fill=LIGHT_BLUE, stroke="none")
        cap = [p for p in points if p[1] > level]
        if cap:
            cap = sorted(cap, key=lambda p: p[0])
            drawing.polygon(cap, fill=LIGHT_RED, stroke="none")
        drawing.polygon(points)
        drawing.line((left + 30., level), (left + 350., level), stroke=GREY,
                     width=1.2)
        drawing.text(left + 34., level + 7., "other surface", anchor="start",
                     colour=GREY, size=11)
        drawing.dot(*outline.centre)
        drawing.text(left + 195., HEIGHT - 20.,
                     "before" if left == 0. else "after", is_bold=True)
    # Before: overlap, cap, force.
    top = before.at(UP)
    drawing.arrow(195., top[1] + 62., 195., top[1] + 6., colour=RED, width=2.4)
    drawing.text(205., top[1] + 44., "F", anchor="start", colour=RED,
                 is_italic=True)
    drawing.arrow(290., level, 290., top[1], colour=BLUE, width=1.4,
                  is_double=True)
    drawing.line((200., top[1]), (298., top[1]), stroke=BLUE, width=0.8,
                 dash="3 3")
    drawing.text(300., level + 8., "δ", anchor="start", colour=BLUE,
                 is_italic=True)
    drawing.text(120., level + 26., subscripts("A_i , V_i"), anchor="end",
                 colour=RED, size=13)
    drawing.line((124., level + 26.), (178., level + 6.), stroke=RED,
                 width=0.8)
    drawing.line(before.centre, (195., level - 4.), stroke=BLUE, width=1.)
    drawing.text(202., 170., "u", anchor="start", colour=BLUE, is_italic=True)
    # After: old outline, depth, width, smaller force.
    old = Outline(after.centre, MEAN, WAVES)
    drawing.line(*[old.at(UP + 0.9 * (k - 40) / 40) for k in range(81)],
                 stroke=GREY, width=1.2, dash="4 3")
    new = after.at(UP)
    drawing.arrow(585., old.at(UP)[1] + 40., 585., old.at(UP)[1] + 4.,
                  colour=RED, width=1.8)
    drawing.text(592., old.at(UP)[1] + 26., "smaller F", anchor="start",
                 colour=RED, size=13)
    for p, y in ((old.at(UP), 0.), (new, 0.)):
        drawing.line((585., p[1] + y), (676., p[1] + y), stroke=RED,
                     width=0.8, dash="3 3")
    drawing.arrow(670., old.at(UP)[1] + 18., 670., old.at(UP)[1], colour=RED,
                  width=1.)
    drawing.arrow(670., new[1] - 18., 670., new[1], colour=RED, width=1.)
    drawing.text(680., new[1] + 3., "ϑ", anchor="start", colour=RED,
                 is_italic=True)
    for side in (-1., 1.):
        drawing.line(after.centre, old.at(UP + side * WIDTH_OF_KERNEL),
                     stroke=BLUE, width=0.8, dash="3 3")
    arc = [(585. + 58. * math.cos(UP + WIDTH_OF_KERNEL * (1. - k / 10.)),
            118. + 58. * math.sin(UP + WIDTH_OF_KERNEL * (1. - k / 10.)))
           for k in range(11)]
    drawing.line(*arc, stroke=BLUE, width=1.2)
    drawing.text(557., 182., "λ", colour=BLUE, is_italic=True)
    drawing.text(500., old.at(UP)[1] + 26., subscripts("removed: V_i"),
                 anchor="end", size=13, colour=RED)
    drawing.line((503., old.at(UP)[1] + 24.), (572., new[1] + 8.), stroke=RED,
                 width=0.8)
    drawing.save("breakage_event")


if __name__ == "__main__":
    main()
