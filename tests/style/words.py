#!/usr/bin/env python3
"""Words that the glossary replaces (docs/developer/glossary.md).

    words.py ROOT     checks identifiers, comments and messages of the C++ and
                      Python sources, cases of data/ and the pages of docs/
    words.py --self   checks that such words are caught

Identifiers count by their parts: add_stone and StoneState both hold `stone`.
A line that reads or lists a deprecated name says so with a pair of old and new
names; these lines are listed below. docs/CHANGELOG.md is history.
"""
import pathlib
import re
import sys
import tempfile

EVERYWHERE = {
    "stone": "particle", "stones": "particles",
    "shelf": "lifter", "shelves": "lifters",
}
# In code alone: ordinary words in a text.
CODE = {
    "seam": "interface adapter", "joint": "coupled body",
    "spot": "contact point", "spots": "contact points",
    "watched": "candidate", "asleep": "inactive", "strayed": "escaped",
    "hasten": "fast preparation", "crowd": "dense packing",
    "knob": "parameter", "polish": "refine",
    "places": "contact points, positions, rows",
}
# In the code of dem alone: words of membranes and of tests elsewhere.
DEM = {
    "slack": "overlap offset", "travel": "path length",
    "travelled": "path length", "sheet": "deforming surface",
    "sheets": "deforming surfaces", "pace": "step control",
    "bend": "shape operator", "sleep": "inactive", "sleeps": "inactive",
    "awake": "active", "swing": "reversal", "swings": "reversals",
    "place": "contact point",
}
# In pages alone.
PHRASES = {
    "anew": "again", "likewise": "the thing itself",
    "what it has come to": "its value", "is told": "is reported",
    "are told": "are reported",
}
PHRASE = re.compile(r"\b(" + "|".join(PHRASES) + r")\b", re.I)
HISTORY = ("docs/CHANGELOG.md", "docs/pictures/",
           "docs/developer/glossary.md", "tests/style/words.py",
           "tests/unit/apps/deprecated_test.cc")
FOLDERS = ("dem", "fem", "coupling", "apps", "tests", "scripts", "data", "docs")
CODE_ENDINGS = (".h", ".cc")
TEXT_ENDINGS = (".py", ".prm", ".md", ".sh")
# Lines that name what is deprecated, and words of the field.
ALLOWED = re.compile(r"deprecated|old_columns|old_names|[Bb]allast stones?\b|"
                     r'\{"[A-Za-z_]+"\}\}|'
                     r'^\s*\{"[a-z_A-Z]+", "[a-z_A-Z]+"\},$|'
                     r"min_ball_radius|Stone/|LLVMFuzzerTestOneInput|"
                     r"place_plane|in place\b|the place of|"
                     r"MPI_IN_PLACE|sleep_for")
PART = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


def words_in(line):
    for identifier in re.findall(r"[A-Za-z_]+", line):
        for part in PART.findall(identifier):
            yield part.lower()


def faults(root):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            name = str(path.relative_to(root))
            if name.startswith(HISTORY) or "__pycache__" in name:
                continue
            if path.suffix in CODE_ENDINGS:
                banned = EVERYWHERE | CODE | (DEM if folder == "dem" else {})
            elif path.suffix in TEXT_ENDINGS:
                banned = EVERYWHERE
            else:
                continue
            for number, line in enumerate(
                    path.read_text(encoding="utf-8").splitlines(), 1):
                if ALLOWED.search(line):
                    continue
                for phrase in PHRASE.findall(line if path.suffix == ".md"
                                             else ""):
                    yield (f"{name}:{number}: {phrase}: "
                           f"use {PHRASES[phrase.lower()]}")
                for word in words_in(line):
                    if word in banned:
                        yield (f"{name}:{number}: {word}: "
                               f"use {banned[word]}")


def self_check():
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        (root / "dem").mkdir()
        (root / "docs").mkdir()
        (root / "dem/a.h").write_text(
            "struct StoneState;\nvoid add_spot();\n// limestone\n"
            'list.add(text, field, "", {"stone_steps"}},\n'
            '            {"stone_steps"}},\n')
        (root / "apps").mkdir()
        (root / "dem/b.cc").write_text(
            "double slack = 0.;\nint one_place;\nplace_plane(); // in place\n")
        (root / "apps/b.cc").write_text(
            "double slack = 0.;\nstruct WallPlaces;\n"
            '// in place of it\n')
        (root / "docs/a.md").write_text(
            "A spot on a stone.\nBallast stones.\nIt is told anew.\n")
        found = list(faults(root))
    expected = ["dem/a.h:1: stone: use particle",
                "dem/a.h:2: spot: use contact point",
                "dem/b.cc:1: slack: use overlap offset",
                "dem/b.cc:2: place: use contact point",
                "apps/b.cc:2: places: use contact points, positions, rows",
                "docs/a.md:1: stone: use particle",
                "docs/a.md:3: is told: use is reported",
                "docs/a.md:3: anew: use again"]
    return [] if found == expected else [f"found {found}"]


def main():
    found = self_check() if sys.argv[1] == "--self" else list(
        faults(pathlib.Path(sys.argv[1])))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
