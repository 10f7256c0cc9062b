#!/usr/bin/env python3
"""Renews the tables and the picture of docs/verification/shapes.md.

    shape_page.py [SPALL] [MESHES] [--only fits|limestone|generate ...]

SPALL: build/apps/spall. MESHES: the folder with the meshes and
catalogue.csv. Each short table stands between <!-- begin NAME --> and
<!-- end NAME -->; files beside the page have every mesh. Without the meshes
only `generate` is measured.
"""
import argparse
import csv
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

from line_chart import line_chart

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "verification" / "shapes.md"
EVERY = PAGE.with_name("shape_fit_error.csv")
ORDER_20 = PAGE.with_name("shape_fit_order_20.csv")
PICTURE = ROOT / "docs" / "pictures" / "shape_fit_error.svg"
SAMPLE = [ROOT / "data" / "shapes" / name
          for name in ("limestone", "limestone_blocky")]
ORDERS = range(1, 31)
SHOWN = (4, 8, 12, 20, 30)
AT_20 = ["mesh", "triangles", "residual_largest_percent",
         "volume_error_percent", "area_error_percent", "overhang_percent",
         "saddles_percent", "ringing_percent", "convexity_1", "time_s"]
METRES = {"m": 1., "mm": 1e-3, "um": 1e-6}
SOURCES = {"nist_vcctl_sh": "NIST", "ibois_quarry_scraps": "IBOIS",
           "eesd_epfl_rubble": "EESD"}


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |"
                     for line in lines)


class Tool:
    """spall shape, its figures as numbers."""

    def __init__(self, spall, folder):
        self.spall, self.folder = spall, pathlib.Path(folder)

    def run(self, *words):
        """What is printed, or None if the input is refused."""
        ended = subprocess.run([self.spall, "shape", *map(str, words)],
                               text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, check=False)
        if ended.returncode == 1:
            return None
        ended.check_returncode()
        return ended.stdout

    def fit(self, mesh, order, unit, *options):
        facts = self.folder / "facts.json"
        done = self.run("fit", mesh, "--order", order, "--unit", unit,
                        "--max-overhang", 1, "--json", facts, "--out",
                        self.folder / "s.json", *options)
        return json.loads(facts.read_text()) if done is not None else None

    def info(self, path):
        facts = self.folder / "facts.json"
        self.run("info", path, "--json", facts)
        return json.loads(facts.read_text())["series"]


def catalogue(meshes):
    with open(meshes / "catalogue.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def extent(values, digits):
    """Least and largest as a cell."""
    return f"{min(values):.{digits}f} to {max(values):.{digits}f}"


def source_row(name, fits):
    """Residuals and errors of all meshes of a source that were fitted."""
    at_20 = [one[20]["mesh"] for one in fits]
    rms = {order: [one[order]["mesh"]["residual_rms_percent"] for one in fits
                   if one.get(order)] for order in SHOWN}
    return [name, len(fits), *(extent(rms[order], 2) for order in SHOWN),
            extent([one["volume_error_percent"] for one in at_20], 2),
            extent([one["area_error_percent"] for one in at_20], 1),
            f"{max(one['overhang_percent'] for one in at_20):.2f}"]


def fits_table(tool, meshes):
    """Residual against order by source; two files have every mesh."""
    at_20, drawn, by_source = [AT_20], {}, {}
    every = [["mesh", *(f"order_{order}_percent" for order in ORDERS)]]
    for row in catalogue(meshes):
        name = row["file"]
        fits = {order: tool.fit(meshes / name, order, row["units_guess"])
                for order in ORDERS}
        rms = {order: fit["mesh"]["residual_rms_percent"]
               for order, fit in fits.items() if fit}
        label = pathlib.Path(name).stem.replace("MA111-7-coarse-", "limestone ")
        print(label, rms, flush=True)
        every.append([label, *(f"{rms[order]:.4f}" if order in rms else ""
                               for order in ORDERS)])
        if rms:
            drawn.setdefault(SOURCES[name.split("/")[0]], []).append(rms)
        if not fits[20]:
            continue
        by_source.setdefault(SOURCES[name.split("/")[0]], []).append(fits)
        mesh, series = fits[20]["mesh"], fits[20]["series"]
        at_20.append([label, row["triangles"], *(f"{mesh[key]:.2f}" for key in (
            "residual_largest_percent", "volume_error_percent",
            "area_error_percent", "overhang_percent")),
            f"{100 * series['saddle_fraction_1']:.0f}",
            f"{100 * series['ringing_rms_1']:.2f}",
            f"{series['convexity_1']:.3f}", f"{mesh['time_s']:.3f}"])
    PICTURE.write_text(line_chart(
        drawn, "order of the series", "rms residual / mean radius, %"))
    EVERY.write_text("\n".join(map(",".join, every)) + "\n")
    ORDER_20.write_text("\n".join(map(",".join, at_20)) + "\n")
    return table(["source", "meshes", *(f"order {order}" for order in SHOWN),
                  "volume", "area", "overhang"],
                 [source_row(*one) for one in by_source.items()])


def published_series(path, out):
    """Complex coefficients with the phase of Condon and Shortley, in mm."""
    rows = [line.split() for line in path.read_text().splitlines()
            if line.strip()]
    order = max(int(row[0]) for row in rows)
    values = [0.] * (order + 1) ** 2
    for n, m, real, imaginary in rows:
        n, m, sign = int(n), int(m), (-1) ** abs(int(m))
        if m == 0:
            values[n * (n + 1)] = float(real)
        elif m > 0:
            values[n * (n + 1) + m] = sign * 2**0.5 * float(real)
            values[n * (n + 1) - m] = -sign * 2**0.5 * float(imaginary)
    out.write_text(json.dumps({
        "order": order, "unit": "mm", "coefficients": values,
        "convention": "real orthonormal, no Condon-Shortley phase"}))


def limestone_table(tool, meshes):
    folder = meshes / "nist_vcctl_sh"
    with open(folder / "limestone_MA111-7_geometry.csv", newline="",
              encoding="utf-8") as file:
        source = {row["particle"]: row for row in csv.DictReader(file)}
    rows = []
    for path in sorted((folder / "coef").glob("MA111*.dat")):
        particle = path.name.split("_")[0]
        exact = 1e-9 * float(source[particle]["volume_mm3"])
        published_series(path, tool.folder / "published.json")
        series = tool.info(tool.folder / "published.json")
        mesh = next((folder / "mesh5120").glob(particle + "_*.stl"))
        rays = tool.fit(mesh, 20, "mm")
        points = tool.fit(mesh, 20, "mm", "--from", "vertices")
        area = 1e-6 * float(source[particle]["surface_area_mm2"])
        parts = [series["volume_m3"], rays["mesh"]["volume_m3"],
                 rays["series"]["volume_m3"], points["series"]["volume_m3"]]
        rows.append([particle[-5:], f"{1e9 * exact:.1f}",
                     source[particle]["degree_used"],
                     *(f"{100 * (part / exact - 1):+.2f}" for part in parts),
                     f"{100 * (parts[3] / parts[0] - 1):+.3f}",
                     f"{100 * (points['series']['area_m2'] / area - 1):+.1f}",
                     *(f"{points['series'][key] * 1e3:.1f} / "
                       f"{float(source[particle][name]):.1f}"
                       for key, name in (("length_m", "L_mm"),
                                         ("width_m", "W_mm"),
                                         ("thickness_m", "T_mm")))])
    return table(["particle", "table, mm³", "its degree",
                  "published series, %", "mesh, %", "rays, %", "vertices, %",
                  "vertices to published, %", "area, vertices, %",
                  "L here / table, mm", "I / W, mm", "S / T, mm"], rows)


def population(meshes):
    """Mean and deviation of the source's table for all of its limestones."""
    path = meshes / "nist_vcctl_sh" / "limestone_MA111-7_geometry.csv"
    if not path.exists():
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    values = {
        "I / L": [float(row["W_mm"]) / float(row["L_mm"]) for row in rows],
        "S / I": [float(row["T_mm"]) / float(row["W_mm"]) for row in rows],
        "sphericity (Wadell)": [1 / float(row["normalised_surface_area"])
                                for row in rows]}
    return {name: (statistics.mean(of), statistics.stdev(of), len(of))
            for name, of in values.items()}


def generate_table(tool, meshes):
    printed = tool.run("generate", *SAMPLE, "--count", 500, "--seed", 1,
                       "--out", tool.folder / "particles")
    rows = [re.split(r"\s{2,}", line.strip())
            for line in printed.splitlines()[2:]]
    whole = population(meshes)
    for row in rows:
        row.append("{:.3f} ± {:.3f} ({})".format(*whole[row[0]])
                   if row[0] in whole else "")
    return table(["figure", "sample of 8", "±", "500 particles", "±",
                  "source's table"], rows)


TABLES = {"fits": fits_table, "limestone": limestone_table,
          "generate": generate_table}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("spall", nargs="?", type=pathlib.Path,
                        default=ROOT / "build" / "apps" / "spall")
    parser.add_argument("meshes", nargs="?", type=pathlib.Path,
                        default=ROOT.parent / "shared" / "shapes")
    parser.add_argument("--only", nargs="+", choices=TABLES, default=TABLES)
    options = parser.parse_args()
    has_meshes = (options.meshes / "catalogue.csv").exists()
    for name in options.only:
        if name != "generate" and not has_meshes:
            print(f"{name}: left as it is, no {options.meshes}")
            continue
        with tempfile.TemporaryDirectory() as folder:
            tool = Tool(options.spall.resolve(), folder)
            text = TABLES[name](tool, options.meshes)
        page = PAGE.read_text()
        PAGE.write_text(re.sub(
            rf"(<!-- begin {name} -->\n).*?(\n<!-- end {name} -->)",
            lambda match: match[1] + text + match[2], page, flags=re.S))
    return 0


if __name__ == "__main__":
    sys.exit(main())
