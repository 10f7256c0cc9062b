#!/usr/bin/env python3
"""What the manual promises: its commands, and the numbers of its tables.

    manual.py SPALL PAGE.md            runs the commands of a page and compares
                                       its tables
    manual.py FORKED_PROGRAM --not-run FOLDER
                                       checks the cases of the commands that are
                                       marked as not run, on all pages

A command stands in a block ```sh. `<!-- not run: WHY -->` before it marks one
that no test runs. The blocks of a page run one after the other in a folder that
has the program as build/apps/spall, and data/.

The head of a table has the command in backticks; each row the least and the
largest value. Of `spall run CASE ...` a row names a key of summary.json (a/b: b
of a), of `spall study STUDY ...` a column of study.csv: its mean over the cases
in which other columns have given values (column=value, blanks between).
"""
import csv
import json
import os
import pathlib
import re
import shlex
import statistics
import subprocess
import sys
import tempfile

from forked import ForkedProgram
from triaxial_runs import report_faults

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:^ *<!-- not run: (?P<why>[^\n]+) -->\n)?"
                   r"^(?P<indent> *)```sh\n(?P<lines>.*?)^ *```$", re.M | re.S)
HEAD = re.compile(r"^\| `spall (run|study) ([^`]+)` +\| from \| to \|$", re.M)
ROW = re.compile(r"^\| `([^`]+)`(?: with `([^`]+)`)? \| (\S+) \| (\S+) \|",
                 re.M)
PROGRAM = "build/apps/spall"
FOLDERS = ("--figures", "--preparations")


class Run:
    """summary.json of a run."""

    def __init__(self, folder):
        self.summary = json.loads((folder / "summary.json").read_text())

    def value(self, key, _):
        found = self.summary
        for name in key.split("/"):
            found = found[name]
        return found


class Study:
    """study.csv of a study."""

    def __init__(self, folder):
        with open(folder / "study.csv", newline="", encoding="utf-8") as file:
            self.cases = list(csv.DictReader(file))

    def value(self, key, conditions):
        wanted = dict(pair.split("=") for pair in conditions.split())
        return statistics.mean(
            float(case[key]) for case in self.cases
            if all(float(case[name]) == float(value)
                   for name, value in wanted.items()))


def blocks(text):
    """(lines, why it is not run or None) of each block of commands."""
    for block in BLOCK.finditer(text):
        indent = len(block["indent"])
        yield ("".join(line[indent:] if line.strip() else "\n" for line in
                       block["lines"].splitlines(keepends=True)), block["why"])


def make_sandbox(spall, folder):
    (folder / PROGRAM).parent.mkdir(parents=True)
    (folder / PROGRAM).symlink_to(spall)
    for name in ("data", "CMakeLists.txt", "CMakePresets.json"):
        (folder / name).symlink_to(ROOT / name)


def commands_of(lines):
    """Words of each command of the program, options behind a \\ included."""
    for line in lines.replace("\\\n", " ").splitlines():
        if line.strip().startswith(PROGRAM + " "):
            yield shlex.split(line, comments=True)[1:]


def without_folders(words):
    """A command without options that leave its results as they are."""
    return [word for k, word in enumerate(words)
            if word not in FOLDERS and (k == 0 or words[k - 1] not in FOLDERS)]


def page_faults(spall, page):
    text = page.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_sandbox(spall, folder)
        ran = []
        for lines, why in blocks(text):
            if why:
                continue
            found = subprocess.run(
                ["bash", "-euo", "pipefail", "-c", lines], cwd=folder,
                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                check=False)
            if found.returncode:
                return [f"{page.name}: {lines.strip()}: {found.stderr.strip()}"]
            ran += [without_folders(words) for words in commands_of(lines)]
        return [fault for head in HEAD.finditer(text)
                for fault in table_faults(spall, page, text, head, folder, ran)]


def table_faults(spall, page, text, head, sandbox, ran):
    promised = ROW.findall(text[head.end():text.index("\n\n", head.end())])
    if not promised:
        return [f"a table of {page.name} has no rows"]
    words = shlex.split(head[2])
    folder = sandbox / "runs" / pathlib.Path(words[0]).stem
    if [head[1], *words] not in ran:
        folder = sandbox / "of_table"
        subprocess.run([spall, head[1], *words, "--out", folder,
                        *(["--overwrite"] if head[1] == "run" else [])],
                       cwd=sandbox, check=True, stdout=subprocess.DEVNULL)
    found = {"run": Run, "study": Study}[head[1]](folder)
    return [f"{page.name}: {key} {conditions} = {found.value(key, conditions)}:"
            f" not from {low} to {high}"
            for key, conditions, low, high in promised
            if not float(low) <= found.value(key, conditions) <= float(high)]


def check_faults(program, page, words, folder):
    """Whether the program takes the case, without building it."""
    case, *options = words
    given = [word for k, word in enumerate(options)
             if word == "--set" or k and options[k - 1] == "--set"]
    if not (ROOT / case).exists():
        if case.startswith("data/"):
            return [f"{page.name}: {case}: no such file"]
        return []
    found = program.run(["check", case, *given, "--json"], folder)
    return [f"{page.name}: {found.stderr.strip()}"] if found.returncode else []


def not_run_faults(path, folder):
    """Faults of the cases of commands that are marked as not run."""
    faults = []
    with tempfile.TemporaryDirectory() as name, ForkedProgram(path) as program:
        sandbox = pathlib.Path(name)
        make_sandbox(path, sandbox)
        for page in sorted(folder.rglob("*.md")):
            for lines, why in blocks(page.read_text(encoding="utf-8")):
                for command, *words in commands_of(lines) if why else ():
                    if command in ("run", "check") and "$" not in str(words):
                        faults += check_faults(program, page, words, sandbox)
                    elif command == "study" and words[0].startswith("data/"):
                        faults += [] if (ROOT / words[0]).exists() else [
                            f"{page.name}: {words[0]}: no such file"]
    return faults


def main():
    # Absolute, as commands run in other folders.
    spall = pathlib.Path(os.path.abspath(sys.argv[1]))
    if sys.argv[2] == "--not-run":
        return not_run_faults(spall, pathlib.Path(sys.argv[3]))
    return page_faults(spall, pathlib.Path(sys.argv[2]))


if __name__ == "__main__":
    sys.exit(report_faults(main()))
