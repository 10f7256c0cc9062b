"""Case files (.prm): the resolved case of a run folder, and writing."""
from __future__ import annotations

import pathlib
import re
from typing import Any, Iterator, Mapping, NamedTuple

from .errors import InputError
from .table import Record

_UNIT = re.compile(r"\[([^\]]*)\]\s*(?:Allowed: (.*))?$")


class Entry(NamedTuple):
    """One line ``set key = value`` with what its comment says."""

    section: str
    key: str
    text: str
    unit: str     # "-" if it has none
    allowed: str  # empty for texts and paths


def read_entries(path: pathlib.Path) -> Iterator[Entry]:
    """The entries of a case file that the program has written. Units are those
    of the comments above the keys."""
    sections: list[str] = []
    comment: list[str] = []
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise InputError(f"{path}: no such file") from None
    for raw in text.splitlines():
        line = raw.strip()
        if line.startswith("#"):
            comment.append(line[1:].strip())
            continue
        if line.startswith("subsection "):
            sections.append(line[len("subsection "):].strip())
        elif line == "end" and sections:
            sections.pop()
        elif line.startswith("set ") and "=" in line:
            key, _, value = line[len("set "):].partition("=")
            found = _UNIT.search(" ".join(comment))
            yield Entry("/".join(sections), key.strip(), unquoted(value),
                        found[1] if found else "-",
                        (found[2] or "") if found else "")
        comment = []


def unquoted(value: str) -> str:
    """The value of an entry: without comment, or what is in its quotes."""
    value = value.strip()
    found = re.match(r'"((?:[^"]|"")*)"\s*(?:#.*)?$', value)
    if found:
        return found[1].replace('""', '"')
    return re.split(r"\s#", value)[0].strip()


def quoted(value: str) -> str:
    """The value as a .prm needs it: in double quotes where it would be read
    as another."""
    is_plain = ("#" not in value and not value.startswith('"')
                and not value.endswith("\\") and value == value.strip())
    return value if is_plain else '"' + value.replace('"', '""') + '"'


def _typed(entry: Entry) -> Any:
    if not entry.allowed:
        return entry.text
    if entry.allowed.startswith("true or false"):
        return entry.text == "true"
    if entry.allowed.startswith("a whole number"):
        return int(entry.text)
    if entry.allowed.startswith("a number"):
        return float(entry.text)
    if entry.allowed.startswith("three numbers"):
        return tuple(float(word) for word in entry.text.split(","))
    return entry.text


def read_resolved(path: pathlib.Path) -> Record:
    """The case.prm of a run folder as a record of sections with units."""
    values: dict[str, dict[str, Any]] = {}
    units: dict[str, dict[str, str]] = {}
    for entry in read_entries(path):
        values.setdefault(entry.section, {})[entry.key] = _typed(entry)
        units.setdefault(entry.section, {})[entry.key] = entry.unit
    nested: dict[str, Any] = {}
    for section, entries in values.items():
        *outer, name = section.split("/")
        parent = nested
        for one in outer:
            parent = parent.setdefault(one, {})
        parent[name] = Record(entries, units[section], f"{path}: {section}")
    return _nested_record(nested, str(path))


def _nested_record(values: Mapping[str, Any], source: str) -> Record:
    inner = {name: _nested_record(value, source) if isinstance(value, dict)
             else value for name, value in values.items()}
    return Record(inner, {}, source)


def as_text(value: Any) -> str:
    """A value of Python as a case file has it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (tuple, list)):
        return ", ".join(as_text(one) for one in value)
    if isinstance(value, float):
        return repr(value).removesuffix(".0")
    return str(value)


def prm_text(head: str, values: Mapping[str, Any]) -> str:
    """A .prm of values by Section/key, which are grouped by section."""
    sections: dict[str, list[str]] = {}
    for name, value in values.items():
        section, key = name.rsplit("/", 1)
        sections.setdefault(section, []).append(
            f"set {key} = {quoted(as_text(value))}".rstrip())
    lines = [f"# {head}"] if head else []
    for section, entries in sections.items():
        lines.append("")
        names = section.split("/")
        for depth, name in enumerate(names):
            lines.append("  " * depth + f"subsection {name}")
        lines += ["  " * len(names) + entry for entry in entries]
        lines += ["  " * depth + "end" for depth in range(len(names))[::-1]]
    return "\n".join(lines) + "\n"
