#!/usr/bin/env python3
"""Containers from meshes in a vibratory compaction.

    container_mesh.py SPALL cylinder|cone|input
"""
import csv
import math
import pathlib
import sys
import tempfile

from compaction import SMALL
from lab import (near, refusal_faults, resumed_faults, spall_run,
                 write_prm)
from triaxial_runs import report_faults, rows, summary

CORNERS = 48
HEIGHT = 0.1
# As many digits as the sums of thousands of contacts have.
ROUND_OFF = 1e-9
NAMES = ("history.csv", "events.csv", "ledger.csv", "particles.csv")


def area_of(radius):
    """Of the polygon with these corners."""
    return 0.5 * CORNERS * radius ** 2 * math.sin(2. * math.pi / CORNERS)


def cup(lower, upper, holes=()):
    """An OBJ file of quads, in millimetres, off the origin, open at its top."""
    lines = []
    for radius, z in ((lower, 5.), (upper, 5. + HEIGHT)):
        for k in range(CORNERS):
            angle = 2. * math.pi * k / CORNERS
            lines.append(f"v {1e3 * radius * math.cos(angle):.17g} "
                         f"{1e3 * radius * math.sin(angle):.17g} {1e3 * z}")
    lines.append("f " + " ".join(str(k) for k in range(CORNERS, 0, -1)))
    for k in range(CORNERS):
        a, b = k + 1, (k + 1) % CORNERS + 1
        if k not in holes:
            lines.append(f"f {a} {b} {b + CORNERS} {a + CORNERS}")
    return "\n".join(lines) + "\n"


def write_case(root, lower, upper, **more):
    (root / "particles.csv").write_text(
        "diameter_m,passing_1\n0.01,0\n0.016,1\n")
    (root / "cup.obj").write_text(cup(lower, upper))
    case = {section: dict(entries) for section, entries in SMALL.items()}
    case["Container"] = {"mesh": "cup.obj", "scale": 1e-3, "height": 0.07}
    case["Filling"].update({"unbalanced_ratio": 5e-4, "density": 1500,
                            "shapes": ""})
    for section, entries in more.items():
        case[section].update(entries)
    return write_prm(root / "case.prm", case)


def volume_below(lower, upper, z):
    """Of the cup, whose section grows with the square of the height."""
    at = lower + (upper - lower) * z / HEIGHT
    return z / 3. * (area_of(lower) + area_of(at) +
                     math.sqrt(area_of(lower) * area_of(at)))


def filled_faults(folder, lower, upper):
    """Density by the volume of the mesh, weight on it, particles inside."""
    history = rows(folder, "history.csv")[1]
    found = summary(folder)
    mass = found["filling"]["layers"][-1]["mass_kg"]
    faults = near("mass", mass, 1500. * volume_below(lower, upper, 0.07), 0.01)
    for row in history[-1], next(row for row in history if row["stage_1"] == 2):
        faults += near("density", row["density_kg_per_m3"], mass / volume_below(
            lower, upper, row["plate_height_m"]), ROUND_OFF)
    reached = found["filling"]["layers"][-1]
    faults += near("density of the layer", reached["density_kg_per_m3"],
                   mass / volume_below(lower, upper, reached["height_m"]),
                   ROUND_OFF)
    # The particles have come to rest and the plate has not come down yet.
    rest = next(row for row in history if row["stage_1"] == 1)
    if rest["plate_force_z_N"] != 0.:
        faults.append(f"the plate carries {rest['plate_force_z_N']} N")
    faults += near("force on the container", rest["container_force_z_N"],
                   -9.81 * mass, 1e-3)
    slope = (upper - lower) / HEIGHT
    with open(folder / "particles.csv", newline="") as stream:
        for particle in csv.DictReader(stream):
            x, y, z = (float(particle[name]) for name in "xyz")
            if z < 0. or math.hypot(x, y) > lower + slope * z:
                faults.append(f"a particle is outside: {particle}")
    return faults


def resume_faults(spall, case, root):
    def words(*options):
        return [spall, "run", case, "--out", root / "part", "--threads", 1,
                *options]
    spall_run(words("--until", 2))
    spall_run(words("--resume"))
    return resumed_faults(root / "whole", root / "part", NAMES)


def cylinder(spall, root):
    """As the cylinder of the drum with the same section."""
    radius = 0.045
    polygon = math.sqrt(math.pi * radius ** 2 / area_of(1.))
    case = write_case(root, polygon, polygon)
    spall_run([spall, "run", case, "--out", root / "whole", "--threads", 1])
    faults = filled_faults(root / "whole", polygon, polygon)
    spall_run([spall, "run", case, "--out", root / "drum", "--threads", 1,
               "--set", "Container/mesh=", "--set",
               f"Container/diameter={2. * radius}"])
    of_mesh, of_drum = summary(root / "whole"), summary(root / "drum")
    for name, tolerance in (("density_reached_kg_per_m3", 0.01),
                            ("density_asked_kg_per_m3", 0.)):
        faults += near(name, of_mesh["filling"][name],
                       of_drum["filling"][name], tolerance)
    # Seated and vibrated, as packings of other seeds differ.
    faults += near("density", of_mesh["density_kg_per_m3"],
                   of_drum["density_kg_per_m3"], 0.03)
    return faults + resume_faults(spall, case, root)


def cone(spall, root):
    """A container that widens upward."""
    case = write_case(root, 0.035, 0.05)
    spall_run([spall, "run", case, "--out", root / "whole", "--threads", 1])
    checked = spall_run([spall, "check", case]).stdout
    return filled_faults(root / "whole", 0.035, 0.05) + [
        f"check does not say {word}" for word in ("particles", "memory",
                                                  "predicted time")
        if word not in checked]


def bad_input(spall, root):
    """One clear line."""
    case = write_case(root, 0.045, 0.045)
    (root / "hole.obj").write_text(cup(0.045, 0.045, (5,)))
    (root / "bottle.obj").write_text(cup(0.045, 0.04))
    (root / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    cases = [
        (("Container/mesh=hole.obj",), "Container/mesh = hole.obj: mesh leaks"),
        (("Container/mesh=bottle.obj",), "mesh narrows towards its mouth"),
        (("Container/mesh=flat.obj", "Container/scale=1"),
         "Container/mesh = flat.obj: mesh is flat"),
        (("Container/mesh=none.obj",), "Container/mesh"),
        (("Container/height=0.11",), "must be at most the height of "
                                     "Container/mesh, 0.1"),
        (("Container/scale=3.4e-4", "Container/height=0.033"),
         "m wide: must be at least twice the largest particle"),
        (("Plate/form=tilting",), "Plate/form = tilting: must be rigid with "
                                  "Container/mesh"),
        (("Container/form=flexible", "Coupling/exchange=every_step"),
         "Container/form = flexible: must be rigid with Container/mesh"),
        (("Wall/law=dmt",), "Wall/law = dmt: must be a law without attraction"),
    ]
    return refusal_faults(spall, case, cases)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        tests = {"cylinder": cylinder, "cone": cone, "input": bad_input}
        sys.exit(report_faults(tests[sys.argv[2]](sys.argv[1],
                                                  pathlib.Path(temporary))))
