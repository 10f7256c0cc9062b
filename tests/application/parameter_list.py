#!/usr/bin/env python3
"""The list of parameters as JSON: that of a template and that of a case. The
lines of a check come one by one.

    parameter_list.py SPALL
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from triaxial_runs import CASE, report_faults

KINDS = ("dynamic_triaxial", "single_particle", "los_angeles",
         "vibratory_compaction", "subgrade", "scene")
TYPES = {"number": float, "integer": int, "boolean": bool, "text": str,
         "path": str, "vector": list, "choice": str}


def run(spall, *words):
    return subprocess.run([spall, *map(str, words)], capture_output=True,
                          text=True, check=False)


def entries(printed):
    """Section/key -> entry."""
    return {f"{section['name']}/{one['key']}": one
            for section in printed["sections"]
            for one in section["parameters"]}


def shown(text):
    """Section/key -> text of the value of a printed case without walls."""
    found, section = {}, ""
    for line in text.splitlines():
        if line.startswith("subsection "):
            section = line.split(maxsplit=1)[1]
        elif match := re.match(r"\s+set (\S+) = ?(.*)$", line):
            found[f"{section}/{match[1]}"] = match[2]
    return found


def as_shown(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return ", ".join(map(as_shown, value))
    return value if isinstance(value, str) else f"{value}"


def same(value, text):
    try:
        return float(value) == float(text)
    except (TypeError, ValueError):
        return as_shown(value) == text or \
            [float(one) for one in value] == \
            [float(one) for one in text.split(",")]


def template_faults(spall, kind):
    listed = json.loads(run(spall, "template", kind, "--json").stdout)
    found = {name: one for name, one in entries(listed).items()
             if not name.startswith("Walls/")}
    expected = shown(run(spall, "template", kind).stdout)
    if listed["kind"] != kind or list(found) != list(expected):
        yield f"{kind}: other keys: {set(found) ^ set(expected)}"
    for name, one in found.items():
        if not isinstance(one["value"], TYPES[one["type"]]) and \
                not (one["type"] == "number" and
                     isinstance(one["value"], int)):
            yield f"{kind}: {name}: {one['value']} is no {one['type']}"
        if name != "Material/file" and not same(one["value"], expected[name]):
            yield f"{kind}: {name}: {one['value']}, was {expected[name]}"
        if one["type"] == "choice" and one["value"] not in one["names"]:
            yield f"{kind}: {name}: {one['value']} not in {one['names']}"
    yield from default_faults(kind, found, run(spall, "template", kind).stdout)


def default_faults(kind, found, text):
    """A comment of the template names the default where it shows another."""
    said, section, comment = {}, "", ""
    for line in text.splitlines():
        if line.startswith("subsection "):
            section = line.split(maxsplit=1)[1]
        elif line.startswith("  # "):
            comment += line[3:]
        elif match := re.match(r"\s+set (\S+) =", line):
            default = re.search(r" Default: (\S+)\.$", comment)
            said[f"{section}/{match[1]}"] = default and default[1]
            comment = ""
    for name, one in found.items():
        if one["value"] == one["default"]:
            expected = None
        else:
            expected = as_shown(one["default"]) or "empty"
        if name != "Material/file" and said[name] != expected and \
                not (said[name] and same(one["default"], said[name])):
            yield f"{kind}: {name}: default {said[name]}, must be {expected}"


def range_faults(spall):
    all_of = entries(json.loads(
        run(spall, "template", "dynamic_triaxial", "--json").stdout))
    for name, expected in {
            "Specimen/solid_fraction": (0, True, 0.75, True),
            "Loading/cycles": (1, False, 1e7, False)}.items():
        one = all_of[name]
        limits = (one["lower"], one["is_lower_open"], one["upper"],
                  one["is_upper_open"])
        if limits != expected:
            yield f"{name}: {limits}, was {expected}"
    scene = run(spall, "template", "scene", "--json").stdout
    if "Walls/NAME/velocity" not in entries(json.loads(scene)):
        yield "there are no walls in the list of a scene"


def case_faults(spall):
    """Values of files and overrides, and what is refused."""
    ended = run(spall, "check", CASE, "--json", "--set", "Loading/cycles=3")
    values = entries(json.loads(ended.stdout))
    if values["Loading/cycles"]["value"] != 3:
        yield "the override is not in the list"
    if values["Case/title"]["value"] != "Small dynamic triaxial test":
        yield "the value of the file is not in the list"
    with tempfile.TemporaryDirectory() as name:
        scene = pathlib.Path(name) / "scene.json"
        (pathlib.Path(name) / "one.csv").write_text("x,y,z,radius\n0,0,0,1\n")
        scene.write_text(json.dumps(
            {"Case": {"kind": "scene"}, "Wall": {"friction": 0.25},
             "Scene": {"particles": "one.csv"},
             "Walls": {"lid": {"mesh": "walls/hopper.obj",
                               "velocity": [0, 0, 1]}}}))
        found = entries(json.loads(
            run(spall, "check", scene, "--json").stdout))
        for key, value in (("velocity", [0, 0, 1]), ("friction", 0.25)):
            if found[f"Walls/lid/{key}"]["value"] != value:
                yield f"{key} of the wall is not in the list"
    for words, what in (
            (("check", CASE, "--json", "--set", "Loading/cycles=0"),
             "--set: Loading/cycles = 0: must be"),
            (("template", "triaxial", "--json"), "kind must be one of"),
            (("template", "scene", "--jason"), "--json")):
        ended = run(spall, *words)
        if ended.returncode != 1 or what not in ended.stderr or \
                len(ended.stderr.splitlines()) != 1:
            yield f"{words}: status {ended.returncode}: {ended.stderr}"


def line_faults(spall):
    """A pipe has the first lines of a check while it still runs."""
    with subprocess.Popen([spall, "check", CASE], bufsize=0,
                          stdout=subprocess.PIPE) as running:
        first = running.stdout.read(65536)
        if not first.startswith(b"case") or b"memory" in first:
            yield "check: the first line comes with the last one"
        running.kill()


def main():
    spall = sys.argv[1]
    return report_faults(
        [*(fault for kind in KINDS for fault in template_faults(spall, kind)),
         *range_faults(spall), *case_faults(spall), *line_faults(spall)])


if __name__ == "__main__":
    sys.exit(main())
