#!/usr/bin/env python3
"""Walls of any shape, and force, moment and wear of each boundary, in the
triaxial test and between platens.

    wall_kinds.py SPALL triaxial|membrane|platens|input
"""
import pathlib
import sys
import tempfile

from lab import CUBE, near, spall_run, write_prm
from triaxial_runs import (CASE, differing, report_faults, rows, run,
                           summary, summary_faults)

# Edges of 12 x 12 x 3 mm about the middle.
BLOCK = """v -6 -6 -1.5
v 6 -6 -1.5
v 6 6 -1.5
v -6 6 -1.5
v -6 -6 1.5
v 6 -6 1.5
v 6 6 1.5
v -6 6 1.5
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""
SQUARE = """v -0.05 -0.05 0
v 0.05 -0.05 0
v 0.05 0.05 0
v -0.05 0.05 0
f 1 2 3 4
"""
SPEED = 0.2
NAMES = ("history.csv", "events.csv", "ledger.csv", "cycles.csv",
         "particles.csv")


def walls(root, *more):
    """Settings of a block in the middle of the specimen."""
    (root / "block.obj").write_text(BLOCK)
    return (f"Walls/block/mesh={root / 'block.obj'}", "Walls/block/scale=1e-3",
            "Loading/frequency=200", *more)


def balance_faults(name, row, boundaries):
    """Before the loading moves anything all boundaries together bear nothing
    but what the particles need for what they still move: a hundredth."""
    faults = []
    for axis in "xyz":
        total = sum(row[f"{boundary}_force_{axis}_N"]
                    for boundary in boundaries)
        if abs(total) > 0.01 * row["plate_force_z_N"]:
            faults.append(f"{name}: forces along {axis} add up to {total} N, "
                          f"{row['plate_force_z_N']} N on the plate")
    return faults


def continued_faults(spall, whole, part, settings, lateral):
    """Stopped after the first cycle and continued: bit for bit."""
    run(spall, part, lateral, "--until", "1", settings=settings)
    run(spall, part, lateral, "--resume", settings=settings)
    return [f"{name} differs after a restart"
            for name in differing(part, whole, NAMES)] + summary_faults(
                summary(part), summary(whole))


def triaxial(spall, root):
    """The block stays through the preparation and is pulled from the
    beginning of the loading on."""
    settings = walls(root, f"Walls/block/velocity={SPEED}, 0, 0",
                     "Loading/consolidation_unbalanced_ratio=1e-3",
                     "Breakage/fracture_energy=500")
    whole = root / "whole"
    run(spall, whole, "rigid", settings=settings)
    history = rows(whole, "history.csv")[1]
    loading = [row for row in history if row["stage_1"] == 2]
    if any(row["block_displacement_x_m"] for row in history
           if row["stage_1"] < 2):
        return ["the block moved before the loading"]
    first, last = loading[0], loading[-1]
    faults = near("displacement of the block", last["block_displacement_x_m"],
                  SPEED * (last["time_s"] - first["time_s"]), 1e-9)
    sides = ("x_min", "x_max", "y_min", "y_max", "base", "plate", "block")
    faults += balance_faults("rigid", first, sides)
    # What presses on the block in its way, by two millimetres, holds it back.
    if not last["block_force_x_N"] < first["block_force_x_N"]:
        faults.append(f"the block is pushed: {last['block_force_x_N']} N, "
                      f"{first['block_force_x_N']} N before")
    size = 2. * first["x_max_moment_y_Nm"] / first["x_max_force_x_N"]
    if not 0.02 < size < 0.08:
        faults.append(f"the force on a side acts at {0.5 * size} m")
    residual = summary(whole)["energy_residual_ratio_1"]
    if not residual < 1e-3:
        faults.append(f"energy residual {residual}")
    found = summary(whole)
    lost = sum(found["removed_mass_kg"].values())
    events = sum(event["removed_volume_m3"]
                 for event in rows(whole, "events.csv")[1])
    faults += near("mass by boundary", lost, 2750. * events, 1e-9)
    named = sum(found["walls"][f"{name}_removed_mass_kg"] for name in sides)
    faults += near("mass in the columns", named + found["removed_mass_kg"].get(
        "particles", 0.), lost, 1e-9)
    return faults + continued_faults(spall, whole, root / "part", settings,
                                     "rigid")


def membrane(spall, root):
    """A block at rest in a specimen with a membrane."""
    settings = walls(root, "Loading/consolidation_unbalanced_ratio=1e-3")
    whole = root / "whole"
    run(spall, whole, "membrane", settings=settings)
    first = next(row for row in rows(whole, "history.csv")[1]
                 if row["stage_1"] == 2)
    faults = balance_faults("membrane", first,
                            ("membrane", "base", "plate", "block"))
    if first["x_min_force_x_N"] != 0.:
        faults.append("a side that is gone bears a force")
    # The block has no pores.
    bare = root / "bare"
    run(spall, bare, "membrane", settings=("Loading/frequency=200",))
    with_block, without = (summary(folder)["initial_porosity"]
                           for folder in (whole, bare))
    if abs(with_block - without) > 0.05:
        faults.append(f"porosity {with_block}, {without} without the block")
    return faults


def platens(spall, root):
    """Platens that are squares of two triangles are the planes."""
    (root / "square.obj").write_text(SQUARE)
    case = write_prm(root / "cube.prm", {**CUBE, "Press": {
        "displacement": 5e-4, "speed": 1e-2, "rows": 50}})
    faults = []
    for geometry in ("radial", "surface"):
        words = [spall, "run", case, "--threads", 1,
                 "--set", "Breakage/is_active=false",
                 "--set", f"Contact/wall_geometry={geometry}",
                 "--set", f"Contact/geometry={geometry}"]
        of_planes, of_mesh = root / f"planes_{geometry}", root / geometry
        spall_run([*words, "--out", of_planes])
        spall_run([*words, "--out", of_mesh,
                   "--set", f"Walls/lower/mesh={root / 'square.obj'}",
                   "--set", f"Walls/upper/mesh={root / 'square.obj'}",
                   "--set", "Walls/upper/particles=inside",
                   "--set", "Walls/upper/position=0.01, 0, 3"])
        forces = [[row["force_N"] for row in rows(out, "history.csv")[1]]
                  for out in (of_planes, of_mesh)]
        most = max(forces[0])
        worst = max(abs(a - b) for a, b in zip(*forces))
        if len(forces[0]) != len(forces[1]) or worst > 1e-6 * most:
            faults.append(f"{geometry}: forces differ by {worst} N of {most}")
        last = rows(of_mesh, "history.csv")[1][-1]
        if last["upper_force_z_N"] != last["force_N"]:
            faults.append(f"{geometry}: the force is not that on the wall")
        faults += near(f"{geometry}: displacement",
                       last["upper_displacement_z_m"],
                       -last["displacement_m"], 1e-9)
    return faults


def bad_input(spall, root):
    """One clear line."""
    (root / "square.obj").write_text(SQUARE)
    cube = write_prm(root / "cube.prm", CUBE)
    block = root / "block.obj"
    block.write_text(BLOCK)

    def said(case, settings):
        words = [spall, "check", case]
        for setting in settings:
            words += ["--set", setting]
        return spall_run(words, status=1).stderr.strip()

    mesh = f"Walls/upper/mesh={root / 'square.obj'}"
    grid = (f"Walls/grid/mesh={block}", "Walls/grid/scale=1e-3")
    cases = [
        (cube, (mesh, "Walls/upper/velocity=0, 0, 1"),
         "Walls/upper/velocity = 0, 0, 1: must not be set for a platen"),
        (cube, (mesh, "Walls/upper/position=1, 0, 0"),
         "does not meet the particle"),
        (CASE, (f"Walls/grid/mesh={block}", "Walls/grid/scale=4.5e-3"),
         "Walls/grid: reaches 0.002 m beyond the specimen"),
        (CASE, (*grid, "Walls/grid/rotation_rate=1", "CycleJump/tolerance=0.1"),
         "Walls/grid/rotation_rate = 1: must not be set with CycleJump"),
        (CASE, (f"Walls/base/mesh={block}", "Walls/base/scale=1e-3"),
         "Walls/base: tests of kind dynamic_triaxial have a boundary of this "
         "name"),
    ]
    faults = []
    for case, settings, words in cases:
        line = said(case, settings)
        if words not in line or "\n" in line:
            faults.append(f"{settings}: {line}: must have '{words}'")
    return faults


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        tests = {"triaxial": triaxial, "membrane": membrane,
                 "platens": platens, "input": bad_input}
        sys.exit(report_faults(tests[sys.argv[2]](sys.argv[1],
                                                  pathlib.Path(temporary))))
