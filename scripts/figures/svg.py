"""Line drawings as SVG: lines, shapes, arrows, dimensions and texts.

A drawing has a white ground, so that it is legible on light and dark pages.
Lengths are pixels, x to the right and y down, or up in an upward drawing.
"""
import math
import pathlib
import random

PICTURES = pathlib.Path(__file__).resolve().parents[2] / "docs/pictures"
INK, GREY, PALE = "#222222", "#8a8f98", "#e9eaec"
ROCK, STEEL, SOIL = "#d9cdb8", "#9aa5b1", "#e3d2b0"
BLUE, RED, GREEN, ORANGE = "#0b5394", "#b3261e", "#2e7d32", "#b45f06"
LIGHT_BLUE, LIGHT_RED = "#e8eef5", "#f2b8a8"


def number(value):
    return f"{value:.1f}".rstrip("0").rstrip(".")


def subscripts(words):
    """Words in which `r_A` has a subscript, up to the next blank."""
    first, *parts = words.split("_")
    for part in parts:
        low, _, rest = part.partition(" ")
        first += (f'<tspan dy="4" font-size="10">{low}</tspan>'
                  f'<tspan dy="-4">{" " + rest if rest else "&#8203;"}</tspan>')
    return first


def on_line(a, b):
    """Points of the line from a to b: s along it, t to its left."""
    length = math.dist(a, b)
    e = ((b[0] - a[0]) / length, (b[1] - a[1]) / length)
    return lambda s, t: (a[0] + s * e[0] - t * e[1], a[1] + s * e[1] + t * e[0])


class Drawing:
    """A picture of this size; `label` describes it in words."""

    def __init__(self, width, height, label, is_upward=False):
        self.height, self.is_upward = height, is_upward
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

    def down(self, y):
        """An ordinate as the file has it."""
        return self.height - y if self.is_upward else y

    def through(self, points):
        return "M" + "L".join(f"{number(x)} {number(self.down(y))}"
                              for x, y in points)

    def line(self, *points, **style):
        self.path(self.through(points), **style)

    def polygon(self, points, **style):
        self.path(self.through(points) + "Z", **style)

    def rect(self, x, y, width, height, **style):
        self.polygon([(x, y), (x + width, y), (x + width, y + height),
                      (x, y + height)], **style)

    def circle(self, x, y, radius, **style):
        r = number(radius)
        self.path(f"M{number(x - radius)} {number(self.down(y))}"
                  f"a{r} {r} 0 1 0 {number(2 * radius)} 0"
                  f"a{r} {r} 0 1 0 {number(-2 * radius)} 0Z", **style)

    def dot(self, x, y, colour=INK, radius=3.2):
        self.circle(x, y, radius, stroke=colour, fill=colour, width=0.5)

    def text(self, x, y, words, anchor="middle", colour=INK, size=13,
             is_bold=False, is_italic=False, turned=0):
        y = self.down(y)
        style = ((' font-weight="bold"' if is_bold else "")
                 + (' font-style="italic"' if is_italic else ""))
        turn = (f' transform="rotate({turned} {number(x)} {number(y)})"'
                if turned else "")
        self.parts.append(
            f'<text x="{number(x)}" y="{number(y)}" text-anchor="{anchor}" '
            f'fill="{colour}" font-size="{size}"{style}{turn}>{words}</text>')

    def arrow(self, x1, y1, x2, y2, colour=INK, width=1.6, head=7,
              is_double=False):
        length = math.hypot(x2 - x1, y2 - y1)
        at = on_line((x1, y1), (x2, y2))
        self.line(at(head if is_double else 0., 0.), at(length - head, 0.),
                  stroke=colour, width=width)
        half = 0.45 * head
        for tip, foot in (((length, length - head), (0., head))
                          if is_double else ((length, length - head),)):
            self.polygon([at(tip, 0.), at(foot, half), at(foot, -half)],
                         stroke=colour, width=0.5, fill=colour)

    def spring(self, a, b, n=6, half_width=6.):
        """A zigzag of n halves from point to point."""
        length = math.dist(a, b)
        at, end, pitch = on_line(a, b), 0.15 * length, 0.7 * length / n
        zigzag = [at(end + (k + 0.5) * pitch,
                     half_width if k % 2 else -half_width) for k in range(n)]
        self.line(a, at(end, 0.), *zigzag, at(length - end, 0.), b)

    def dashpot(self, a, b, half_width=6.):
        """A cylinder, open towards b, and its piston."""
        length = math.dist(a, b)
        at, low, high = on_line(a, b), 0.35 * length, 0.65 * length
        piston = half_width - 1.5
        self.line(a, at(low, 0.))
        self.line(at(high, half_width), at(low, half_width),
                  at(low, -half_width), at(high, -half_width))
        self.line(at(0.5 * length, -piston), at(0.5 * length, piston),
                  width=2.5)
        self.line(at(0.5 * length, 0.), b)

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


class Outline:
    """A star-shaped outline r(t) = mean (1 + sum a_k cos(k (t - t_k)))."""

    def __init__(self, centre, mean, waves):
        self.centre, self.mean, self.waves = centre, mean, waves

    def radius(self, angle):
        return self.mean * (1. + sum(a * math.cos(k * (angle - phase))
                                     for k, a, phase in self.waves))

    def at(self, angle):
        r = self.radius(angle)
        return (self.centre[0] + r * math.cos(angle),
                self.centre[1] + r * math.sin(angle))

    def normal(self, angle, step=1e-5):
        a, b = self.at(angle - step), self.at(angle + step)
        length = math.dist(a, b)
        return ((b[1] - a[1]) / length, (a[0] - b[0]) / length)

    def points(self, n=240):
        return [self.at(2. * math.pi * k / n) for k in range(n)]

    def contains(self, p):
        x, y = p[0] - self.centre[0], p[1] - self.centre[1]
        return math.hypot(x, y) < self.radius(math.atan2(y, x))


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
