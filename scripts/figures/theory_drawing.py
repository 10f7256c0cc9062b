"""Elements of the sketches of docs/theory: SVG, y upward, lengths in pixels."""
import math
import pathlib

PICTURES = pathlib.Path(__file__).resolve().parents[2] / "docs/pictures"
INK, SOFT, BLUE, RED, GREEN, FILL = (
    "#222222", "#777777", "#0b5394", "#b3261e", "#2e6b1f", "#e8eef5")
LENS = "#f2b8a8"


def label(text):
    """`r_A` with a subscript, in one string of tspans."""
    parts = text.split("_")
    out = parts[0]
    for part in parts[1:]:
        low, _, rest = part.partition(" ")
        out += (f'<tspan dy="4" font-size="10">{low}</tspan>'
                f'<tspan dy="-4">{" " + rest if rest else "&#8203;"}</tspan>')
    return out


class Drawing:
    """Collects the elements of one picture."""

    def __init__(self, width, height, title):
        self.width, self.height, self.title = width, height, title
        self.parts = []

    def point(self, p):
        return f"{p[0]:.1f} {self.height - p[1]:.1f}"

    def path(self, points, closed=False, fill="none", stroke=INK, width=1.5,
             dash=None):
        data = "M" + "L".join(self.point(p) for p in points)
        self.parts.append(
            f'<path d="{data}{"Z" if closed else ""}" fill="{fill}" '
            f'stroke="{stroke}" stroke-width="{width}"'
            + (f' stroke-dasharray="{dash}"' if dash else "") + "/>")

    def line(self, a, b, **style):
        self.path([a, b], **style)

    def circle(self, centre, radius, fill="none", stroke=INK, width=1.5,
               dash=None):
        points = [(centre[0] + radius * math.cos(t * math.pi / 60),
                   centre[1] + radius * math.sin(t * math.pi / 60))
                  for t in range(120)]
        self.path(points, True, fill, stroke, width, dash)

    def dot(self, p, colour=INK, radius=3.2):
        x, y = self.point(p).split()
        self.parts.append(f'<circle cx="{x}" cy="{y}" r="{radius}" '
                          f'fill="{colour}"/>')

    def arrow(self, a, b, colour=INK, width=1.8, both=False):
        self.line(a, b, stroke=colour, width=width)
        for tip, tail in [(b, a)] + ([(a, b)] if both else []):
            length = math.hypot(tip[0] - tail[0], tip[1] - tail[1])
            e = ((tip[0] - tail[0]) / length, (tip[1] - tail[1]) / length)
            root = (tip[0] - 8 * e[0], tip[1] - 8 * e[1])
            self.path([tip, (root[0] - 3.2 * e[1], root[1] + 3.2 * e[0]),
                       (root[0] + 3.2 * e[1], root[1] - 3.2 * e[0])], True,
                      colour, colour, 0.5)

    def text(self, p, words, anchor="middle", colour=INK, size=14,
             italic=False, bold=False):
        x, y = self.point(p).split()
        self.parts.append(
            f'<text x="{x}" y="{y}" text-anchor="{anchor}" fill="{colour}" '
            f'font-size="{size}"'
            + (' font-style="italic"' if italic else "")
            + (' font-weight="bold"' if bold else "")
            + f">{label(words)}</text>")

    def spring(self, a, b, colour=INK, n=6, wide=6.):
        length = math.hypot(b[0] - a[0], b[1] - a[1])
        e = ((b[0] - a[0]) / length, (b[1] - a[1]) / length)

        def at(s, t):
            return (a[0] + s * e[0] - t * e[1], a[1] + s * e[1] + t * e[0])
        ends = 0.15 * length
        step = (length - 2. * ends) / n
        points = [at(0., 0.), at(ends, 0.)]
        points += [at(ends + (k + 0.5) * step, wide if k % 2 else -wide)
                   for k in range(n)]
        self.path(points + [at(length - ends, 0.), at(length, 0.)],
                  stroke=colour)

    def dashpot(self, a, b, colour=INK, wide=6.):
        length = math.hypot(b[0] - a[0], b[1] - a[1])
        e = ((b[0] - a[0]) / length, (b[1] - a[1]) / length)

        def at(s, t):
            return (a[0] + s * e[0] - t * e[1], a[1] + s * e[1] + t * e[0])
        low, high, middle = 0.35 * length, 0.65 * length, 0.5 * length
        self.line(at(0., 0.), at(low, 0.), stroke=colour)
        self.path([at(high, wide), at(low, wide), at(low, -wide),
                   at(high, -wide)], stroke=colour)
        self.line(at(middle, -wide + 1.5), at(middle, wide - 1.5),
                  stroke=colour, width=2.5)
        self.line(at(middle, 0.), at(length, 0.), stroke=colour)

    def write(self, name):
        (PICTURES / name).write_text(
            '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 '
            f'{self.width} {self.height}" role="img" '
            f'aria-label="{self.title}" '
            'font-family="Helvetica, Arial, sans-serif">\n'
            f'<rect width="{self.width}" height="{self.height}" rx="6" '
            'fill="#ffffff"/>\n' + "\n".join(self.parts) + "\n</svg>\n",
            encoding="utf-8")


class Outline:
    """A star-shaped outline r(t) = r0 (1 + sum a_k cos(k (t - t_k)))."""

    def __init__(self, centre, mean, waves, turn=0.):
        self.centre, self.mean, self.waves = centre, mean, waves
        self.turn = turn

    def radius(self, angle):
        return self.mean * (1. + sum(
            a * math.cos(k * (angle - self.turn - phase))
            for k, a, phase in self.waves))

    def at(self, angle):
        r = self.radius(angle)
        return (self.centre[0] + r * math.cos(angle),
                self.centre[1] + r * math.sin(angle))

    def normal(self, angle, step=1e-5):
        a, b = self.at(angle - step), self.at(angle + step)
        t = (b[0] - a[0], b[1] - a[1])
        length = math.hypot(*t)
        return (t[1] / length, -t[0] / length)

    def points(self, n=240):
        return [self.at(2. * math.pi * k / n) for k in range(n)]

    def contains(self, p):
        x, y = p[0] - self.centre[0], p[1] - self.centre[1]
        return math.hypot(x, y) < self.radius(math.atan2(y, x))
