"""Charts of runs by matplotlib. Each function returns the axes."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

from .errors import InputError, need
from .table import Table

if TYPE_CHECKING:
    from .run import Run


def new_axes(axes: Any = None) -> Any:
    """The given axes, or those of a new figure."""
    if axes is not None:
        return axes
    pyplot = need("matplotlib.pyplot", "a chart")
    return pyplot.subplots(layout="constrained")[1]


def draw(axes: Any, table: Table, x: str, y: str, **style: Any) -> None:
    """One column of a table over another, with labels and units."""
    axes.plot(table[x], table[y], **style)
    axes.set_xlabel(table.label(x))
    axes.set_ylabel(table.label(y))


class RunPlots:
    """Charts of one run: ``run.plot.loops()``."""

    def __init__(self, run: Run) -> None:
        self._run = run

    def history(self, *names: str, x: str = "time", axes: Any = None) -> Any:
        """Columns of history.csv over time, or over another column ``x``. They
        must have one unit."""
        table = self._run.history
        if not names:
            raise InputError("plot.history: names of columns must be given, "
                             f"of {', '.join(table)}")
        units = {table.unit(name) for name in names}
        if len(units) > 1:
            raise InputError(f"plot.history: {', '.join(names)} have "
                             "different units: one chart each")
        axes = new_axes(axes)
        for name in names:
            draw(axes, table, x, name, label=name.replace("_", " "))
        if len(names) > 1:
            axes.set_ylabel(f"({units.pop()})")
            axes.legend()
        return axes

    def loops(self, cycles: int | Sequence[int] | None = None,
              axes: Any = None) -> Any:
        """Deviator stress, axial minus lateral, over axial strain of a dynamic
        triaxial test: all of loading, or one or some cycles by number."""
        if isinstance(cycles, int):
            cycles = [cycles]
        table = self._run.loading
        needed = ("cycle", "axial_strain", "axial_stress", "lateral_stress")
        if not all(name in table for name in needed):
            raise InputError(f"{self._run.folder}: stress-strain loops need a "
                             "run of kind dynamic_triaxial, this is of kind "
                             f"{self._run.kind}")
        axes = new_axes(axes)
        number = np.ceil(table["cycle"] - 1e-6).astype(int)
        for cycle in [None] if cycles is None else cycles:
            part = table.rows(slice(None) if cycle is None
                                else number == cycle)
            if part.n_rows == 0:
                raise InputError(f"{self._run.folder}: has no cycle {cycle}, "
                                 f"the loading has {table.n_rows} rows")
            axes.plot(100 * part["axial_strain"],
                      1e-3 * (part["axial_stress"] - part["lateral_stress"]),
                      linewidth=0.8,
                      label=None if cycle is None else f"cycle {cycle}")
        axes.set_xlabel("Axial strain (%)")
        axes.set_ylabel("Deviator stress (kPa)")
        if cycles is not None:
            axes.legend()
        return axes

    def permanent_strain(self, axes: Any = None, **style: Any) -> Any:
        """Permanent axial strain over load cycles, on a logarithmic axis."""
        table = self._run.cycles
        axes = new_axes(axes)
        style.setdefault("label", self._run.name)
        axes.semilogx(table["cycle"], 100 * table["permanent_axial_strain"],
                      marker=".", **style)
        axes.set_xlabel("Load cycle")
        axes.set_ylabel("Permanent axial strain (%)")
        return axes
