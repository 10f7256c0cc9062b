"""The list of parameters of a kind of case, as the program prints it."""
from __future__ import annotations

import dataclasses
import functools
import json
import math
import numbers
import os
from typing import Any, Iterable

import numpy as np

from .errors import InputError, UnknownKey
from .program import call, find_program
from .units import did_you_mean

_WALL = "Walls/"
_ANY_WALL = "Walls/NAME"


@dataclasses.dataclass(frozen=True)
class Parameter:
    """One key of a case."""

    section: str
    key: str
    type: str        #: number, integer, boolean, text, path, vector or choice
    unit: str        #: "-" if it has none
    default: Any     #: of the kind
    allowed: str     #: what a value may be, as a sentence
    sentence: str    #: what it is
    lower: float
    upper: float
    is_lower_open: bool  #: the lower limit itself is not allowed
    is_upper_open: bool
    names: tuple[str, ...]      #: of a choice
    old_names: tuple[str, ...]  #: deprecated keys

    @property
    def name(self) -> str:
        """Section/key."""
        return f"{self.section}/{self.key}"

    def checked(self, value: Any) -> Any:
        """The value in the type of the parameter. InputError if it is not
        allowed."""
        try:
            return getattr(self, "_" + self.type)(value)
        except (TypeError, ValueError):
            raise InputError(f"{self.name} = {value}: must be "
                             f"{self.allowed}") from None

    def _in_range(self, value: float) -> bool:
        above = value > self.lower if self.is_lower_open \
            else value >= self.lower
        below = value < self.upper if self.is_upper_open \
            else value <= self.upper
        return above and below and math.isfinite(value)

    def _number(self, value: Any) -> float:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        if isinstance(value, str) and "_" in value:
            raise ValueError
        result = float(value)
        if not self._in_range(result):
            raise ValueError
        return result

    def _integer(self, value: Any) -> int:
        result = self._number(value)
        if result != math.floor(result) or abs(result) > 2147483647:
            raise ValueError
        return int(result)

    def _boolean(self, value: Any) -> bool:
        if value in ("true", "false"):
            return value == "true"
        if not isinstance(value, bool) and \
                type(value).__name__ not in ("bool_", "bool"):
            raise TypeError
        return bool(value)

    def _text(self, value: Any) -> str:
        result = os.fspath(value)
        if not isinstance(result, str):
            raise TypeError
        if "\n" in result or "\r" in result:
            raise ValueError
        return str(result)

    def _path(self, value: Any) -> str:
        return os.path.expanduser(self._text(value))

    def _vector(self, value: Any) -> tuple[float, ...]:
        if isinstance(value, str):
            value = value.replace(",", " ").split()
        if isinstance(value, numbers.Number):
            raise TypeError
        result = tuple(self._number(one) for one in value)
        if len(result) != 3:
            raise ValueError
        return result

    def _choice(self, value: Any) -> str:
        if value not in self.names:
            raise ValueError
        return str(value)


class ParameterList:
    """All parameters of a kind, and of the walls that its cases have."""

    def __init__(self, printed: dict[str, Any]) -> None:
        self.kind: str = printed["kind"]
        self.seed_key: str = printed["seed_key"]
        self.sections = {one["name"]: one["sentence"]
                         for one in printed["sections"]}
        self._old_sections = {old: one["name"]
                              for one in printed["sections"]
                              for old in one.get("old_names", ())}
        self._all = {one.name: one for one in _entries(printed)}
        #: What the template of the kind shows, or the case has.
        self.values = values_of(printed)

    def names(self, walls: Iterable[str] = ()) -> list[str]:
        """Section/key of all parameters, with those of named walls."""
        found = [name for name in self._all
                 if not name.startswith(_ANY_WALL + "/")]
        keys = [name[len(_ANY_WALL):] for name in self._all
                if name.startswith(_ANY_WALL + "/")]
        return found + [_WALL + wall + key for wall in walls for key in keys]

    def find(self, name: str) -> Parameter:
        """The parameter of Section/key, also by a deprecated name. InputError
        with what is near, or with all names, if there is none."""
        section, slash, key = name.rpartition("/") \
            if isinstance(name, str) else ("", "", "")
        if not slash or not section:
            raise UnknownKey(f"{name}: must be Section/key")
        section = self._old_sections.get(section, section)
        listed = _ANY_WALL if section.startswith(_WALL) else section
        if listed not in self.sections:
            known = [one for one in self.sections if one != _ANY_WALL]
            raise UnknownKey(f"{name}: a case of kind {self.kind} has no "
                             f"section {section}"
                             f"{did_you_mean(section, known)}")
        parameter = self._all.get(f"{listed}/{key}") or next(
            (one for one in self._all.values()
             if one.section == listed and key in one.old_names), None)
        if parameter is None:
            keys = [one.key for one in self._all.values()
                    if one.section == listed]
            raise UnknownKey(f"{name}: no key of this name in section "
                             f"{section}{did_you_mean(key, keys)}")
        return dataclasses.replace(parameter, section=section)


def values_of(printed: dict[str, Any]) -> dict[str, Any]:
    """Section/key -> value of a printed list; vectors as tuples."""
    return {f"{section['name']}/{one['key']}":
            tuple(one["value"]) if one["type"] == "vector" else one["value"]
            for section in printed["sections"]
            for one in section["parameters"]
            if section["name"] != _ANY_WALL}


def _entries(printed: dict[str, Any]) -> Iterable[Parameter]:
    for section in printed["sections"]:
        for one in section["parameters"]:
            default = one["default"]
            yield Parameter(
                section["name"], one["key"], one["type"], one["unit"],
                tuple(default) if one["type"] == "vector" else default,
                one["allowed"], one["sentence"],
                one.get("lower", -math.inf), one.get("upper", math.inf),
                one.get("is_lower_open", False),
                one.get("is_upper_open", False),
                tuple(one.get("names", ())), tuple(one.get("old_names", ())))


def parameters_of(kind: str) -> ParameterList:
    """The list of a kind. InputError that names the kinds if there is none."""
    program = find_program()
    return _parameters(kind, str(program), program.stat().st_mtime_ns)


@functools.lru_cache(maxsize=32)
def _parameters(kind: str, _program: str, _time: int) -> ParameterList:
    return ParameterList(json.loads(call("template", kind, "--json")))
