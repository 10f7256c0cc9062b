#!/usr/bin/env python3
"""Rules of every source file.

    source_rules.py length ROOT    no file above 500 lines
    source_rules.py format ROOT    clang-format changes nothing (77: no
                                   clang-format on this machine)
    source_rules.py listed ROOT    CMake knows every test of tests/unit: one
                                   that is not listed is never built
"""
import pathlib
import re
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


def check_listed(root):
    folder = root / "tests" / "unit"
    listed = (folder / "CMakeLists.txt").read_text()
    # One of two files that the build chooses from.
    listed = re.sub(r"\$<IF:.*?,(\w+),(\w+)>(\w*\.cc)", r"\1\3 \2\3", listed)
    missing = [path for path in sorted(folder.rglob("*_test.cc"))
               if path.name not in re.split(r"[\s/()]+", listed)]
    for path in missing:
        print(f"{path.relative_to(root)}: not in tests/unit/CMakeLists.txt")
    return 1 if missing else 0


if __name__ == "__main__":
    rule = {"length": check_length, "format": check_format,
            "listed": check_listed}[sys.argv[1]]
    sys.exit(rule(pathlib.Path(sys.argv[2]).resolve()))
