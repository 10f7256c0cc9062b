#!/usr/bin/env python3
"""Draws charts of docs/results and docs/performance from their tables.

    results.py [--check]

Writes docs/pictures/results and docs/pictures/performance; with --check it
names the charts there that are not those of their tables. Charts of studies are
written by `spall study --figures`.
"""
import pathlib
import sys

from chart import chart, rows_of, table_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "benchmark"))
from size_of_specimen import fit, points_of  # noqa: E402
DOCS = ROOT / "docs"
RESULTS, PERFORMANCE = DOCS / "results", DOCS / "performance"


def cycle_jump_errors():
    """Errors of all runs with jumps against every cycle."""
    outcomes = ("strain", "abrasion", "events", "coordination number",
                "mean force", "resilient modulus")
    series = []
    for index, n in enumerate((1419, 346)):
        rows = [row for row in rows_of(
            RESULTS / f"cycle_jump_{n}_particles.csv")
                if row["run"].startswith("jump")]
        series.append((f"{n} particles", [
            (k + 0.9 + 0.2 * index, float(row[f"{name} (%)"]))
            for k, name in enumerate(outcomes) for row in rows], "dots",
                       index))
    ends = (0.5, len(outcomes) + 0.5)
    limit = [("tolerance", [(x, level) for x in ends], "dashes", 5)
             for level in (-10., 10.)]
    limit[1] = ("", *limit[1][1:])
    return chart(series + limit, ("quantity after 300 cycles",
                                  "difference from every cycle (%)"),
                 limits=(ends, (-20., 20.)),
                 x_names=("strain", "abrasion", "events", "coordination",
                          "mean force", "modulus"))


def cycle_jump_rates():
    """Growth in the cycles after the damage cycles over that of every cycle."""
    rows = {row[0]: row[2:] for row in table_of(RESULTS / "cycle_jump.md",
                                                "cycle")}
    series = [(name, [(k + 1, float(cell)) for k, cell in
                      enumerate(rows[name])], "line dots", index)
              for index, name in enumerate(("strain", "abrasion"))]
    return chart(series + [("every cycle", [(1, 1.), (12, 1.)], "dashes", 5)],
                 ("cycle after the damage cycles",
                  "growth over that of every cycle (-)"))


def density_scaling():
    """Worst error over cost of the thresholds and plates."""
    rows = rows_of(RESULTS / "density_scaling_errors.csv")[1:]
    names = {"repacked": "another packing", "linear": "linear plates"}
    return chart([(names.get(row["value"], f"{1e3 * float(row['value']):g} mm"
                             if row["key"] != "Variants" else row["value"]),
                   [(float(row["loading_processor_s"]),
                     float(row["worst_error_over_spread"]))], "dots", k)
                  for k, row in enumerate(rows)],
                 ("cost of the loading over the case (-)",
                  "worst error over the spread (-)"),
                 limits=((0.6, 1.4), (0., 4.)))


def time_step():
    """Early force error of fixed steps, rigid and membrane sides."""
    rows = [row for row in table_of(PERFORMANCE / "time_step.md", "rule")
            if row[0].startswith("fixed") and float(row[1]) > 0.25]
    half = len(rows) // 2
    return chart([(name, [(float(row[1]), float(row[6])) for row in part],
                   "line dots", k) for k, (name, part) in enumerate(
                       (("rigid sides", rows[:half]),
                        ("membrane", rows[half:])))],
                 ("step (µs)", "early force error (%)"), (True, True))


def engine_sizes():
    """Cost of a particle over the number of particles."""
    rows = table_of(PERFORMANCE / "engine.md", "spheres on a lattice")
    return chart([("", [(float(row[0]), float(row[5])) for row in rows],
                   "line dots", 0)],
                 ("spheres", "ns per particle and step"), (True, False),
                 limits=(None, (0., 160.)))


def over_cycles(outcome, label, is_log):
    """An outcome of the claims over the cycles at 20 Hz: amplitudes in colours,
    without breakage dashed."""
    rows = [row for row in rows_of(RESULTS / "article_claims_cycles.csv")
            if row["Loading/frequency"] == "20"]
    loads = sorted({float(row["Loading/amplitude"]) for row in rows})
    series = []
    for index, load in enumerate(loads):
        for variant, style in (("breaking", "line dots"),
                               ("unbroken", "dashes")):
            points = [(float(row["cycle"]), float(row[outcome]))
                      for row in rows if row["Variants"] == variant and
                      float(row["Loading/amplitude"]) == load and
                      not (is_log and float(row[outcome]) == 0.)]
            if points:
                series.append((f"{1e-3 * load:g} kPa"
                               if variant == "breaking" else "",
                               points, style, index))
    return chart(series + [("dashed: without breakage", [], "", 5)],
                 ("load cycles", label), (True, is_log))


def claims_strain():
    """Permanent strain over the cycles."""
    return over_cycles("strain (%)", "permanent axial strain (%)", True)


def claims_abrasion():
    """Abrasion over the cycles."""
    return over_cycles("LAA (%)", "abrasion LAA (%)", True)


def claims_coordination():
    """Coordination number over the cycles."""
    return over_cycles("coordination number", "coordination number (-)", False)


def claims_force():
    """Mean contact force over the cycles."""
    return over_cycles("mean contact force (N)", "mean contact force (N)",
                       False)


def claims_fracture_energy():
    """Abrasion over the cycles by fracture energies, and the published one."""
    rows = [row for row in rows_of(
        RESULTS / "claims_fracture_energy_cycles.csv")
            if float(row["LAA (%)"]) > 0.]
    energies = sorted({float(row["Breakage/fracture_energy"]) for row in rows})
    series = [(f"{1e-3 * energy:g} kJ/m²",
               sorted({(float(row["cycle"]), float(row["LAA (%)"]))
                       for row in rows
                       if float(row["Breakage/fracture_energy"]) == energy}),
               "line dots", index) for index, energy in enumerate(energies)]
    return chart(series + [("published", [(1000., 0.35)], "dots", 5)],
                 ("load cycles", "abrasion LAA (%)"), (True, True))


def claims_size():
    """Outcomes after five cycles over those of the smallest specimen, against
    the inverse of the width; dashed a + b / width of all but the largest."""
    rows = (rows_of(RESULTS / "claims_size_cycles.csv") +
            rows_of(RESULTS / "claims_size_300_cycles.csv"))
    series = []
    for index, (name, column, is_breaking) in enumerate((
            ("strain", "strain (%)", "true"),
            ("strain without breakage", "strain (%)", "false"),
            ("abrasion", "LAA (%)", "true"),
            ("coordination number", "coordination number", "true"))):
        points = points_of(rows, column, is_breaking, "5")
        first = points[0][1]
        offset, slope = fit(points[:-1])
        series.append((name, [(1e3 * x, y / first) for x, y, _ in points],
                       "dots", index))
        series.append(("", [(1e3 * x, (offset + slope * x) / first)
                            for x in (points[0][0], points[-1][0])],
                       "dashes", index))
    return chart(series, ("1 / width of the specimen (1/m)",
                          "over that of the smallest specimen (-)"))


def ballast_strain():
    """Permanent strain over the cycles at 30 kPa: frequencies in colours,
    measured values as dots."""
    here = rows_of(RESULTS / "ballast_shakedown_cycles.csv")
    measured = rows_of(ROOT / "data" / "reference" / "ballast_strain.csv")
    series = []
    for index, frequency in enumerate(("10", "20", "40", "60")):
        for rows, column, scale, style in (
                (here, "strain (%)", 1., "line"),
                (measured, "axial_strain_1", 100., "dots")):
            points = [(float(row.get("cycle") or row["cycle_1"]),
                       scale * float(row[column])) for row in rows
                      if row["Loading/frequency"] == frequency and
                      float(row["Loading/confining_pressure"]) == 30e3]
            series.append((f"{frequency} Hz" if style == "line" else "",
                           points, style, index))
    return chart(series + [("dots: measured", [], "", 5)],
                 ("load cycles", "permanent axial strain (%)"), (True, False))


def breakage_strain():
    """Permanent strain over the cycles between rigid sides and in a membrane,
    dashed without breakage."""
    rows = rows_of(RESULTS / "breakage_in_membrane_cycles.csv")
    series = []
    for index, (variant, name) in enumerate((("rigid", "rigid sides"),
                                             ("membrane", "membrane"))):
        for is_breaking, style in (("true", "line"), ("false", "dashes")):
            points = [(float(row["cycle"]), float(row["strain (%)"]))
                      for row in rows if row["Variants"] == variant and
                      row["Breakage/is_active"] == is_breaking]
            series.append((name if style == "line" else "", points, style,
                           index))
    return chart(series + [("dashed: without breakage", [], "", 5)],
                 ("load cycles", "permanent axial strain (%)"), (True, False))


def breakage_height():
    """Abrasion by fifths of the height over that of the specimen."""
    layers = range(1, 6)
    return chart([("membrane" if row["Variants"] == "membrane"
                   else "rigid sides",
                   [(0.2 * layer - 0.1, float(row[f"layer {layer}"]))
                    for layer in layers], "line dots", index)
                  for index, row in enumerate(rows_of(
                      RESULTS / "breakage_in_membrane_height.csv"))],
                 ("height over that of the specimen (-)",
                  "abrasion over that of the specimen (-)"),
                 limits=((0., 1.), (0.5, 1.5)))


CHARTS = {"results": (cycle_jump_errors, cycle_jump_rates, density_scaling,
                      claims_strain, claims_abrasion, claims_coordination,
                      claims_force, claims_fracture_energy, claims_size,
                      ballast_strain, breakage_strain, breakage_height),
          "performance": (time_step, engine_sizes)}


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    is_check, n_old = len(sys.argv) > 1, 0
    for folder, charts in CHARTS.items():
        pictures = DOCS / "pictures" / folder
        pictures.mkdir(parents=True, exist_ok=True)
        for draw in charts:
            path, drawing = pictures / f"{draw.__name__}.svg", draw()
            if not is_check:
                path.write_text(drawing, encoding="utf-8")
            elif not path.exists() or \
                    path.read_text(encoding="utf-8") != drawing:
                print(f"{path}: is not drawn from the tables of today: run "
                      "scripts/figures/results.py")
                n_old += 1
    return n_old > 0


if __name__ == "__main__":
    sys.exit(main())
