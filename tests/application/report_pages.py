"""What a report must be: one page without outside links, whose contents name
its sections and whose figures hold the numbers that they show."""
import csv
import html.parser
import io
import re
import urllib.parse

VOID = {"meta", "img", "path", "circle", "rect", "br", "link"}
SECTIONS = ["Specimen", "Mechanical response", "Particle breakage",
            "Contact network", "Boundaries", "Energy balance", "Performance",
            "Input"]
SLICES = ["end_1", "height_share_1", "particle_1", "spalled_1", "loop_1",
          "x_m", "y_m"]
COLUMN = re.compile(r"[a-z][a-z0-9_]*_[A-Za-z0-9_]+")


class Page(html.parser.HTMLParser):
    """Headings, links, figures and faults of a page."""

    def __init__(self, text):
        super().__init__()
        self.faults, self.open, self.text = [], [], ""
        self.ids, self.links, self.headings = [], [], []
        self.contents, self.figures = [], []
        self.feed(text)
        self.close()
        self.faults += [f"<{tag}> is not closed" for tag in self.open]

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        if tag not in VOID:
            self.open.append(tag)
        if "id" in found:
            self.ids.append(found["id"])
        for name in ("href", "src", "xlink:href"):
            if name in found:
                self.links.append(found[name])
        if tag == "a" and "nav" in self.open:
            self.contents.append(found["href"])
        if tag == "figure":
            self.figures.append({"id": found.get("id", "picture"),
                                 "svg": [], "texts": []})
        if self.figures and "figure" in self.open:
            figure = self.figures[-1]
            if tag in ("path", "circle"):
                figure["svg"].append((tag, found))
            if tag == "text":
                figure["texts"].append([found, ""])
            if tag == "a" and "download" in found:
                figure["csv"] = found
        self.text = ""

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> closes another element")
        if tag == "h2":
            self.headings.append(self.text)
        if tag == "text":
            self.figures[-1]["texts"][-1][1] = self.text

    def handle_data(self, data):
        self.text += data


def number(text):
    return float(text.replace("\N{MINUS SIGN}", "-"))


def table_of(figure):
    """Header and rows of the numbers of a figure."""
    kind, data = figure["csv"]["href"].split(",", 1)
    if not kind.startswith("data:text/csv"):
        raise ValueError(f"{figure['id']}: {kind} is no CSV")
    rows = list(csv.reader(io.StringIO(urllib.parse.unquote(data))))
    return rows[0], rows[1:]


def scale(ticks):
    """Position of a value on an axis by its ticks (position, value), if it is
    linear; two ticks do not tell."""
    if len(ticks) < 3:
        return None
    (p0, v0), (p1, v1) = ticks[0], ticks[-1]
    slope = (p1 - p0) / (v1 - v0)
    if any(abs(p0 + slope * (v - v0) - p) > 0.3 for p, v in ticks):
        return None
    return lambda value: p0 + slope * (value - v0)


def axes_of(figure):
    """Scales of x and y, or None where the ticks are not plain numbers."""
    ticks = {"middle": [], "end": []}
    for found, text in figure["texts"]:
        if found.get("text-anchor") in ticks and "transform" not in found:
            at = found["x" if found["text-anchor"] == "middle" else "y"]
            ticks[found["text-anchor"]].append((float(at), text))
    try:
        # The last text in the middle is the name of the axis.
        x = scale([(p, number(t)) for p, t in ticks["middle"][:-1]])
        y = scale([(p - 4., number(t)) for p, t in ticks["end"]])
    except (ValueError, IndexError, ZeroDivisionError):
        return None
    return (x, y) if x and y else None


def drawn_points(figure):
    """Points of the curves and markers [px], by their tenths."""
    points = set()
    for tag, found in figure["svg"]:
        pairs = re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", found.get("d", ""))
        if tag == "circle":
            pairs = [(found["cx"], found["cy"])]
        points |= {(round(10 * float(a)), round(10 * float(b)))
                   for a, b in pairs}
    return points


def is_near(points, x, y, shift):
    """A point within 0.3 px, and within `shift` along x [px]."""
    a, b, far = round(10 * x), round(10 * y), 3 + round(10 * shift)
    return any((a + i, b + j) in points for i in range(-far, far + 1)
               for j in range(-3, 4))


def figure_faults(figure, shift):
    """The CSV of a chart holds what the chart shows."""
    if "csv" not in figure:
        yield f"{figure['id']}: no CSV of its numbers"
        return
    header, rows = table_of(figure)
    names = header[1:] if header[0] in ("curve", "run") else header
    if figure["id"] == "wall_clock":
        if header != ["run", "phase", "time_s"] or not rows:
            yield f"{figure['id']}: CSV {header}, {len(rows)} rows"
        return
    if figure["id"].startswith("slices"):
        n_points = sum(len(re.findall("[ML]", found["d"]))
                       for tag, found in figure["svg"] if tag == "path")
        # A line more is the bar of the scale.
        if header != SLICES or n_points != len(rows) + 2:
            yield f"{figure['id']}: CSV {header}, {len(rows)} rows, " \
                f"{n_points} points"
        return
    if len(names) != 2 or not all(COLUMN.fullmatch(name) for name in names):
        yield f"{figure['id']}: columns {header}"
        return
    axes, points = axes_of(figure), drawn_points(figure)
    if not rows:
        yield f"{figure['id']}: CSV without rows"
    if not axes:
        return
    for row in rows:
        x, y = (scale_of(float(value))
                for scale_of, value in zip(axes, row[-2:]))
        if not is_near(points, x, y, shift):
            yield f"{figure['id']}: {row} is not in the figure"
            return


def page_faults(path, sections, shift=0.):
    """`sections`: titles that the page must have. `shift`: of curves that
    would hide each other [px]."""
    text = path.read_text()
    page = Page(text)
    faults = [f"{path.name}: {fault}" for fault in page.faults]
    faults += [f"{path.name}: {word} in the page" for word in
               ("<script", "@import", "url(", "http:", "https:")
               if word in text]
    faults += [f"{path.name}: link {link[:60]}" for link in page.links
               if not link.startswith(("#", "data:"))]
    faults += [f"{path.name}: nothing at {link}" for link in page.contents
               if link[1:] not in page.ids]
    if len(set(page.ids)) != len(page.ids):
        faults.append(f"{path.name}: an id stands twice")
    if len(page.contents) != len(page.headings) - 1:
        faults.append(f"{path.name}: {len(page.contents)} contents for "
                      f"{page.headings}")
    faults += [f"{path.name}: no section {title}" for title in sections
               if title not in page.headings]
    charts = [figure for figure in page.figures if figure["id"] != "picture"]
    if not charts:
        faults.append(f"{path.name}: no figures")
    for figure in charts:
        faults += figure_faults(figure, shift)
    # A table of eight digits a number is about three times the path that shows it.
    tables = sum(len(figure.get("csv", {}).get("href", ""))
                 for figure in charts)
    if tables > 0.8 * len(text):
        faults.append(f"{path.name}: {tables} of {len(text)} bytes are CSV")
    return faults
