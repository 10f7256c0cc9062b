"""The particle engine in the process of Python: particles, contacts, breakage
and walls, stepped from a script, with the bits of the program.

    from spall import engine as dem
    parameters = dem.Parameters()
    parameters.gravity = [0., 0., -9.81]
    scene = dem.Engine(parameters)
    scene.add_plane([0., 0., 0.], [0., 0., 1.])
    scene.add_sphere(0.01, [0., 0., 0.05])
    scene.advance(1e-5, 10000)
    scene.position  # n x 3, a view of the memory of the engine [m]

This is the compiled module `spall_engine`, which is installed beside this
package and lies in the folder `python` of a build; it needs numpy.
"""
from __future__ import annotations

import json
import os

try:
    from spall_engine import (BreakageParameters, ContactGeometry, Engine,
                              GeometryParameters, MeshWall, Parameters,
                              ParticleMaterial, Plane, Shape, WallMaterial,
                              law_parameters)
except ImportError as missing:
    raise ImportError(
        "spall.engine needs the compiled module spall_engine: it is installed "
        "with Spall where pybind11 was there, or lies in the folder python of "
        "the build (PYTHONPATH)") from missing

__all__ = ["BreakageParameters", "ContactGeometry", "Engine",
           "GeometryParameters", "MeshWall", "Parameters", "ParticleMaterial",
           "Plane", "Shape", "WallMaterial", "law_parameters", "read_shape"]


def read_shape(file: str | os.PathLike[str]) -> Shape:
    """A shape of `spall shape fit`: JSON with coefficients in metres.

    Raises ValueError where the file is no such shape.
    """
    with open(file, encoding="utf-8") as text:
        content = json.load(text)
    try:
        unit, coefficients = content["unit"], content["coefficients"]
    except (KeyError, TypeError):
        raise ValueError(f"{file}: no shape: must have unit and "
                         "coefficients") from None
    if unit not in ("m", "mm"):
        raise ValueError(f"{file}: unit = {unit}: must be m or mm")
    scale = 1. if unit == "m" else 1e-3
    return Shape([scale * one for one in coefficients])
