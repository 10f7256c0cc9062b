#!/usr/bin/env python3
"""Draws the charts of docs/verification from the tables of its pages.

    verification.py

Reads verify.csv, the other files and the tables of docs/verification, and
writes docs/pictures/verification.
"""
import pathlib
import re

from chart import chart, rows_of, table_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs" / "verification"
PICTURES = ROOT / "docs" / "pictures" / "verification"
SMALLEST = 1e-8  # smaller shares are drawn as this


def margins():
    """Error over tolerance of every number, by family."""
    families, rows = [], rows_of(PAGES / "verify.csv")
    for row in rows:
        if row["family"] not in families:
            families.append(row["family"])
    series = []
    for k, family in enumerate(families):
        points = [(k + 1, max(SMALLEST, float(row["error_1"]) /
                              float(row["tolerance_1"])))
                  for row in rows if row["family"] == family
                  and float(row["tolerance_1"]) > 0.]
        series.append(("", points, "dots", k))
    ends = (0.5, len(families) + 0.5)
    series.append(("", [(x, 1.) for x in ends], "dashes", 5))
    return chart(series, ("family", "error / tolerance"), (False, True),
                 (ends, (SMALLEST, 10.)), families)


def oblique_impact():
    """Rebound of test 4 of Chung and Ooi while sliding."""
    known, found = [], []
    for row in rows_of(PAGES / "verify.csv"):
        angle = re.match(r"tangential restitution, (\d+) degrees",
                         row["quantity"])
        if row["case"] == "chung_ooi_4_sliding" and angle:
            known.append((float(angle[1]), float(row["reference"])))
            found.append((float(angle[1]), float(row["computed"])))
    return chart([("rigid bodies", known, "line", 0),
                  ("computed", found, "dots", 1)],
                 ("angle of incidence (degrees)",
                  "tangential coefficient of restitution (-)"))


def membrane_convergence():
    cases = {}
    for row in rows_of(PAGES / "membrane_convergence.csv"):
        cases.setdefault(row["case"], []).append(
            (float(row["quads"]), float(row["error"])))
    series = [(name, points, "line dots", k)
              for k, (name, points) in enumerate(cases.items())]
    slope = [(10., 1e-2), (100., 1e-4)]
    return chart(series + [("second order", slope, "dashes", 5)],
                 ("quads around or along a side", "relative error (-)"),
                 (True, True))


def disc_impedance():
    """Exact and computed stiffness and damping, beside Lysmer's analogue."""
    rows = table_of(PAGES / "continuum.md", "$a_0$")
    exact_k, found_k, exact_c, found_c = [], [], [], []
    for row in rows:
        a = float(row[0])
        exact_k.append((a, float(row[1])))
        found_k.append((a, float(row[2].split()[0])))
        exact_c.append((a, float(row[4])))
        found_c.append((a, float(row[5].split()[0])))
    ends = (rows and (float(rows[0][0]), float(rows[-1][0])))
    return chart([("k exact", exact_k, "line", 0), ("k", found_k, "dots", 0),
                  ("c exact", exact_c, "line", 1), ("c", found_c, "dots", 1),
                  ("Lysmer's k", [(x, 1.) for x in ends], "dashes", 0),
                  ("Lysmer's c", [(x, 0.85) for x in ends], "dashes", 1)],
                 ("dimensionless frequency (-)", "k, c (-)"))


def element_order():
    """Error of a settlement over the time of a second, by element."""
    names, cases = [], {}
    for row in table_of(PAGES / "continuum.md", "element"):
        names.append(row[0] or names[-1])
        cases.setdefault(names[-1].split(" (")[0], []).append(
            (float(row[6]), abs(float(row[3].split()[0]))))
    return chart([(name, points, "line dots", k)
                  for k, (name, points) in enumerate(cases.items())],
                 ("processor time for a second (s)", "settlement error (%)"),
                 (True, True))


def hysteresis_band():
    """Growth of the cumulative factor at rest and under load, by band."""
    rows = table_of(PAGES / "breakage.md", "hysteresis")
    return chart([(name, [(float(row[0]), float(row[k])) for row in rows],
                   "line dots", k)
                  for k, name in ((1, "at rest"), (2, "in load cycles"))],
                 ("width of the hysteresis band (-)",
                  "growth of the factor (1/s)"), (False, True))


def main():
    PICTURES.mkdir(parents=True, exist_ok=True)
    for draw in (margins, oblique_impact, membrane_convergence,
                 disc_impedance, element_order, hysteresis_band):
        (PICTURES / f"{draw.__name__}.svg").write_text(draw(),
                                                       encoding="utf-8")


if __name__ == "__main__":
    main()
