#!/usr/bin/env python3
"""What a tutorial promises: its runs, and the numbers of their tables.

    tutorials.py SPALL PAGE.md

The head of a table says the command in backticks; each row the least and the
largest value. Of `spall run CASE ...` a row names a key of summary.json (a/b: b
of a), of `spall study STUDY ...` a column of study.csv: its mean over the cases
in which other columns have given values (column=value, blanks between).
"""
import csv
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

from triaxial_runs import report_faults

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEAD = re.compile(r"^\| `spall (run|study) ([^`]+)` +\| from \| to \|$", re.M)
ROW = re.compile(r"^\| `([^`]+)`(?: with `([^`]+)`)? \| (\S+) \| (\S+) \|",
                 re.M)


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


def faults_of(spall, page):
    text = page.read_text()
    tables = list(HEAD.finditer(text))
    if not tables:
        return [f"{page.name} has no table of what to expect"]
    return [fault for head in tables
            for fault in table_faults(spall, page, text, head)]


def table_faults(spall, page, text, head):
    promised = ROW.findall(text[head.end():text.index("\n\n", head.end())])
    if not promised:
        return [f"a table of {page.name} has no rows"]
    with tempfile.TemporaryDirectory() as folder:
        options = ["--overwrite"] if head[1] == "run" else []
        subprocess.run([spall, head[1], *head[2].split(), "--out", folder,
                        *options], cwd=ROOT, check=True,
                       stdout=subprocess.DEVNULL)
        found = {"run": Run, "study": Study}[head[1]](pathlib.Path(folder))
    return [f"{page.name}: {key} {conditions} = {found.value(key, conditions)}:"
            f" not from {low} to {high}"
            for key, conditions, low, high in promised
            if not float(low) <= found.value(key, conditions) <= float(high)]


if __name__ == "__main__":
    sys.exit(report_faults(faults_of(pathlib.Path(sys.argv[1]).resolve(),
                                     pathlib.Path(sys.argv[2]))))
