#!/usr/bin/env python3
"""Ground from a file of gmsh: a block is the block that Spall makes, and one
that is no box runs with closed books.

    ground_meshes.py SPALL block|cone
"""
import math
import pathlib
import sys
import tempfile

from lab import resumed_faults, write_prm
from subgrade import (TABLES, changed, energy_faults, go, loading_rows,
                      output_faults, stop_faults)
from test_meshes import block, extruded, gmsh
from triaxial_runs import differing, report_faults, summary

FILES = [*TABLES, "transfer.csv", "profile.csv", "bowl.csv"]


def lines(first, n):
    """Mesh lines a sixteenth of a metre apart: exact in binary."""
    return [first + k / 16 for k in range(n + 1)]


def block_faults(spall, root):
    """The same block with and without a file: the same bits."""
    across = lines(-0.375, 12)
    (root / "block.msh").write_text(
        gmsh(*block(across, across, lines(-0.5, 8))))
    own = {"length": 0.75, "width": 0.75, "cell_size": 0.0625, "growth": 1,
           "layers": "0.125 40e6 0.3 1900, 0.375 20e6 0.3 1800"}
    for name, ground in (("own", own), ("file", {
            "mesh": "block.msh", "layers": own["layers"], "length": 0.1})):
        case = changed(Pulse={"rest": 0.01}, LoadPlate={"diameter": 0.125})
        case["Subgrade"] = ground
        write_prm(root / f"{name}.prm", case)
        go([spall, "run", root / f"{name}.prm", "--threads", 1, "--out",
            root / name])
    return [f"{name} differs with the block from a file"
            for name in differing(root / "file", root / "own", FILES)]


def round_plan(n, half, radius, n_rings):
    """Quads of a circle: a square of 2n x 2n, its inner nodes out of line, and
    rings round it."""
    points, number, quads = [], {}, []
    for j in range(-n, n + 1):
        for i in range(-n, n + 1):
            is_inner = max(abs(i), abs(j)) < n and (i, j) != (0, 0)
            off = 0.15 * half / n * is_inner
            number[i, j] = len(points)
            points.append((half * i / n + off * math.sin(3 * i + 5 * j),
                           half * j / n + off * math.cos(7 * i - 2 * j)))
    for j in range(-n, n):
        for i in range(-n, n):
            quads.append([number[at] for at in (
                (i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))])
    rim = [(k, -n) for k in range(-n, n)] + [(n, k) for k in range(-n, n)] + \
        [(-k, n) for k in range(-n, n)] + [(-n, -k) for k in range(-n, n)]
    before = [number[at] for at in rim]
    for ring in range(1, n_rings + 1):
        share, after = ring / n_rings, []
        for i, j in rim:
            x, y = half * i / n, half * j / n
            scale = 1 - share + share * radius / math.hypot(x, y)
            after.append(len(points))
            points.append((scale * x, scale * y))
        for k, start in enumerate(before):
            follow = (k + 1) % len(rim)
            quads.append([start, after[k], after[follow], before[follow]])
        before = after
    return quads, points


def cone(wider, deeper):
    """A round block, wider below, whose bottom is inclined: 0.5 m deep in the
    middle."""
    heights = [-0.5, -0.35, -0.2, -0.1, -0.05, 0.]
    nodes, cells = extruded(*round_plan(4, 0.14, 0.4, 5), heights)
    return [(x * (1 - wider * z), y * (1 - wider * z),
             z * (1 + deeper * x)) for x, y, z in nodes], cells


def cone_faults(spall, root):
    nodes, cells = cone(0.4, 0.3)
    deepest = -min(z for x, y, z in nodes)
    mesh = root / "cone.msh"
    mesh.write_text(gmsh(nodes, cells))
    case = changed(LoadPlate={"diameter": 0.14}, Pulse={"rest": 0.1})
    case["Subgrade"] = {"mesh": "cone.msh", "layers":
                        f"0.1 40e6 0.3 1900, {deepest - 0.1!r} 20e6 0.3 1800"}
    words = [spall, "run", write_prm(root / "cone.prm", case), "--threads", 1,
             "--out"]
    go([*words, root / "cone"])
    faults = energy_faults(root / "cone") + output_faults(root / "cone")
    if summary(root / "cone")["subgrade_cells"] != len(cells):
        faults.append("cells are missing")
    ends = [abs(loading_rows(root / "cone")[k]["subgrade_mean_settlement_m"])
            for k in (0, -1)]
    peak = summary(root / "cone")["subgrade_settlement_peak_m"]
    if not peak > 1e-5 or not max(ends) < peak:
        faults.append(f"settlements {ends}, peak {peak}")
    # Another mesh is refused, the same under another name is not.
    faults += stop_faults([*words, root / "cut"], root / "cut", "2")
    (root / "same.msh").write_text(mesh.read_text())
    mesh.write_text(gmsh(*cone(0.39, 0.3)))
    said = go([*words, root / "cut", "--resume"], 1).stderr
    if "contents of Subgrade/mesh" not in said:
        faults.append(f"a changed mesh: {said}")
    go([*words, root / "cut", "--resume", "--set", "Subgrade/mesh=same.msh"])
    return faults + resumed_faults(root / "cone", root / "cut", FILES)


def main():
    spall = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        faults = {"block": block_faults, "cone": cone_faults}[sys.argv[2]]
        return report_faults(faults(spall, root))


if __name__ == "__main__":
    sys.exit(main())
