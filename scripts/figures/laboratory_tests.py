#!/usr/bin/env python3
"""Geometry, axes and dimensions of each kind of test, into docs/pictures.

    python3 scripts/figures/laboratory_tests.py
"""
import math

from svg import (BLUE, Drawing, GREEN, GREY, INK, ORANGE, PALE, RED, SOIL,
                 STEEL, ROCK, draw_particles, fill_box, packing,
                 particle_outline)


def haversine(x, y, width, height, n):
    """Points of n pulses from the corner (x, y) upwards."""
    return [(x + width * k / (40 * n),
             y - 0.5 * height * (1. - math.cos(2. * math.pi * k / 40)))
            for k in range(40 * n + 1)]


def triaxial():
    d = Drawing(640, 340, "Dynamic triaxial test: specimen between two plates "
                "in a membrane, and the axial stress over time")
    left, right, top, bottom = 130, 290, 90, 270
    d.rect(left, top, right - left, bottom - top, fill=PALE, stroke="none")
    fill_box(d, left + 2, top + 2, right - 2, bottom - 2, seed=3)
    d.rect(left - 12, top - 20, right - left + 24, 20, fill=STEEL)
    d.text(0.5 * (left + right), top - 6, "top plate, plate_mass", size=12)
    d.rect(left - 12, bottom, right - left + 24, 14, fill=STEEL)
    d.hatching(left - 12, bottom + 14, right + 12, bottom + 14)
    for x, sign in ((left, -1), (right, 1)):
        wave = [(x + sign * 3 * math.sin(math.pi * k / 3.), top + k * 10)
                for k in range(1, 18)]
        d.line((x, top), *wave, (x, bottom), stroke=RED, width=2.4)
        for k in range(5):
            y = top + 20 + 36 * k
            d.arrow(x + sign * 38, y, x + sign * 8, y, colour=BLUE)
    d.text(left - 44, top + 96, "confining_pressure", anchor="middle",
           colour=BLUE, size=12, turned=-90)
    d.text(right + 46, top - 12, "membrane,", anchor="start", colour=RED,
           size=12)
    d.text(right + 46, top + 3, "or rigid sides", anchor="start", colour=RED,
           size=12)
    for k in range(5):
        x = left + 12 + 34 * k
        d.arrow(x, top - 54, x, top - 23, colour=ORANGE)
    d.text(0.5 * (left + right), top - 60, "confining_pressure + haversine",
           colour=ORANGE, size=12)
    d.dimension(left, bottom + 32, right, bottom + 32, "side (diameter)")
    d.axes(42, bottom + 20)
    x, y = 420, 270
    d.arrow(x, y, x + 195, y)
    d.arrow(x, y, x, y - 190)
    d.text(x + 195, y + 18, "time", anchor="end")
    d.text(x + 8, y - 186, "axial stress", anchor="start")
    d.line((x, y - 30), (x + 30, y - 30), *haversine(x + 30, y - 30, 150, 110,
                                                     3), stroke=ORANGE,
           width=2)
    d.dimension(x + 16, y, x + 16, y - 30, "", 4)
    d.text(x - 6, y - 12, "30 kPa", anchor="end", size=12)
    d.line((x + 55, y - 140), (x + 194, y - 140), stroke=GREY, width=0.8)
    d.dimension(x + 188, y - 30, x + 188, y - 140, "", -6)
    d.text(x + 200, y - 84, "amplitude", size=12, turned=-90)
    d.dimension(x + 30, y - 14, x + 80, y - 14, "", 0)
    d.text(x + 96, y - 9, "1/frequency", size=12, anchor="start")
    d.save("sketch_triaxial")


def compaction():
    d = Drawing(560, 360, "Vibratory compaction: layers of particles in a "
                "cylinder under a plate with an exciter")
    left, right, top, bottom = 170, 350, 130, 310
    fill_box(d, left + 2, top + 2, right - 2, bottom - 2,
             (19, 15, 11, 8, 6, 4), seed=5)
    for k in range(1, 4):
        y = bottom - k * (bottom - top) / 4
        d.line((left, y), (right, y), stroke=GREEN, width=1.2, dash="6 4")
    d.text(right + 14, bottom - 18, "4 layers, poured and tamped",
           anchor="start", colour=GREEN, size=12)
    d.hatching(left, top - 60, left, bottom)
    d.hatching(right, bottom, right, top - 60)
    d.hatching(left, bottom, right, bottom)
    d.rect(left + 3, top - 26, right - left - 6, 26, fill=STEEL)
    d.text(0.5 * (left + right), top - 8, "plate, mass M", size=12)
    x, y = 0.5 * (left + right), top - 62
    d.circle(x, y, 26, stroke=GREY, dash="4 3")
    d.circle(x + 18, y - 18, 6, fill=INK)
    d.line((x, y), (x + 18, y - 18))
    d.line((x, y), (x, top - 26), stroke=GREY)
    d.text(x + 32, y - 22, "eccentric_mass at eccentricity, frequency",
           anchor="start", size=12)
    d.arrow(left - 40, top - 60, left - 40, top - 8, colour=ORANGE)
    d.text(left - 48, top - 42, "M g + load", anchor="end", colour=ORANGE,
           size=12)
    d.text(right + 14, top + 24, "rigid: cylinder at rest", anchor="start",
           size=12)
    d.text(right + 14, top + 40, "flexible: tube of membrane", anchor="start",
           colour=RED, size=12)
    d.dimension(left, bottom + 22, right, bottom + 22, "diameter")
    d.dimension(left - 24, top, left - 24, bottom, "height", -8)
    d.axes(50, bottom + 12)
    d.save("sketch_compaction")


def absorbing(d, x, y, dx, dy):
    """A dashpot from a point of the boundary outwards."""
    d.line((x, y), (x + 5 * dx, y + 5 * dy), width=1)
    px, py = -dy, dx
    a, b = x + 5 * dx, y + 5 * dy
    d.line((a + 10 * dx + 5 * px, b + 10 * dy + 5 * py), (a + 5 * px,
           b + 5 * py), (a - 5 * px, b - 5 * py),
           (a + 10 * dx - 5 * px, b + 10 * dy - 5 * py), width=1)
    d.line((a + 6 * dx + 4 * px, b + 6 * dy + 4 * py),
           (a + 6 * dx - 4 * px, b + 6 * dy - 4 * py), width=1)
    d.line((a + 6 * dx, b + 6 * dy), (a + 16 * dx, b + 16 * dy), width=1)


def subgrade():
    d = Drawing(640, 400, "Subgrade: plate on a layer of particles on layered "
                "ground with absorbing sides and bottom")
    left, right, top, bottom = 120, 520, 170, 330
    d.rect(left, top, right - left, 46, fill=SOIL)
    d.rect(left, top + 46, right - left, bottom - top - 46, fill="#d8c39b")
    d.text(left + 12, top + 28, "capping: thickness, E, nu, rho",
           anchor="start", size=12)
    d.text(left + 12, top + 92, "softer soil", anchor="start", size=12)
    for k in range(5):
        absorbing(d, left, top + 16 + 32 * k, -1, 0)
        absorbing(d, right, top + 16 + 32 * k, 1, 0)
    for k in range(9):
        absorbing(d, left + 24 + 44 * k, bottom, 0, 1)
    d.text(right - 8, bottom - 12, "sides, bottom = absorbing", anchor="end",
           size=12, colour=GREEN)
    x1, x2, y1 = 235, 405, top - 56
    d.rect(x1, y1, x2 - x1, 56, fill=PALE, stroke="none")
    fill_box(d, x1 + 1, y1 + 1, x2 - 1, top, (13, 11, 9, 7, 5), seed=8)
    d.hatching(x1, y1 - 12, x1, top)
    d.hatching(x2, top, x2, y1 - 12)
    d.text(x2 + 18, y1 + 22, "layer of particles", anchor="start", size=12)
    d.text(x2 + 18, y1 + 38, "between rigid sides", anchor="start", size=12)
    d.rect(278, y1 - 18, 84, 18, fill=STEEL)
    d.text(320, y1 - 4, "plate", size=12)
    d.arrow(320, y1 - 76, 320, y1 - 21, colour=ORANGE, width=2)
    d.text(332, y1 - 52, "pulse: haversine, train, table, exciter",
           anchor="start", colour=ORANGE, size=12)
    d.dimension(x1 - 26, y1, x1 - 26, top, "thickness", -8)
    for depth in (26, 52, 92):
        d.circle(320, top + depth, 3, fill=RED, stroke=RED)
    d.text(330, top + 96, "stress_depths", anchor="start", colour=RED,
           size=12)
    d.dimension(left, bottom + 36, right, bottom + 36, "length")
    d.axes(44, top + 4)
    d.text(44, top + 36, "z = 0: top", size=11, colour=BLUE)
    d.text(44, top + 50, "of the ground", size=11, colour=BLUE)
    d.save("sketch_subgrade")


def los_angeles():
    d = Drawing(560, 340, "Los Angeles drum: particles and steel balls in a "
                "turning cylinder with a lifter")
    cx, cy, radius = 240, 175, 128
    d.circle(cx, cy, radius, width=2.4)
    d.circle(cx, cy, radius + 8, stroke=GREY, width=1)
    angle = math.radians(200)
    ux, uy = math.cos(angle), math.sin(angle)
    root = (cx + radius * ux, cy + radius * uy)
    d.polygon([(root[0] - 7 * uy, root[1] + 7 * ux),
               (root[0] - 7 * uy - 34 * ux, root[1] + 7 * ux - 34 * uy),
               (root[0] + 7 * uy - 34 * ux, root[1] - 7 * ux - 34 * uy),
               (root[0] + 7 * uy, root[1] - 7 * ux)], fill=STEEL)
    d.text(root[0] + 44, root[1] - 4, "lifter: lifter_height,", size=12,
           anchor="start")
    d.text(root[0] + 44, root[1] + 11, "lifter_thickness", size=12,
           anchor="start")

    def inside(x, y, r):
        return (math.hypot(x - cx, y - cy) + r < radius - 2 and
                y > cy + 42 + 0.25 * (x - cx))

    box = (cx - radius, cy, cx + radius, cy + radius)
    balls = packing(inside, box, (13,), 4, 30)[:5]
    for x, y, r in balls:
        d.circle(x, y, r, fill=STEEL)
    rocks = packing(
        lambda x, y, r: inside(x, y, r) and all(
            math.hypot(x - a, y - b) > r + c for a, b, c in balls),
        box, (15, 12, 10, 8), 6)
    draw_particles(d, rocks)
    for k, (x, y) in enumerate(((cx - 10, cy - 72), (cx + 24, cy - 60))):
        d.polygon(particle_outline(x, y, 12, 70 + k), fill=ROCK, width=0.9)
    arc = [(cx + (radius + 20) * math.cos(math.radians(a)),
            cy + (radius + 20) * math.sin(math.radians(a)))
           for a in range(-40, -81, -2)]
    d.line(*arc, stroke=ORANGE, width=2)
    d.arrow(*arc[-2], arc[-1][0] - 6, arc[-1][1] - 1, colour=ORANGE)
    d.text(cx + 108, cy - 122, "turns_per_minute", anchor="start",
           colour=ORANGE, size=12)
    d.arrow(cx, cy, cx + radius * 0.94, cy - radius * 0.34, colour=GREY,
            width=1)
    d.text(cx + 70, cy - 32, "radius", size=12)
    d.text(402, 120, "steel balls:", anchor="start", size=12)
    d.text(402, 136, "balls, ball_mass", anchor="start", size=12)
    d.text(402, 168, "particles: mass,", anchor="start", size=12)
    d.text(402, 184, "gradation, shapes", anchor="start", size=12)
    d.text(402, 216, "length along the axis y", anchor="start", size=12)
    d.axes(44, 318)
    d.save("sketch_los_angeles")


def single_particle():
    d = Drawing(520, 300, "Single particle between two rigid platens")
    cx, cy, radius = 220, 155, 74
    outline = particle_outline(cx, cy, radius, 11, 0.16)
    top = min(y for _, y in outline)
    bottom = max(y for _, y in outline)
    d.rect(cx - 110, top - 24, 220, 24, fill=STEEL)
    d.rect(cx - 110, bottom, 220, 24, fill=STEEL)
    d.hatching(cx - 110, bottom + 24, cx + 110, bottom + 24)
    d.polygon(outline, fill=ROCK, width=1.4)
    d.arrow(cx, top - 62, cx, top - 27, colour=ORANGE, width=2)
    d.text(cx + 10, top - 44, "displacement U at speed", anchor="start",
           colour=ORANGE, size=12)
    d.text(cx + 122, top - 8, "upper platen: force_N", anchor="start", size=12)
    d.text(cx + 122, bottom + 16, "lower platen: lower_force_N",
           anchor="start", size=12)
    d.text(cx, cy - 4, "Particle/shape,", size=12)
    d.text(cx, cy + 12, "diameter", size=12)
    d.text(cx + 122, cy - 4, "orientation: seed,", anchor="start", size=12)
    d.text(cx + 122, cy + 12, "or axis_x, axis_y, axis_z", anchor="start",
           size=12)
    d.circle(cx + 2, top, 3.5, fill=RED, stroke=RED)
    d.circle(cx, bottom, 3.5, fill=RED, stroke=RED)
    d.axes(44, 262)
    d.save("sketch_single_particle")


def scene():
    d = Drawing(700, 330, "Scene: a direct shear box of three walls with "
                "spheres")
    left, right, top, middle, bottom = 190, 390, 100, 180, 260
    circles = packing(lambda x, y, r: left + r < x < right - r and
                      top + r < y < bottom - r,
                      (left, top, right, bottom), (10, 9, 8, 7), 9)
    for x, y, r in circles:
        d.circle(x, y, r, fill=ROCK, width=0.9)
    for x in (left, right):
        d.line((x, top - 30), (x, middle - 2), stroke=RED, width=3)
        d.line((x, middle + 2), (x, bottom), stroke=INK, width=3)
    d.line((left, bottom), (right, bottom), width=3)
    d.line((left - 40, middle + 2), (left, middle + 2), width=3)
    d.line((right, middle + 2), (right + 40, middle + 2), width=3)
    d.line((left - 40, middle - 2), (left, middle - 2), stroke=RED, width=3)
    d.line((right, middle - 2), (right + 40, middle - 2), stroke=RED, width=3)
    d.hatching(left, bottom + 2, right, bottom + 2)
    d.rect(left + 3, top - 14, right - left - 6, 14, fill=STEEL)
    d.text(0.5 * (left + right), top - 3, "wall lid", size=12)
    d.arrow(0.5 * (left + right), top - 58, 0.5 * (left + right), top - 17,
            colour=BLUE, width=2)
    d.text(0.5 * (left + right) + 10, top - 42,
           "force, and weight of mass (free = z)", anchor="start", size=12,
           colour=BLUE)
    d.arrow(right + 46, middle - 30, right + 100, middle - 30, colour=ORANGE,
            width=2)
    d.text(right + 46, middle - 40, "wall upper: table of displacements",
           anchor="start", size=12, colour=ORANGE)
    d.text(right + 46, middle + 40, "wall lower: at rest,", anchor="start",
           size=12)
    d.text(right + 46, middle + 56, "lower_force_x_N,", anchor="start",
           size=12)
    d.text(right + 46, middle + 72, "lower_force_z_N", anchor="start", size=12)
    d.dimension(left, bottom + 26, right, bottom + 26, "120 mm")
    d.arrow(108, 60, 108, 104)
    d.text(108, 50, "gravity", size=12)
    d.axes(60, 286)
    d.save("sketch_scene")


if __name__ == "__main__":
    for draw in (triaxial, compaction, subgrade, los_angeles, single_particle,
                 scene):
        draw()
