#!/usr/bin/env python3
"""docs/pictures/theory_cycle_jump.svg: the phases of a jump over load cycles
on the permanent strain over the cycle number."""
import math

from svg import BLUE, GREEN, GREY, INK, LIGHT_BLUE, PALE, RED, Drawing

WIDTH, HEIGHT = 780, 300
LEFT, BOTTOM, RIGHT, TOP = 60., 84., 750., 268.
# Phase, simulated cycles, cycles that it advances, colour.
PHASES = [("observation", 4, 4, LIGHT_BLUE),
          ("damage cycles", 4, 20, "#fae3dc"),
          ("extrapolation", 1, 1, "#d7e8d0"),
          ("re-equilibration", 7, 7, PALE),
          ("observation", 4, 4, LIGHT_BLUE)]
LAST = sum(phase[2] for phase in PHASES)


def strain(cycle):
    return math.log(1. + cycle / 6.) / math.log(1. + LAST / 6.)


def at(cycle, value):
    return (LEFT + cycle / LAST * (RIGHT - LEFT),
            BOTTOM + value * (TOP - BOTTOM - 24.))


def main():
    drawing = Drawing(WIDTH, HEIGHT,
                      "Phases of a jump over load cycles",
                      is_upward=True)
    begin = 0.
    for name, n, advanced, colour in PHASES:
        end = begin + advanced
        drawing.polygon([at(begin, 0.), at(end, 0.), (at(end, 0.)[0], TOP),
                         (at(begin, 0.)[0], TOP)], fill=colour, stroke="none")
        middle = at(0.5 * (begin + end), 0.)[0]
        if name == "extrapolation":
            drawing.line((middle, 36.), (middle, BOTTOM - 8.), stroke=GREY,
                         width=0.8)
            drawing.text(middle, 24., name, size=12)
        else:
            drawing.text(middle, 62., name, size=12)
        drawing.text(middle, 46. if name != "extrapolation" else 10.,
                     f"{n} simulated" if name != "damage cycles" else
                     f"{n} simulated, each for 5", size=11, colour=GREY)
        begin = end
    drawing.arrow(LEFT, BOTTOM, RIGHT + 20., BOTTOM)
    drawing.arrow(LEFT, BOTTOM, LEFT, TOP + 16.)
    drawing.text(RIGHT + 16., BOTTOM + 8., "c", anchor="start", is_italic=True)
    drawing.text(LEFT - 10., TOP + 6., "ε", anchor="end", is_italic=True)
    # Expected growth, and the strain of the simulated cycles.
    drawing.line(*[at(c / 4., strain(c / 4.)) for c in range(4 * LAST + 1)],
                 stroke=GREY, width=1.4, dash="5 3")
    drawing.text(at(17., 0.)[0], at(17., strain(17.))[1] + 12.,
                 "power law through both rates", anchor="end", colour=GREY,
                 size=12)
    first = [at(c / 4., strain(c / 4.)) for c in range(17)]
    drawing.line(*first, stroke=BLUE, width=2.4)
    damaged = [at(4. + 5. * k / 4., strain(4.) + 0.11 * k / 16.)
               for k in range(17)]
    drawing.line(*damaged, stroke=RED, width=2.4)
    jump = [damaged[-1], at(25., strain(25.) - 0.02)]
    drawing.line(*jump, stroke=GREEN, width=2.4)
    rest = [jump[-1]] + [at(25. + k / 2., strain(25.) - 0.02
                            + 0.75 * (strain(25. + k / 2.) - strain(25.)))
                         for k in range(1, 15)]
    drawing.line(*rest, stroke=INK, width=2.4)
    offset = rest[-1][1] - at(32., strain(32.))[1]
    last = [at(32. + k / 2., strain(32. + k / 2.)) for k in range(9)]
    drawing.line(*[(p[0], p[1] + offset) for p in last], stroke=BLUE,
                 width=2.4)
    end, want = at(36., strain(36.)), at(36., strain(36.))[1] + offset
    drawing.line((end[0] - 2., want), (end[0] + 14., want), stroke=RED,
                 width=0.8)
    drawing.line((end[0] - 2., end[1]), (end[0] + 14., end[1]), stroke=RED,
                 width=0.8)
    drawing.text(end[0] - 6., end[1] + 8., "error", anchor="end", colour=RED,
                 size=12)
    drawing.text(LEFT + 8., TOP - 8., "permanent strain", anchor="start",
                 colour=GREY, size=12)
    drawing.save("theory_cycle_jump")


if __name__ == "__main__":
    main()
