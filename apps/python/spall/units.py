"""Units in the names of columns: ``axial_stress_Pa`` is a stress in Pa."""
from __future__ import annotations

import difflib
import re
from typing import Iterable

# Endings of names, and how the unit is printed.
_BASES = {"1": "1", "m": "m", "m2": "m^2", "m3": "m^3", "s": "s", "N": "N",
          "J": "J", "Pa": "Pa", "kg": "kg", "Hz": "Hz", "Nm": "N m",
          "Ns": "N s", "B": "B", "rad": "rad", "deg": "deg", "percent": "%",
          "W": "W"}
_PER = {"s": "s", "m": "m", "m2": "m^2", "m3": "m^3", "sN": "(s N)",
        "step": "step", "update": "update"}
_ENDING = re.compile(
    r"^(?P<name>.+?)_(?P<unit>" + "|".join(sorted(_BASES, key=len)[::-1]) +
    r")(?:_per_(?P<per>" + "|".join(sorted(_PER, key=len)[::-1]) + r"))?$")

_MOST_LISTED = 20  # words that a message names


def split_unit(full_name: str) -> tuple[str, str]:
    """Name and unit of ``name_unit``; the unit "1" where it has none.

    >>> split_unit("density_kg_per_m3")
    ('density', 'kg/m^3')
    """
    found = _ENDING.match(full_name)
    if not found:
        return full_name, "1"
    unit = _BASES[found["unit"]]
    if found["per"]:
        unit += "/" + _PER[found["per"]]
    return found["name"], unit


def table_unit(unit: str) -> str:
    """Unit of a key of a case as a table has it: "1" for none, not "-"."""
    return "1" if unit == "-" else unit


def label(name: str, unit: str) -> str:
    """Text of an axis: ``Axial stress (Pa)``."""
    words = name.replace("_", " ")
    words = words[:1].upper() + words[1:]
    return words if unit in ("1", "-", "") else f"{words} ({unit})"


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """", did you mean X?" where a known word is near; else all known words
    where there are few."""
    words = list(known)
    near = difflib.get_close_matches(word, words, n=1)
    if near:
        return f", did you mean {near[0]}?"
    if not 0 < len(words) <= _MOST_LISTED:
        return ""
    return f"; there {'is' if len(words) == 1 else 'are'} {', '.join(words)}"
