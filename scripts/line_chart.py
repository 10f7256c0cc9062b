"""A picture of curves over a common axis, value axis by powers of ten."""
import math

WIDTH, HEIGHT = 640, 400
LEFT, RIGHT, TOP, BOTTOM = 70, 170, 20, 50
COLOURS = ("#0b5394", "#cc4125", "#38761d", "#b45f06", "#674ea7", "#444444")


def line_chart(curves, x_label, y_label):
    """SVG of {name: [{x: y}, ...]}, curves of one name in one colour; y above
    zero."""
    every = [curve for group in curves.values() for curve in group]
    xs = sorted({x for curve in every for x in curve})
    ys = [y for curve in every for y in curve.values()]
    low = math.floor(math.log10(min(ys)))
    high = math.ceil(math.log10(max(ys)))

    def at(x, y):
        return (LEFT + (x - xs[0]) / (xs[-1] - xs[0]) * (WIDTH - LEFT - RIGHT),
                TOP + (high - math.log10(y)) / (high - low)
                * (HEIGHT - TOP - BOTTOM))

    def text(x, y, words, anchor="middle", extra=""):
        return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"'
                f'{extra}>{words}</text>')

    parts = []
    for power in range(low, high + 1):
        x, y = at(xs[0], 10.**power)
        parts += [f'<path d="M{x:.1f} {y:.1f}H{WIDTH - RIGHT}" '
                  'stroke="#ddd"/>', text(x - 6, y + 4, f"{10.**power:g}",
                                          "end")]
    for x in xs[::1 + len(xs) // 16]:
        parts.append(text(at(x, 1.)[0], HEIGHT - BOTTOM + 18, x))
    for i, (name, group) in enumerate(curves.items()):
        colour = COLOURS[i % len(COLOURS)]
        for curve in group:
            path = "L".join("{:.1f} {:.1f}".format(*at(*point))
                            for point in sorted(curve.items()))
            parts.append(f'<path d="M{path}" fill="none" stroke="{colour}" '
                         f'stroke-width="{2 if len(group) == 1 else 1}"/>')
        parts += [text(WIDTH - RIGHT + 12, TOP + 14 + 20 * i, name, "start",
                       f' fill="{colour}"')]
    middle = TOP + (HEIGHT - TOP - BOTTOM) / 2
    parts += [text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 10, x_label),
              text(18, middle, y_label, "middle",
                   f' transform="rotate(-90 18 {middle:.1f})"')]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} '
            f'{HEIGHT}" role="img" aria-label="{y_label} over {x_label}" '
            'font-family="Helvetica, Arial, sans-serif" font-size="12" '
            'fill="#222">\n' + "\n".join(parts) + "\n</svg>\n")
