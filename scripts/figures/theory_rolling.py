#!/usr/bin/env python3
"""docs/pictures/theory_rolling.svg: springs, dashpots and sliders of a contact
in the normal, the tangential and the rolling direction."""
import math

from svg import BLUE, GREY, LIGHT_BLUE, RED, Drawing, subscripts

WIDTH, HEIGHT, PANEL = 780, 270, 260


def slider(drawing, p, words):
    """A block on a rough line."""
    x, y = p
    drawing.polygon([(x - 9, y + 5), (x + 9, y + 5), (x + 9, y - 5),
                     (x - 9, y - 5)], fill="#ffffff")
    drawing.line((x - 14, y - 6.5), (x + 14, y - 6.5), width=1.)
    for k in range(5):
        drawing.line((x - 12 + 6 * k, y - 7), (x - 16 + 6 * k, y - 12),
                     width=0.8)
    drawing.text(x, y - 27, words, size=12, colour=GREY)


def normal(drawing):
    drawing.text(130, HEIGHT - 24, "normal", is_bold=True)
    drawing.circle(130, 60, 42, fill=LIGHT_BLUE)
    drawing.circle(130, 196, 42, fill=LIGHT_BLUE)
    drawing.text(130, 36, "A", is_bold=True)
    drawing.text(130, 208, "B", is_bold=True)
    for x in (112, 148):
        drawing.line((130, 102), (x, 108), width=1.)
        drawing.line((130, 154), (x, 148), width=1.)
    drawing.spring((112, 108), (112, 148))
    drawing.dashpot((148, 108), (148, 148))
    drawing.text(98, 124, subscripts("F_n"), anchor="end", is_italic=True)
    drawing.text(164, 124, subscripts("2β_n √(m*k_n )"), anchor="start",
                 size=12)
    drawing.arrow(30, 108, 30, 150, colour=RED)
    drawing.text(30, 158, "n", colour=RED, is_italic=True)


def shear(drawing):
    left = PANEL
    drawing.text(left + 130, HEIGHT - 24, "shear", is_bold=True)
    drawing.line((left + 34, 60), (left + 34, 200), width=2.)
    drawing.line((left + 216, 60), (left + 216, 200), width=2.)
    drawing.text(left + 26, 208, "A", is_bold=True)
    drawing.text(left + 224, 208, "B", is_bold=True)
    drawing.line((left + 34, 150), (left + 62, 150))
    slider(drawing, (left + 71, 150), subscripts("f F_n"))
    drawing.line((left + 80, 150), (left + 110, 150))
    drawing.line((left + 110, 110), (left + 110, 190))
    drawing.spring((left + 110, 190), (left + 188, 190))
    drawing.dashpot((left + 110, 110), (left + 188, 110))
    drawing.line((left + 188, 110), (left + 188, 190))
    drawing.line((left + 188, 150), (left + 216, 150))
    drawing.text(left + 149, 204, subscripts("k_s"), is_italic=True)
    drawing.text(left + 149, 86, subscripts("2β_s √(m*k_s )"), size=12)
    drawing.arrow(left + 100, 40, left + 160, 40, colour=RED)
    drawing.text(left + 172, 36, "s", colour=RED, is_italic=True)


def rolling(drawing):
    left = 2 * PANEL
    drawing.text(left + 130, HEIGHT - 24, "rolling", is_bold=True)
    centre, radius = (left + 80, 124), 62.
    drawing.line((left + 10, 62), (left + 150, 62), width=2.)
    drawing.circle(*centre, radius, fill=LIGHT_BLUE)
    drawing.dot(*centre)
    drawing.dot(centre[0], 62, colour=RED)
    drawing.line(centre, (centre[0], 62), stroke=BLUE)
    drawing.text(centre[0] + 8, 86, "r", anchor="start", colour=BLUE,
                 is_italic=True)
    arc = [(centre[0] + 40 * math.cos(math.radians(t)),
            centre[1] + 40 * math.sin(math.radians(t)))
           for t in range(150, 30, -5)]
    drawing.line(*arc, stroke=RED, width=1.8)
    drawing.arrow(*arc[-2], *arc[-1], colour=RED)
    drawing.text(centre[0], centre[1] + 46, "θ", colour=RED, is_italic=True)
    drawing.arrow(centre[0], 206, centre[0], 189, colour=GREY, width=1.4)
    # Moment over the rotation: elastic up to the limit.
    x, y = left + 160, 84
    drawing.arrow(x, y, x + 76, y, colour=GREY, width=1.)
    drawing.arrow(x, y, x, y + 88, colour=GREY, width=1.)
    drawing.line((x, y), (x + 26, y + 56), (x + 66, y + 56), stroke=RED,
                 width=2.)
    drawing.line((x, y + 56), (x + 26, y + 56), stroke=GREY, width=1.,
                 dash="3 3")
    drawing.text(x + 84, y - 4, "θ", anchor="start", is_italic=True, size=12)
    drawing.text(x + 6, y + 94, subscripts("M_r"), anchor="start",
                 is_italic=True, size=12)
    drawing.text(x + 44, y + 63, subscripts("f_r R F_n"), size=11)
    drawing.text(x + 22, y + 22, subscripts("k_r"), anchor="start",
                 is_italic=True, size=12)


def main():
    drawing = Drawing(WIDTH, HEIGHT,
                      "Springs, dashpots and sliders of a "
                      "contact, and rolling resistance",
                      is_upward=True)
    normal(drawing)
    shear(drawing)
    rolling(drawing)
    drawing.save("theory_rolling")


if __name__ == "__main__":
    main()
