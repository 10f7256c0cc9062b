#!/usr/bin/env python3
"""What a tutorial promises: its run, and the numbers of its table.

    tutorials.py SPALL PAGE.md

The head of the table says the command, `spall run CASE ...` in backticks; each
row a key of summary.json (a/b: b of a), and the least and the largest value.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from triaxial_runs import report_faults

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEAD = re.compile(r"^\| `spall run ([^`]+)` +\| from \| to \|$", re.M)
ROW = re.compile(r"^\| `([^`]+)` \| (\S+) \| (\S+) \|", re.M)


def value_of(found, key):
    for name in key.split("/"):
        found = found[name]
    return found


def faults_of(spall, page):
    text = page.read_text()
    head = HEAD.search(text)
    if not head:
        return [f"{page.name} has no table of what to expect"]
    promised = ROW.findall(text[head.end():text.index("\n\n", head.end())])
    if not promised:
        return [f"the table of {page.name} has no rows"]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([spall, "run", *head[1].split(), "--out", folder,
                        "--overwrite"], cwd=ROOT, check=True,
                       stdout=subprocess.DEVNULL)
        found = json.loads((pathlib.Path(folder) / "summary.json").read_text())
    return [f"{page.name}: {key} = {value_of(found, key)}: not from {low} "
            f"to {high}" for key, low, high in promised
            if not float(low) <= value_of(found, key) <= float(high)]


if __name__ == "__main__":
    sys.exit(report_faults(faults_of(pathlib.Path(sys.argv[1]).resolve(),
                                     pathlib.Path(sys.argv[2]))))
