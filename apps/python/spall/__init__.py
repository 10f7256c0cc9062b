"""Spall from Python: cases, runs, studies, calibration and packings.

All numbers are in SI units. Tables have their columns by name without the
unit, and the unit beside it: ``table["axial_stress"]`` is in
``table.unit("axial_stress")``, "Pa".

    import spall

    case = spall.Case.from_template("dynamic_triaxial")
    case["Loading/cycles"] = 5
    run = case.run("runs/five", threads=2)
    print(run.cycles["permanent_axial_strain"])

Numpy is required. Pandas, matplotlib, scipy, VTK and h5py are used where they
are installed, and named in the message where one of them is needed and missing.
"""
from __future__ import annotations

try:
    import numpy as _numpy  # noqa: F401
except ImportError as _error:
    raise ImportError("spall needs numpy: apt install python3-numpy") \
        from _error

from .calibration import Calibration, calibrate
from .case import Case
from .compare import Comparison, compare
from .errors import InputError, MissingPackage, RunError, SpallError
from .frame_tables import FrameTables, read_frame_tables
from .frames import Frame
from .packing import Packing, read_packing
from .parameters import Parameter
from .program import Progress, find_program, version
from .run import Run
from .study import Study
from .table import Record, Table
from .targets import Curve, Value
from .vtu import Grid, read_vtu

__all__ = [
    "Calibration", "Case", "Comparison", "Curve", "Frame",
    "FrameTables", "Grid", "InputError", "MissingPackage", "Packing",
    "Parameter", "Progress", "Record", "Run", "RunError", "SpallError",
    "Study", "Table", "Value", "calibrate", "compare", "find_program",
    "read_frame_tables", "read_packing", "read_vtu", "version",
]
