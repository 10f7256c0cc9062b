#!/usr/bin/env python3
"""Coupling, stages of a run and membrane, into docs/pictures.

    python3 scripts/figures/mechanics.py
"""
import math

from svg import (BLUE, GREEN, GREY, INK, ORANGE, PALE, RED, ROCK, STEEL,
                 Drawing, particle_outline)


def coupling_window():
    d = Drawing(720, 330, "One coupling window: particles take small steps "
                "while the surface moves evenly to its target, then the body "
                "takes its step with the mean load")
    x1, x2 = 150, 560
    for x, words in ((x1, "start"), (x2, "end of the window")):
        d.line((x, 34), (x, 290), stroke=GREY, dash="4 3", width=1)
        d.text(x, 24, words, size=12)
    d.text(x1 - 14, 74, "particles", anchor="end")
    d.arrow(x1 - 6, 70, x2 + 60, 70)
    n = 8
    for k in range(n + 1):
        x = x1 + (x2 - x1) * k / n
        d.line((x, 63), (x, 77), width=1.6)
        if k < n:
            d.arrow(x + 5, 58, x + (x2 - x1) / n - 5, 58, colour=BLUE, width=1,
                    head=5)
    d.text(0.5 * (x1 + x2), 48, "particle_steps steps: half step, contacts, "
           "breakage, half step", size=12, colour=BLUE)
    d.text(x1 - 14, 150, "surface", anchor="end")
    d.text(x1 - 14, 166, "seen by particles", anchor="end", size=11,
           colour=GREY)
    d.line((x1, 170), (x2, 128), stroke=GREEN, width=2.2)
    for x, y, words in ((x1, 170, "s0"), (x2, 128, "s1")):
        d.circle(x, y, 4, fill=GREEN, stroke=GREEN)
        d.text(x + 10, y - 6, words, anchor="start", colour=GREEN)
    d.text(0.5 * (x1 + x2), 128, "moves straight and evenly to a prediction",
           size=12, colour=GREEN)
    d.text(x1 - 14, 250, "body", anchor="end")
    d.text(x1 - 14, 266, "finite elements", anchor="end", size=11, colour=GREY)
    d.arrow(x1 - 6, 256, x2 + 60, 256)
    for x in (x1, x2):
        d.line((x, 248), (x, 264), width=1.6)
    d.arrow(x1 + 6, 240, x2 - 6, 240, colour=ORANGE, width=1.6)
    d.text(0.5 * (x1 + x2), 230, "body_steps steps with the mean load: "
           "impulse of the contacts over the window", size=12, colour=ORANGE)
    d.arrow(x2 - 70, 80, x2 - 70, 214, colour=ORANGE)
    d.text(x2 - 78, 200, "loads", anchor="end", size=12, colour=ORANGE)
    d.circle(x2, 256, 4, fill=ORANGE, stroke=ORANGE)
    d.text(x2 + 10, 276, "x1", anchor="start", colour=ORANGE)
    d.arrow(x2 + 16, 240, x2 + 16, 142, colour=RED)
    for k, words in enumerate(("one_pass: next window,", "gap s1 - x1 in the",
                               "ledger", "iterated: repeat until",
                               "the gap is small")):
        d.text(x2 + 24, 168 + 15 * k, words, anchor="start", size=11,
               colour=RED if k < 3 else INK)
    d.text(0.5 * (x1 + x2), 312, "every_step: particles and body take the "
           "same step, a window has one step and no lag", size=12)
    d.save("coupling_window")


def run_stages():
    d = Drawing(720, 150, "From a case to a report: check, run, files, report")
    boxes = (("case.prm", "sections, keys", "text file"),
             ("spall check", "particles, step,", "time, memory"),
             ("spall run", "prepare, consolidate,", "load"),
             ("run folder", "tables, frames,", "checkpoint"),
             ("spall report", "report.html,", "figures"))
    for k, (title, *lines) in enumerate(boxes):
        x = 14 + 142 * k
        d.rect(x, 30, 116, 86, fill=PALE if k % 2 else "#ffffff",
               stroke=STEEL)
        d.text(x + 58, 58, title, is_bold=True,
               colour=BLUE if k in (1, 2, 4) else INK)
        for n, words in enumerate(lines):
            d.text(x + 58, 80 + 16 * n, words, size=12)
        if k + 1 < len(boxes):
            d.arrow(x + 119, 73, x + 140, 73)
    d.save("run_stages")


def membrane():
    d = Drawing(560, 250, "Particles press into a membrane; pressure acts on "
                "its outside; rigid sides leave gaps")
    for k, title in enumerate(("membrane", "rigid side")):
        left = 40 + 270 * k
        d.text(left + 100, 26, title, is_bold=True, size=15)
        for n, (y, r) in enumerate(((70, 26), (126, 30), (184, 26))):
            x = left + 126 - r + (6 if n == 1 and k == 0 else 0)
            d.polygon(particle_outline(x, y, r, 30 + n, 0.06), fill=ROCK,
                      width=1)
            d.polygon(particle_outline(x - 56, y + 14, 24, 40 + n, 0.06),
                      fill=ROCK, width=1)
        if k == 0:
            wave = [(left + 131 + 7 * math.cos(2 * math.pi * (y - 70) / 57.),
                     y) for y in range(44, 216, 3)]
            d.line(*wave, stroke=RED, width=2.6)
        else:
            d.hatching(left + 128, 216, left + 128, 40)
        for y in range(56, 216, 36):
            d.arrow(left + 186, y, left + 152, y, colour=BLUE)
        d.text(left + 190, 236, "pressure" if k == 0 else "servo control",
               colour=BLUE, size=12)
    d.save("membrane_and_rigid_side")


if __name__ == "__main__":
    for draw in (coupling_window, run_stages, membrane):
        draw()
