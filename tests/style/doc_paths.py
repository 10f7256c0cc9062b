#!/usr/bin/env python3
"""Files of the repository that the docs name must be there.

    doc_paths.py ROOT     checks README.md, docs/ and data/README.md below ROOT
    doc_paths.py --self   checks that a missing file is caught

Looked at are words in backticks and in indented lines that begin with a top
folder. A header may be named as it is included (`dem/engine.h`), a room without
its `src` or `include`; `*` and KIND stand for anything. docs/CHANGELOG.md is
history and is left alone.
"""
import pathlib
import re
import sys
import tempfile

TOP = ("apps", "coupling", "data", "dem", "docs", "fem", "scripts", "tests")
QUOTED = re.compile(r"`([^`\n]+)`")
# What surrounds a path in a command or a sentence.
WORD = re.compile(r"[^\s=,;()'\"]+")


def quoted(line):
    """The parts of a line of Markdown that are code."""
    return [line] if line.startswith("    ") else QUOTED.findall(line)


def paths_in(line):
    for code in quoted(line):
        for word in WORD.findall(code):
            word = re.sub(r"(:\d+)?[.:]*$", "", word)
            if word.startswith(tuple(top + "/" for top in TOP)):
                yield word


def is_there(root, path):
    pattern = re.sub(r"\b[A-Z]{2,}\b", "*", path).strip("/")
    room, rest = pattern.split("/", 1) if "/" in pattern else (pattern, "*")
    return any(any(root.glob(one)) for one in
               (pattern, f"{room}/include/{pattern}", f"{room}/src/{rest}"))


def pages(root):
    found = [root / "README.md", root / "data/README.md"]
    found += [page for page in sorted((root / "docs").rglob("*.md"))
              if page.name != "CHANGELOG.md"]
    return [page for page in found if page.exists()]


def faults(root):
    for page in pages(root):
        lines = page.read_text(encoding="utf-8").splitlines()
        for number, line in enumerate(lines, 1):
            for path in paths_in(line):
                if not is_there(root, path):
                    yield (f"{page.relative_to(root)}:{number}: {path}: "
                           "no such file")


def self_check():
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        (root / "dem/include/dem").mkdir(parents=True)
        (root / "dem/include/dem/engine.h").touch()
        (root / "dem/src").mkdir()
        (root / "dem/src/loop.cc").touch()
        (root / "README.md").write_text(
            "`dem/engine.h`, `dem/loop.cc:3`, `dem/include/dem/*.h`, `a/b`\n"
            "    python3 tests/no.py dem/src\ndem/plain.cc `dem/gone.h`.\n")
        found = list(faults(root))
    expected = ["README.md:2: tests/no.py: no such file",
                "README.md:3: dem/gone.h: no such file"]
    return [] if found == expected else [f"found {found}"]


def main():
    found = self_check() if sys.argv[1] == "--self" else list(
        faults(pathlib.Path(sys.argv[1])))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
