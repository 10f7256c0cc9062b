"""Charts of numbers as SVG: lines and dots over linear or logarithmic axes,
and the tables of the pages that they are drawn from.

A chart has a white ground, so that it is legible on light and dark pages.
"""
import csv
import math

WIDTH, HEIGHT = 640, 400
LEFT, RIGHT, TOP, BOTTOM = 78, 24, 44, 54
INK, GRID = "#222222", "#dddddd"
COLOURS = ("#0b5394", "#cc4125", "#38761d", "#b45f06", "#674ea7", "#444444")


def rows_of(path):
    """Rows of a comma-separated file."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def table_of(path, first_cell):
    """Rows of the tables of a page whose head begins with this cell."""
    rows, is_in = [], False
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line.startswith("|"):
            is_in = False
        elif line.startswith(f"| {first_cell} |"):
            is_in = True
        elif is_in and not line.startswith("|---"):
            rows.append([cell.strip().replace("−", "-")
                         for cell in line.split("|")[1:-1]])
    return rows


class Axis:
    """Positions of values between two pixels."""

    def __init__(self, values, low, high, is_log, limits=None):
        self.low, self.high, self.is_log = low, high, is_log
        least, most = limits or (min(values), max(values))
        if is_log:
            self.first = math.floor(math.log10(least) + 1e-9)
            self.last = math.ceil(math.log10(most) - 1e-9)
        else:
            margin = 0. if limits else 0.06 * (most - least)
            self.first, self.last = least - margin, most + margin

    def __call__(self, value):
        value = math.log10(value) if self.is_log else value
        share = (value - self.first) / (self.last - self.first)
        return self.low + share * (self.high - self.low)

    def ticks(self):
        """Values with their words."""
        if self.is_log:
            step = 1 + (self.last - self.first) // 9
            for power in range(self.first, self.last + 1, step):
                yield 10.**power, f"{10.**power:g}"
            return
        rough = (self.last - self.first) / 6.
        power = 10.**math.floor(math.log10(rough))
        step = next(s * power for s in (1, 2, 5, 10) if s * power >= rough)
        k = math.ceil(self.first / step - 1e-9)
        while k * step <= self.last + 1e-9 * step:
            yield k * step, f"{k * step:g}"
            k += 1


def text(x, y, words, anchor="middle", colour=INK, turn=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" '
            f'fill="{colour}"{turn}>{words}</text>')


def frame(x, y, labels, x_names):
    """Grid, ticks and labels; names stand at 1, 2, ... of the abscissa."""
    parts = []
    for value, words in enumerate(x_names, 1) if x_names else x.ticks():
        parts += [f'<path d="M{x(value):.1f} {y.low:.1f}V{y.high:.1f}" '
                  f'stroke="{GRID}"/>', text(x(value), y.low + 18, words)]
    for value, words in y.ticks():
        parts += [f'<path d="M{x.low:.1f} {y(value):.1f}H{x.high:.1f}" '
                  f'stroke="{GRID}"/>',
                  text(x.low - 6, y(value) + 4, words, "end")]
    middle = 0.5 * (y.low + y.high)
    return parts + [text(0.5 * (x.low + x.high), y.low + 42, labels[0]),
                    text(18, middle, labels[1],
                         turn=f' transform="rotate(-90 18 {middle:.1f})"')]


def curve(points, colour, style, x, y):
    """`style`: line, dashes, dots, or line and dots."""
    at = [(x(a), y(b)) for a, b in points]
    parts = []
    if "line" in style or "dashes" in style:
        dash = ' stroke-dasharray="6 4"' if "dashes" in style else ""
        path = "L".join(f"{a:.1f} {b:.1f}" for a, b in at)
        parts.append(f'<path d="M{path}" fill="none" stroke="{colour}" '
                     f'stroke-width="1.6"{dash}/>')
    if "dots" in style:
        parts += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3.4" '
                  f'fill="{colour}"/>' for a, b in at]
    return parts


def chart(series, labels, log=(False, False), limits=(None, None),
          x_names=()):
    """SVG of [(name, points, style, colour index), ...]; names above."""
    points = [point for _, part, _, _ in series for point in part]
    x = Axis([p[0] for p in points], LEFT, WIDTH - RIGHT, log[0], limits[0])
    y = Axis([p[1] for p in points], HEIGHT - BOTTOM, TOP, log[1], limits[1])
    parts = frame(x, y, labels, x_names)
    at = LEFT
    for name, part, style, index in series:
        colour = COLOURS[index % len(COLOURS)]
        parts += curve(part, colour, style, x, y)
        if name:
            parts.append(text(at, 24, name, "start", colour))
            at += 7. * len(name) + 16
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} '
            f'{HEIGHT}" role="img" aria-label="{labels[1]} over {labels[0]}" '
            'font-family="Helvetica, Arial, \'Liberation Sans\', sans-serif" '
            f'font-size="13" fill="{INK}">\n<rect width="{WIDTH}" '
            f'height="{HEIGHT}" fill="#ffffff"/>\n' + "\n".join(parts) +
            "\n</svg>\n")
