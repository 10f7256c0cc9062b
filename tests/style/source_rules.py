#!/usr/bin/env python3
"""Rules of every source file.

    source_rules.py length ROOT    no file above 500 lines
    source_rules.py format ROOT    clang-format changes nothing (77: no
                                   clang-format on this machine)
"""
import pathlib
import shutil
import subprocess
import sys

FOLDERS = ("dem", "fem", "coupling", "apps", "tests", "scripts")
LONGEST = 500


def sources(root, endings):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in endings:
                yield path


def check_length(root):
    n_faults = 0
    for path in sources(root, (".h", ".cc", ".py", ".sh", ".cmake", ".txt")):
        n_lines = len(path.read_text().splitlines())
        if n_lines > LONGEST:
            print(f"{path.relative_to(root)}: {n_lines} lines, "
                  f"{LONGEST} are allowed")
            n_faults += 1
    return 1 if n_faults else 0


def check_format(root):
    program = shutil.which("clang-format")
    if not program:
        print("no clang-format on this machine: skipped")
        return 77
    paths = [str(path) for path in sources(root, (".h", ".cc"))]
    return subprocess.run([program, "--dry-run", "--Werror", *paths],
                          check=False).returncode


if __name__ == "__main__":
    rule = {"length": check_length, "format": check_format}[sys.argv[1]]
    sys.exit(rule(pathlib.Path(sys.argv[2]).resolve()))
