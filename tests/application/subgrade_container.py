#!/usr/bin/env python3
"""Sides of a subgrade test from a mesh.

    subgrade_container.py SPALL round|box|input
"""
import csv
import math
import pathlib
import sys
import tempfile

from lab import (near, refusal_faults, resumed_faults, spall_run,
                 write_prm)
from subgrade import TABLES, changed, loading_rows, stop_faults
from triaxial_runs import report_faults, rows, summary

GRAVITY = 9.81
HEIGHT = 0.15
RADIUS = 0.1
CORNERS = 48
# As many digits as the sums of thousands of contacts have.
ROUND_OFF = 1e-9


def ring(radius, n=CORNERS, turn=0.):
    return [(radius * math.cos(turn + 2. * math.pi * k / n),
             radius * math.sin(turn + 2. * math.pi * k / n))
            for k in range(n)]


def area_of(corners):
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1]
                     for a, b in zip(corners, corners[1:] + corners[:1]))


def tube(lower, upper, ends=0):
    """An OBJ file in millimetres, off its height: quads between two rings; with
    a floor, a lid or both."""
    n = len(lower)
    lines = [f"v {1e3 * x:.17g} {1e3 * y:.17g} {1e3 * z:.17g}"
             for corners, z in ((lower, 5.), (upper, 5. + HEIGHT))
             for x, y in corners]
    for k in range(n):
        a, b = k + 1, (k + 1) % n + 1
        lines.append(f"f {a} {b} {b + n} {a + n}")
    if ends > 0:
        lines.append("f " + " ".join(str(k) for k in range(n, 0, -1)))
    if ends > 1:
        lines.append("f " + " ".join(str(k) for k in range(n + 1, 2 * n + 1)))
    return "\n".join(lines) + "\n"


def write_case(root, mesh, **sections):
    (root / "tube.obj").write_text(mesh)
    return write_prm(root / "case.prm", changed(
        Container={"mesh": "tube.obj", "scale": 1e-3}, **sections))


def particles_of(folder):
    with open(folder / "particles.csv", newline="") as stream:
        return [{name: float(text) for name, text in row.items()
                 if name in ("x", "y", "z", "radius")}
                for row in csv.DictReader(stream)]


def weight_faults(folder, least_share=1e-3):
    """Ground and mesh carry the weight of plate and particles, what the pulse
    adds, and what their momentum changes over the record: the particles move
    with the plate."""
    found, loading = summary(folder), loading_rows(folder)
    times = [row["loading_time_s"] for row in loading]
    length = times[-1] - times[0]

    def mean(column):
        return sum(0.5 * (a[column] + b[column]) *
                   (b["loading_time_s"] - a["loading_time_s"])
                   for a, b in zip(loading, loading[1:])) / length

    weight = GRAVITY * (40. + 2750. * found["solid_volume_m3"])
    carried = mean("subgrade_force_N") - mean("container_force_z_N")
    faster = (loading[-1]["plate_velocity_m_per_s"] -
              loading[0]["plate_velocity_m_per_s"])  # downward
    impulse = found["pulse_impulse_Ns"] - weight / GRAVITY * faster
    faults = near("weight", carried, weight + impulse / length, 2e-3)
    # The mesh carries some of it by friction, and no net force across.
    share = -mean("container_force_z_N") / weight
    print(f"of {weight:.2f} N the mesh carries {100. * share:.2f} %; ground "
          f"and mesh {carried:.2f} N, pulse "
          f"{found['pulse_impulse_Ns'] / length:.2f} N")
    if not least_share < share < 0.2:
        faults.append(f"share of the mesh {share}")
    return faults


def volume_faults(folder, area):
    """Porosity by the volume of the tube; the particles that its share gives."""
    found, particles = summary(folder), particles_of(folder)
    solid = sum(4. / 3. * math.pi * one["radius"] ** 3 for one in particles)
    faults = near("porosity", 1. - found["initial_porosity"],
                  solid / (area * found["layer_height_m"]), ROUND_OFF)
    # As many particles as come nearest to the volume that is asked for.
    largest = 4. / 3. * math.pi * 0.0225 ** 3
    if not abs(solid - 0.5 * area * 0.06) < largest:
        faults.append(f"solid {solid} m^3 of {0.5 * area * 0.06} m^3")
    return faults


def round_tube(spall, root):
    """A round tube with floor and lid, both taken off: weights, volumes, files;
    a restart, a condensed ground."""
    corners = ring(RADIUS)
    case = write_case(root, tube(corners, corners, 2))
    words = [spall, "run", case, "--threads", 1, "--out"]
    spall_run([*words, root / "whole"])
    faults = weight_faults(root / "whole")
    faults += volume_faults(root / "whole", area_of(corners))
    for one in particles_of(root / "whole"):
        # Overlaps are some micrometres.
        if math.hypot(one["x"], one["y"]) + one["radius"] > RADIUS + 1e-4:
            faults.append(f"a particle is outside: {one}")
    header = rows(root / "whole", "history.csv")[0]
    faults += [f"history.csv has {name}" for name in header
               if name.startswith("x_min_")]
    names = {path.name for path in (root / "whole" / "frames").iterdir()}
    if "walls_00001.vtu" not in names:
        faults.append("frames/walls_00001.vtu is missing")
    for stage in ("0", "2"):
        faults += stop_faults([*words, root / "cut",
                               *(["--resume"] if stage == "2" else [])],
                              root / "cut", stage)
    spall_run([*words, root / "cut", "--resume"])
    faults += resumed_faults(root / "whole", root / "cut",
                             [*TABLES, "particles.csv", "bowl.csv"])
    spall_run([*words, root / "condensed", "--set", "Subgrade/body=condensed",
               "--set", "Coupling/body_time=implicit", "--set",
               "Record/stress_depths=", "--set", "Pulse/rest=0.1"])
    return faults + weight_faults(root / "condensed")


def box(spall, root):
    """A tube with the cross-section of the box is the box: the same particles,
    which begin alike and come to rest alike."""
    corners = ring(0.1 * math.sqrt(2.), 4, 0.25 * math.pi)
    case = write_case(root, tube(corners, corners))
    words = [spall, "run", case, "--threads", 1, "--out"]
    spall_run([*words, root / "mesh"])
    spall_run([*words, root / "planes", "--set", "Container/mesh="])
    mesh, planes = (rows(root / name, "history.csv")[1]
                    for name in ("mesh", "planes"))
    faults = volume_faults(root / "mesh", 0.04)
    # Particles fall on and bounce alike until round-off has grown.
    begun = 0
    for one, other in zip(mesh, planes):
        if one["time_s"] > 0.1:
            break
        begun += 1
        for name in ("kinetic_energy_J", "subgrade_force_N"):
            if abs(one[name] - other[name]) > 1e-6 * max(1e-3, other[name]):
                faults.append(f"{name} at {one['time_s']} s: {one[name]}, of "
                              f"the box {other[name]}")
    found = summary(root / "mesh"), summary(root / "planes")
    print(f"{begun} equal rows; " + ", ".join(
        f"{name} {found[0][name]:.4g} and {found[1][name]:.4g}" for name in
        ("layer_height_m", "initial_porosity", "dead_load_N",
         "plate_settlement_peak_m", "subgrade_settlement_peak_m")))
    if begun < 5 or found[0]["n_particles"] != found[1]["n_particles"]:
        faults.append("the cases do not begin alike")
    # At rest on the same ground, as packings of other seeds differ.
    for name, tolerance in (("layer_height_m", 0.03),
                            ("initial_porosity", 0.05), ("dead_load_N", 0.02),
                            ("subgrade_settlement_peak_m", 0.2)):
        faults += near(name, found[0][name], found[1][name], tolerance)
    # Its sides stand apart from what is under the disc.
    return faults + weight_faults(root / "mesh", least_share=0.)


def bad_input(spall, root):
    """One clear line."""
    corners = ring(RADIUS)
    case = write_case(root, tube(corners, corners))
    meshes = {
        "bottle": tube(corners, ring(0.08)),
        "aside": tube(*2 * [[(x + 0.35, y) for x, y in corners]]),
        "leaning": tube(corners, [(x + 0.05, y) for x, y in corners]),
        "hole": "\n".join(tube(corners, corners).splitlines()[:-1]) + "\n",
        "uneven": tube(corners, corners).replace(
            f"v {1e3 * RADIUS:.17g} 0 5000", f"v {1e3 * RADIUS:.17g} 0 4990")}
    for name, text in meshes.items():
        (root / f"{name}.obj").write_text(text)
    (root / "placed.csv").write_text("x,y,z,radius\n0,0,0.02,0.015\n"
                                     "0.2,0,0.02,0.015\n")
    cases = [
        (("Container/mesh=bottle.obj",), "mesh narrows towards its mouth"),
        (("Container/mesh=hole.obj",), "mesh leaks: it is open from 0 m"),
        (("Container/mesh=uneven.obj",), "must be open at flat rims at its "
                                         "bottom and its top alone"),
        (("Container/mesh=aside.obj", "LoadPlate/diameter=0.05"),
         "LoadPlate/diameter = 0.05: the plate, with its middle on the z axis, "
         "must fit into Container/mesh"),
        (("Container/mesh=leaning.obj",), "LoadPlate/diameter = 0.14: the "
                                          "plate, with its middle on"),
        (("LoadPlate/form=block", "LoadPlate/length=0.15",
          "LoadPlate/width=0.15"), "LoadPlate/length = 0.15: the plate"),
        (("Subgrade/length=0.19",),
         "Subgrade/length = 0.19: must be at least 0.2: Container/mesh stands "
         "up to 0.1 m from the z axis along x"),
        (("Container/scale=6e-4",), "m wide: must be at least three times the "
                                    "largest particle"),
        (("Layer/thickness=0.16",), "Layer/thickness = 0.16: must be at most "
                                    "the height of Container/mesh, 0.15"),
        (("Wall/law=dmt",), "Wall/law = dmt: must be a law without attraction"),
        (("Layer/particles=placed.csv",), "placed.csv:3: its centre must be "
                                          "inside of Container/mesh"),
        (("Container/diameter=0.2",), "a case of kind subgrade has no key "
                                      "diameter in section Container"),
    ]
    return refusal_faults(spall, case, cases)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        tests = {"round": round_tube, "box": box, "input": bad_input}
        sys.exit(report_faults(tests[sys.argv[2]](sys.argv[1],
                                                  pathlib.Path(temporary))))
