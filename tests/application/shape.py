#!/usr/bin/env python3
"""spall shape: a mesh is fitted and measured, particles are generated.

    shape.py SPALL
"""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

from test_meshes import box_triangles, stl

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHAPES, SCRIPTS = ROOT / "data" / "shapes", ROOT / "scripts"


def shape(spall, folder, *words):
    subprocess.run([spall, "shape", *map(str, words)], cwd=folder, check=True,
                   stdout=subprocess.PIPE)


def near(found, expected, tolerance, what):
    if abs(found - expected) <= tolerance * abs(expected):
        return []
    return [f"{what} is {found}, expected {expected} within {tolerance}"]


def fit_faults(spall, folder):
    """A cube, whose edges a series of order 20 rounds by a few per cent."""
    (folder / "cube.stl").write_text(stl(box_triangles()))
    shape(spall, folder, "fit", "cube.stl", "--order", 20, "--unit", "m",
          "--out", "s.json", "--json", "f.json")
    fit = json.loads((folder / "f.json").read_text())
    shape(spall, folder, "info", "s.json", "--json", "i.json")
    info = json.loads((folder / "i.json").read_text())
    mesh, series = fit["mesh"], fit["series"]
    faults = [] if info["series"] == series else ["info differs from fit"]
    side = mesh["volume_m3"] ** (1 / 3)
    return (faults
            + loose_faults(spall, folder)
            + near(mesh["area_m2"], 6 * side**2, 1e-12, "area of the cube")
            + near(series["volume_m3"], side**3, 0.003, "volume")
            + near(series["length_m"], 3**0.5 * side, 0.05, "diagonal")
            + near(series["inscribed_radius_m"], side / 2, 0.03, "inscribed")
            + near(series["inscribed_radius_free_m"], side / 2, 0.03, "free")
            + near(series["principal_inertia_1_m5"], side**5 / 6, 0.01,
                   "inertia")
            + ([] if mesh["overhang_percent"] == 0 else ["overhang"])
            + ([] if series["ringing_rms_1"] > 1e-3 else ["no ringing"])
            + ([] if 0.9 < series["convexity_1"] < 1. else ["convexity"]))


def needle_triangles(ratio, n_rings=96):
    """A spheroid of half axes 1, 1, ratio in latitudes and longitudes."""
    n_around = 48

    def point(ring, k):
        polar, azimuth = math.pi * ring / n_rings, 2 * math.pi * k / n_around
        return (math.sin(polar) * math.cos(azimuth),
                math.sin(polar) * math.sin(azimuth),
                ratio * math.cos(polar))

    for i in range(n_rings):
        for k in range(n_around):
            a, b = point(i, k), point(i + 1, k)
            c, d = point(i + 1, k + 1), point(i, k + 1)
            if i < n_rings - 1:
                yield a, b, c
            if i > 0:
                yield a, c, d


def status_of(spall, folder, *words):
    """Status and what went to the standard error."""
    ended = subprocess.run([spall, "shape", *map(str, words)], cwd=folder,
                           check=False, capture_output=True, text=True)
    return ended.returncode, ended.stderr


def misfit_faults(spall, folder):
    """A needle of 20:1 at order 30 misses a quarter of its length."""
    (folder / "needle.stl").write_text(stl(needle_triangles(20)))
    words = ("fit", "needle.stl", "--order", 30, "--unit", "mm",
             "--out", "n.json")
    status, said = status_of(spall, folder, *words)
    faults = [] if status == 1 and "does not carry" in said \
        and "--max-misfit" in said else [f"needle is fitted: {said}"]
    faults += ["refused, but written"] if (folder / "n.json").exists() else []
    status, said = status_of(spall, folder, *words, "--max-misfit", 0.5,
                             "--json", "m.json")
    faults += [] if status == 0 and "warning: needle.stl" in said \
        else [f"no warning of a misfit: {said}"]
    length = json.loads((folder / "m.json").read_text())["mesh"][
        "length_error_percent"]
    faults += [] if -30 < length < -15 else [f"length error {length} %"]
    status, said = status_of(spall, folder, "info", "n.json")
    return faults + ([] if status == 0 and "warning: n.json" in said else
                     [f"no warning of the series: {said}"])


def centroid_faults(spall, folder):
    """A ball about a point 8 % of its radius off its centre."""
    series = [0.0] * 9
    series[0] = math.sqrt(4 * math.pi)
    series[2] = 0.08 * math.sqrt(4 * math.pi / 3)
    (folder / "off.json").write_text(json.dumps({
        "name": "off", "order": 2, "unit": "m", "coefficients": series,
        "convention": "real orthonormal, no Condon-Shortley phase"}))
    status, said = status_of(spall, folder, "info", "off.json")
    return [] if status == 0 and re.search("warning: off.json: the centroid is [78]", said) \
        else [f"a centroid off its origin: {said}"]


def loose_faults(spall, folder):
    """A cube of 20 mm whose triangles have corners up to 2e-6 mm apart, of
    which each but one at every corner becomes that one."""
    loose = [tuple(tuple(20 * x + 1e-6 * ((k + d) % 3) for d, x in
                         enumerate(corner)) for corner in corners)
             for k, corners in enumerate(box_triangles())]
    (folder / "loose.stl").write_text(stl(loose))
    shape(spall, folder, "info", "loose.stl", "--unit", "mm", "--json",
          "l.json")
    mesh = json.loads((folder / "l.json").read_text())["mesh"]
    n_points = len({corner for corners in loose for corner in corners})
    return (near(mesh["volume_m3"], 8e-6, 1e-6, "volume of the loose cube")
            + near(mesh["points_welded_1"], n_points - 8, 0, "points welded")
            + near(mesh["weld_distance_m"], 1e-6 * 3**0.5 * 0.02, 1e-6,
                   "weld distance"))


def corner_faults(spall, folder):
    """The exact rounded cube and its series of order 20: edges of a curvature
    of 198.4 / m in their middle, (p - 1) 2^(1/p) / sqrt(2) / a with p = 6, and
    an inscribed radius of 20 mm."""
    cube = subprocess.run([sys.executable, "-B", SCRIPTS / "rounded_cube.py",
                           "--mesh", "40"], check=True, capture_output=True)
    (folder / "exact.obj").write_bytes(cube.stdout)
    shape(spall, folder, "fit", "exact.obj", "--order", 20, "--out", "e.json")
    shape(spall, folder, "corners", "exact.obj", "--order", 20, "--out", "k",
          "--json", "k.json")
    shape(spall, folder, "corners", "exact.obj", "e.json", "--out", "l",
          "--json", "l.json")
    found = json.loads((folder / "k.json").read_text())["corners"]
    faults = [] if found == json.loads(
        (folder / "l.json").read_text())["corners"] else ["fit and file differ"]
    faults += near(found["inscribed_mesh_m"], 0.02, 1e-9, "inscribed radius")
    faults += near(found["agreement_percent"], 100., 0.02,
                   "share of the surface that agrees")
    with open(folder / "k" / "corners.csv", newline="") as table:
        points = [{name: float(value) for name, value in row.items()}
                  for row in csv.DictReader(table)]
    same = sum(p["area_m2"] for p in points
               if p["corner_mesh_1"] == p["corner_series_1"])
    total = sum(p["area_m2"] for p in points)
    faults += near(100. * same / total, found["agreement_percent"], 1e-4,
                   "share by the table")
    edge = min(points, key=lambda p: abs(p["polar_rad"] - math.pi / 2) +
               abs(p["azimuth_rad"] - math.pi / 4))
    faults += near(edge["kappa_max_mesh_1_per_m"],
                   5. * 2. ** (1. / 6.) / 2.**0.5 / 0.02, 0.06, "edge")
    picture = (folder / "k" / "corners.svg").read_text()
    faults += [] if picture.count("<g ") == 4 and "http:" in picture \
        else ["corners.svg"]
    for words, part in ((("--patch", 2), "0.01 .. 0.5"),
                        (("e.json", "--order", 20), "is a series"),
                        (("off.json",), "a series of this mesh")):
        status, said = status_of(spall, folder, "corners", "exact.obj", *words,
                                 "--out", "m")
        if status != 1 or part not in said or (folder / "m").exists():
            faults.append(f"corners {words}: {said}")
    status, said = status_of(spall, folder, "info", "e.json", "--patch", 0.1)
    return faults + ([] if status == 1 and "is for corners" in said else
                     [f"info --patch: {said}"])


def generate_faults(spall, folder):
    sample = [SHAPES / "limestone", SHAPES / "limestone_blocky"]
    for out, count, seed in (("a", 3, 1), ("b", 2, 1), ("c", 2, 2)):
        shape(spall, folder, "generate", *sample, "--count", count, "--seed",
              seed, "--order", 12, "--out", out, "--json", out + ".json")
    texts = {out: [path.read_text() for path in sorted((folder / out).iterdir())]
             for out in "abc"}
    numbers = {out: [json.loads(text)["coefficients"] for text in texts[out]]
               for out in "abc"}
    table = json.loads((folder / "a.json").read_text())
    faults = [] if texts["a"][:2] == texts["b"] else ["not the same by seed"]
    faults += ["another seed, the same particles"] \
        if numbers["b"][0] == numbers["c"][0] else []
    faults += [] if [len(texts[out]) for out in "abc"] == [3, 2, 2] \
        else ["wrong number of particles"]
    faults += [] if all("MIT" in json.loads(text)["licence"]
                        for text in texts["a"]) else ["licence is lost"]
    return faults + near(table["particles"]["sphericity_1"],
                         table["sample"]["sphericity_1"], 0.15, "sphericity")


def main():
    spall = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        faults = (fit_faults(spall, folder) + misfit_faults(spall, folder)
                  + centroid_faults(spall, folder)
                  + corner_faults(spall, folder)
                  + generate_faults(spall, folder))
    print("\n".join(faults) or "passed")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
