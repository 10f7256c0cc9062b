#!/usr/bin/env python3
"""How contacts, breakage and coupling work, into docs/pictures.

    python3 scripts/figures/mechanics.py
"""
import math

from svg import (BLUE, Drawing, GREEN, GREY, INK, ORANGE, PALE, RED, ROCK,
                 STEEL, particle_outline)


def rounded(x, y, radius, phase):
    """Outline of a particle with three blunt corners."""
    return [(x + radius * (1. + 0.13 * math.cos(3. * a + phase)) * math.cos(a),
             y + radius * (1. + 0.13 * math.cos(3. * a + phase)) * math.sin(a))
            for a in (2. * math.pi * k / 90 for k in range(90))]


def support(outline, n):
    """The point of an outline that lies farthest along n."""
    return max(outline, key=lambda p: p[0] * n[0] + p[1] * n[1])


def common_normal(a, b, start):
    """Direction of the least overlap near an angle, and the two points."""
    best = None
    for k in range(-100, 101):
        n = (math.cos(start + 0.01 * k), math.sin(start + 0.01 * k))
        p, q = support(a, n), support(b, (-n[0], -n[1]))
        overlap = (p[0] - q[0]) * n[0] + (p[1] - q[1]) * n[1]
        if best is None or overlap < best[0]:
            best = (overlap, n, p, q)
    return best


def radius_along(outline, centre, angle):
    """Distance of an outline from its centre in a direction."""
    return min((abs(math.remainder(math.atan2(y - centre[1], x - centre[0])
                                   - angle, 2. * math.pi)),
                math.hypot(x - centre[0], y - centre[1]))
               for x, y in outline)[1]


def contact_geometries():
    d = Drawing(720, 300, "Overlap and contact point of the three contact "
                "geometries: sphere, radial, surface")
    words = {"sphere": ("overlap of the equivalent",
                        "spheres along the branch"),
             "radial": ("overlap of the local radii", "along the branch"),
             "surface": ("overlap of the surfaces along",
                         "their common normal")}
    for k, name in enumerate(words):
        left, size = 20 + 236 * k, 56
        a, b = (left + 60, 172), (left + 154, 118)
        shapes = rounded(*a, size, 2.4), rounded(*b, size, 4.5)
        is_faded = name == "sphere"
        d.text(left + 108, 30, name, is_bold=True, size=15)
        for fill in ("#f3efe8" if is_faded else ROCK, "none"):
            for shape in shapes:
                d.polygon(shape, fill=fill, stroke=GREY if is_faded else INK,
                          width=1.2)
        branch = math.atan2(b[1] - a[1], b[0] - a[0])
        n, length = (math.cos(branch), math.sin(branch)), math.dist(a, b)
        if name == "surface":
            _, n, p, q = common_normal(*shapes, branch)
        else:
            d.line(a, b, stroke=GREY, dash="4 3")
            reach = ((size, size) if is_faded else
                     (radius_along(shapes[0], a, branch),
                      radius_along(shapes[1], b, branch + math.pi)))
            p = (a[0] + reach[0] * n[0], a[1] + reach[0] * n[1])
            q = (b[0] - reach[1] * n[0], b[1] - reach[1] * n[1])
        if is_faded:
            for x, y in (a, b):
                d.circle(x, y, size, stroke=BLUE, dash="5 3")
        for x, y in (a, b):
            d.circle(x, y, 2.5, fill=INK)
        d.line(p, q, stroke=ORANGE, width=3)
        x, y = 0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])
        d.circle(x, y, 3, fill=RED, stroke=RED)
        d.arrow(x, y, x + 44 * n[0], y + 44 * n[1], colour=RED, width=2)
        d.text(x + 50 * n[0] + 7, y + 50 * n[1] + 9, "n", colour=RED,
               is_bold=True)
        for line, of_line in enumerate(words[name]):
            d.text(left + 108, 262 + 17 * line, of_line, size=12)
    d.save("contact_geometries")


def chipped(outline, cx, cy, angle, depth, width):
    """The outline less a kernel of this depth around a direction."""
    points = []
    for x, y in outline:
        radius, at = math.hypot(x - cx, y - cy), math.atan2(y - cy, x - cx)
        gap = math.atan2(math.sin(at - angle), math.cos(at - angle))
        radius -= depth * math.exp(-0.5 * (gap / width) ** 2)
        points.append((cx + radius * math.cos(at), cy + radius * math.sin(at)))
    return points


def corner(cx, cy):
    points = []
    for k in range(180):
        a = 2. * math.pi * k / 180
        gap = math.atan2(math.sin(a - math.pi / 2), math.cos(a - math.pi / 2))
        r = 78. + 24. * math.exp(-0.5 * (gap / 0.33) ** 2)
        points.append((cx + r * math.cos(a), cy + r * math.sin(a)))
    return points


def breakage_event():
    d = Drawing(700, 340, "A breakage event: the corner before, the corner "
                "after, and the contact force over time")
    wall = 250
    for k, title in enumerate(("before", "after")):
        cx, cy = 120 + 216 * k, 160
        sharp = corner(cx, cy)
        blunt = chipped(sharp, cx, cy, math.pi / 2, 11., 0.3)
        d.text(cx, 28, title, is_bold=True, size=15)
        if k == 0:
            d.polygon(sharp, fill=ROCK)
            d.line((cx - 90, wall), (cx + 90, wall), width=2)
            cap = [p for p in sharp if p[1] >= wall]
            d.polygon(cap, fill="#e8a59e", stroke=RED, width=1)
            d.line((cx + 30, wall + 8), (cx + 58, wall + 26), stroke=RED,
                   width=1)
            d.text(cx + 60, wall + 38, "cap: V = A &#948;/2", colour=RED,
                   size=12)
            d.text(cx - 46, wall + 24, "overlap &#948;", size=12)
            d.arrow(cx, wall + 66, cx, wall + 18, colour=BLUE, width=2)
            d.text(cx - 8, wall + 62, "F", colour=BLUE, anchor="end",
                   is_bold=True)
        else:
            d.polygon(blunt, fill=ROCK)
            d.polygon(sharp, stroke=GREY, dash="4 3", width=1)
            d.line((cx - 90, wall), (cx + 90, wall), width=2)
            d.text(cx + 4, wall + 38, "volume less V, corner blunter",
                   size=12)
            d.arrow(cx, wall + 62, cx, wall + 46, colour=BLUE, width=2,
                    head=6)
            d.text(cx - 8, wall + 62, "F'", colour=BLUE, anchor="end",
                   is_bold=True)
        d.circle(cx, cy, 2.5, fill=INK)
    d.text(228, 180, "E", size=15, colour=RED, is_bold=True)
    d.text(238, 184, "e", size=11, colour=RED, is_bold=True)
    d.text(228, 198, "&gt; G A", size=13, colour=RED)
    d.arrow(206, 212, 252, 212, colour=RED)
    x, y = 480, 250
    d.arrow(x, y, x + 200, y)
    d.arrow(x, y, x, y - 180)
    d.text(x + 200, y + 18, "displacement", anchor="end")
    d.text(x + 8, y - 172, "force", anchor="start")
    curve, force, start = [(x, y)], 0., 0
    for k in range(1, 181):
        force += 1.05 * (0.4 + k / 260.)
        if k in (70, 118, 155):
            curve.append((x + k, y - force))
            force *= 0.72
        curve.append((x + k, y - force))
    d.line(*curve, stroke=BLUE, width=2)
    d.text(x + 76, y - 66, "event", colour=RED, size=12, anchor="start")
    d.circle(x + 70, y - min(1.05 * sum(0.4 + k / 260. for k in range(1, 71)),
                             200.), 3, fill=RED, stroke=RED)
    d.save("breakage_event")


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
    for draw in (contact_geometries, breakage_event, coupling_window,
                 run_stages, membrane):
        draw()
