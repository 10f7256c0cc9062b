"""Line drawings as SVG: lines, shapes, arrows, dimensions and texts.

A drawing has a white ground, so that it is legible on light and dark pages.
Lengths are pixels, x to the right and y down.
"""
import math
import pathlib
import random

PICTURES = pathlib.Path(__file__).resolve().parents[2] / "docs/pictures"
INK, GREY, PALE = "#222222", "#8a8f98", "#e9eaec"
ROCK, STEEL, SOIL = "#d9cdb8", "#9aa5b1", "#e3d2b0"
BLUE, RED, GREEN, ORANGE = "#0b5394", "#b3261e", "#2e7d32", "#b45f06"


def number(value):
    return f"{value:.1f}".rstrip("0").rstrip(".")


class Drawing:
    """A picture of this size; `label` describes it in words."""

    def __init__(self, width, height, label):
        self.parts = [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} '
            f'{height}" role="img" aria-label="{label}" font-family='
            '"Helvetica, Arial, \'Liberation Sans\', sans-serif" '
            f'font-size="13" fill="{INK}">',
            f'<rect width="{width}" height="{height}" rx="6" fill="#ffffff"/>']

    def path(self, shape, stroke=INK, width=1.4, fill="none", dash=""):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(
            f'<path d="{shape}" fill="{fill}" stroke="{stroke}" '
            f'stroke-width="{number(width)}" stroke-linejoin="round" '
            f'stroke-linecap="round"{dashes}/>')

    def line(self, *points, **style):
        self.path("M" + "L".join(f"{number(x)} {number(y)}"
                                 for x, y in points), **style)

    def polygon(self, points, **style):
        self.path("M" + "L".join(f"{number(x)} {number(y)}"
                                 for x, y in points) + "Z", **style)

    def rect(self, x, y, width, height, **style):
        self.polygon([(x, y), (x + width, y), (x + width, y + height),
                      (x, y + height)], **style)

    def circle(self, x, y, radius, **style):
        r = number(radius)
        self.path(f"M{number(x - radius)} {number(y)}"
                  f"a{r} {r} 0 1 0 {number(2 * radius)} 0"
                  f"a{r} {r} 0 1 0 {number(-2 * radius)} 0Z", **style)

    def text(self, x, y, words, anchor="middle", colour=INK, size=13,
             is_bold=False, turned=0):
        weight = ' font-weight="bold"' if is_bold else ""
        turn = (f' transform="rotate({turned} {number(x)} {number(y)})"'
                if turned else "")
        self.parts.append(
            f'<text x="{number(x)}" y="{number(y)}" text-anchor="{anchor}" '
            f'fill="{colour}" font-size="{size}"{weight}{turn}>{words}</text>')

    def arrow(self, x1, y1, x2, y2, colour=INK, width=1.6, head=7):
        length = math.hypot(x2 - x1, y2 - y1)
        ux, uy = (x2 - x1) / length, (y2 - y1) / length
        bx, by = x2 - head * ux, y2 - head * uy
        self.line((x1, y1), (bx, by), stroke=colour, width=width)
        half = 0.45 * head
        self.polygon([(x2, y2), (bx - half * uy, by + half * ux),
                      (bx + half * uy, by - half * ux)],
                     stroke=colour, width=0.5, fill=colour)

    def dimension(self, x1, y1, x2, y2, words, side=12):
        """A measure from point to point; words `side` to its right."""
        for a, b in (((x1, y1), (x2, y2)), ((x2, y2), (x1, y1))):
            middle = (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]))
            self.arrow(*middle, *b, colour=GREY, width=1, head=6)
        x, y = 0.5 * (x1 + x2), 0.5 * (y1 + y2)
        if abs(x2 - x1) > abs(y2 - y1):
            self.text(x, y + side + 4, words, size=12)
        else:
            self.text(x + side, y + 4, words, size=12,
                      anchor="start" if side > 0 else "end")

    def axes(self, x, y, right="x", up="z", out="y", is_into=True, length=34):
        """Two axes in the plane, and one across it: into it or out of it."""
        self.arrow(x, y, x + length, y, colour=BLUE)
        self.arrow(x, y, x, y - length, colour=BLUE)
        self.text(x + length + 9, y + 4, right, colour=BLUE)
        self.text(x, y - length - 5, up, colour=BLUE)
        self.circle(x, y, 5, stroke=BLUE, fill="#ffffff")
        if is_into:
            self.line((x - 3, y - 3), (x + 3, y + 3), stroke=BLUE, width=1)
            self.line((x - 3, y + 3), (x + 3, y - 3), stroke=BLUE, width=1)
        else:
            self.circle(x, y, 1.5, stroke=BLUE, fill=BLUE, width=0.5)
        self.text(x - 11, y + 14, out, colour=BLUE)

    def hatching(self, x1, y1, x2, y2, depth=7, spacing=9):
        """A line that does not move, held on its right hand side."""
        self.line((x1, y1), (x2, y2), width=1.8)
        length = math.hypot(x2 - x1, y2 - y1)
        ux, uy = (x2 - x1) / length, (y2 - y1) / length
        for k in range(int(length // spacing) + 1):
            a = (x1 + k * spacing * ux, y1 + k * spacing * uy)
            self.line(a, (a[0] - depth * (uy + ux), a[1] + depth * (ux - uy)),
                      width=0.9, stroke=GREY)

    def save(self, name):
        PICTURES.mkdir(exist_ok=True)
        (PICTURES / f"{name}.svg").write_text(
            "\n".join(self.parts) + "\n</svg>\n", encoding="utf-8")


def particle_outline(x, y, radius, seed, roughness=0.12, n=48):
    """Points of a rounded, irregular outline about a centre."""
    draw = random.Random(seed)
    waves = [(k, draw.gauss(0., roughness / k), draw.uniform(0., 2 * math.pi))
             for k in range(2, 6)]
    points = []
    for k in range(n):
        angle = 2. * math.pi * k / n
        r = radius * (1. + sum(a * math.cos(m * angle + phase)
                               for m, a, phase in waves))
        points.append((x + r * math.cos(angle), y + r * math.sin(angle)))
    return points


def packing(contains, box, sizes, seed=1, n_tries=6000):
    """Circles (x, y, r) that do not overlap, the largest first, in the part of
    the box where contains(x, y, r)."""
    draw = random.Random(seed)
    placed = []
    for radius in sizes:
        for _ in range(n_tries // len(sizes)):
            x = draw.uniform(box[0], box[2])
            y = draw.uniform(box[1], box[3])
            if contains(x, y, radius) and all(
                    math.hypot(x - a, y - b) > 0.98 * (radius + c)
                    for a, b, c in placed):
                placed.append((x, y, radius))
    return placed


def draw_particles(drawing, circles, fill=ROCK, seed=0):
    for k, (x, y, radius) in enumerate(circles):
        drawing.polygon(particle_outline(x, y, radius, seed + k, 0.07),
                        width=0.9, fill=fill)


def fill_box(drawing, x1, y1, x2, y2, sizes=(14, 11, 9, 7, 5, 4), seed=1):
    draw_particles(drawing, packing(
        lambda x, y, r: x1 + r < x < x2 - r and y1 + r < y < y2 - r,
        (x1, y1, x2, y2), sizes, seed), seed=seed)
