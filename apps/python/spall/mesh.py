"""Surfaces of particles as meshes for others: STL and PLY."""
from __future__ import annotations

import pathlib
from typing import Any

import numpy as np

from .errors import InputError
from .vtu import Grid


def write_surfaces(grid: Grid, path: pathlib.Path, scale: float = 1.0) -> None:
    """Triangles of a grid of surfaces as binary STL or PLY, by the ending of
    the path. Lengths are in metres times ``scale``."""
    writers = {".stl": stl_bytes, ".ply": ply_bytes}
    if path.suffix.lower() not in writers:
        raise InputError(f"{path}: a mesh file ends in .stl or .ply")
    if not scale > 0:
        raise InputError(f"scale = {scale}: must be above 0")
    points = (grid.points * scale).astype("<f4")
    path.write_bytes(writers[path.suffix.lower()](
        points, grid.cells(3), grid.cell_data))


def stl_bytes(points: np.ndarray, triangles: np.ndarray,
              _: dict[str, np.ndarray]) -> bytes:
    """A binary STL with unit normals that point out."""
    rows = np.zeros(len(triangles), dtype=[
        ("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("none", "<u2")])
    corners = points[triangles]
    # Of doubles: areas of single precision would be rounded to zero.
    sides = np.diff(corners.astype(float), axis=1)
    normal = np.cross(sides[:, 0], sides[:, 1])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    rows["normal"] = normal / np.where(length > 0, length, 1)
    rows["corners"] = corners
    head = b"binary STL, surfaces of particles".ljust(80)
    return head + np.uint32(len(triangles)).tobytes() + rows.tobytes()


def ply_bytes(points: np.ndarray, triangles: np.ndarray,
              cell_data: dict[str, np.ndarray]) -> bytes:
    """A binary PLY; each face has the id of its particle and its loss [1]."""
    fields: list[Any] = [("n", "u1"), ("corners", "<i4", 3)]
    lines = ["property list uchar int vertex_indices"]
    for name, kind, word in (("id", "<i4", "int"), ("loss_1", "<f4", "float")):
        if name in cell_data:
            fields.append((name, kind))
            lines.append(f"property {word} {name}")
    faces = np.zeros(len(triangles), dtype=fields)
    faces["n"] = 3
    faces["corners"] = triangles
    for field in fields[2:]:
        faces[field[0]] = cell_data[field[0]]
    head = "\n".join([
        "ply", "format binary_little_endian 1.0",
        "comment surfaces of particles", f"element vertex {len(points)}",
        *(f"property float {axis}" for axis in "xyz"),
        f"element face {len(faces)}", *lines, "end_header", ""])
    return head.encode() + points.tobytes() + faces.tobytes()


def signed_volume(points: np.ndarray, triangles: np.ndarray) -> float:
    """Volume within closed surfaces whose triangles are counter-clockwise
    seen from outside [m^3]."""
    corners = points[triangles].astype(float)
    return float(np.einsum("ij,ij->", corners[:, 0],
                           np.cross(corners[:, 1], corners[:, 2])) / 6)
