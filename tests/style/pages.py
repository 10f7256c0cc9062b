#!/usr/bin/env python3
"""Pages of the manual: lengths, links, anchors, pictures, tables of contents.

    pages.py ROOT [PATH ...]   checks docs/, README.md, CONTRIBUTING.md and
                               data/README.md below ROOT, or these paths alone
    pages.py --self            checks that faults are caught

A line has at most 120 characters, a paragraph or an entry of a list at most
six lines, a page at most 2500 words; tables, code, display maths and the
generated docs/parameters do not count. A link leads to a file, its anchor to a
heading of it. Every page of docs is in the table of contents of another one.
"""
import pathlib
import re
import sys
import tempfile

LINE, PARAGRAPH, WORDS = 120, 6, 2500
FENCE = re.compile(r"^\s*(`{3,}|~{3,})\s*(\S*)")
TEXT_FENCES = ("{note}", "{tip}", "{warning}", "{important}", "{admonition}")
ITEM = re.compile(r"^\s*([-*+]|\d+\.) ")
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
HEADING = re.compile(r"^(#{1,6}) +(.*?) *#*$")
LABEL = re.compile(r"^\(([\w-]+)\)=$")
CODE = re.compile(r"(`+)(.+?)\1")


def kinds_of_lines(lines):
    """Each line with what it is: text, code, math, table, heading, blank."""
    fences = []
    in_math = False
    for line in lines:
        fence = FENCE.match(line)
        if fence and fences and line.strip() == fences[-1][0]:
            fences.pop()
            yield "blank", line
        elif fence and not (fences and fences[-1][1] == "code"):
            is_text = fence[2].startswith(TEXT_FENCES)
            fences.append((fence[1], "text" if is_text else "code"))
            yield "blank", line
        elif fences and fences[-1][1] == "code":
            yield "code", line
        elif in_math or line.strip().startswith("$$"):
            if line.count("$$") == 1:
                in_math = not in_math
            yield "math", line
        elif not line.strip():
            yield "blank", line
        elif line.lstrip().startswith("|"):
            yield "table", line
        elif HEADING.match(line):
            yield "heading", line
        elif LABEL.match(line) or line.startswith("<!--"):
            yield "blank", line
        else:
            yield "text", line


def length_faults(lines):
    n_lines = n_words = 0
    for number, (kind, line) in enumerate(kinds_of_lines(lines), 1):
        if kind in ("text", "heading"):
            n_words += len(line.split())
            if len(line) > LINE:
                yield f"{number}: a line of {len(line)} characters"
        starts = kind != "text" or ITEM.match(line)
        n_lines = int(kind == "text") if starts else n_lines + 1
        if n_lines == PARAGRAPH + 1:
            yield f"{number}: a paragraph of more than {PARAGRAPH} lines"
    if n_words > WORDS:
        yield f"1: {n_words} words"


def anchor_of(heading):
    """As Sphinx with MyST makes it: formulas do not count."""
    plain = re.sub(r"\$[^$]*\$", "", LINK.sub("]", heading))
    plain = re.sub(r"[*`\[\]]", "", plain).strip().lower().replace(" ", "-")
    return re.sub(r"[^\w\-]", "", plain)


def anchors_of(page):
    found = set()
    for kind, line in kinds_of_lines(
            page.read_text(encoding="utf-8").splitlines()):
        label = LABEL.match(line)
        if label:
            found.add(label[1])
        if kind == "heading":
            anchor = anchor_of(HEADING.match(line)[2])
            n_same = 0
            while (name := f"{anchor}-{n_same}" if n_same else anchor) in found:
                n_same += 1
            found.add(name)
    return found


def links_of(lines):
    """Line number and target; a link may go on in the next line."""
    text = "\n".join("" if kind in ("code", "math") else
                     CODE.sub(lambda code: "`" * len(code[0]), line)
                     for kind, line in kinds_of_lines(lines))
    for link in LINK.finditer(text):
        yield text.count("\n", 0, link.end()) + 1, link[1]


def link_faults(page, lines):
    for number, target in links_of(lines):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        aim = (page.parent / path).resolve() if path else page
        if not aim.exists():
            yield f"{number}: {target}: no such file"
        elif anchor and aim.suffix == ".md" and anchor not in anchors_of(aim):
            yield f"{number}: {target}: no such heading"


def listed_pages(page, lines):
    """Line number and page of each entry of a table of contents."""
    is_listing = False
    for number, line in enumerate(lines, 1):
        if line.strip().startswith("```"):
            is_listing = line.strip() == "```{toctree}"
        elif is_listing and line.strip() and not line.startswith(":"):
            entry = re.sub(r"^.*<(.*)>$", r"\1", line.strip())
            if any(c in entry for c in "*?["):
                for one in sorted(page.parent.glob(entry + ".md")):
                    yield number, one
            else:
                yield number, page.parent / (entry + ".md")


def contents_faults(root):
    """Pages that no table of contents names, and entries without a page."""
    listed = {root / "docs/index.md"}
    for page in sorted((root / "docs").rglob("*.md")):
        lines = page.read_text(encoding="utf-8").splitlines()
        for number, entry in listed_pages(page, lines):
            entry = pathlib.Path(entry).resolve()
            listed.add(entry)
            if not entry.exists():
                yield (f"{page.relative_to(root)}:{number}: "
                       f"{entry.relative_to(root)}: no such page")
    for page in sorted((root / "docs").rglob("*.md")):
        if page not in listed:
            yield (f"{page.relative_to(root)}:1: in no table of contents")


def pages(root, paths):
    for path in paths or ("docs", "README.md", "CONTRIBUTING.md",
                          "data/README.md"):
        full = root / path
        if full.is_dir():
            yield from sorted(full.rglob("*.md"))
        elif full.exists():
            yield full


def faults(root, paths=()):
    for page in pages(root, paths):
        lines = page.read_text(encoding="utf-8").splitlines()
        found = list(link_faults(page, lines))
        if "parameters" not in page.parts:
            found += length_faults(lines)
        for fault in found:
            yield f"{page.relative_to(root)}:{fault}"
    if not paths:
        yield from contents_faults(root)


def self_check():
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name).resolve()
        (root / "docs").mkdir()
        (root / "docs/index.md").write_text(
            "# A\n\n```{toctree}\na\ngone\n```\n")
        (root / "docs/a.md").write_text(
            "# Two words `of` $x$ it\n\n[a](#two-words-of--it) [b](#two)\n"
            "[c](b.md#b) [d](no.md) `[e](no.md)` ![f](p.svg) [g\n"
            "h](index.md#a)\n\n"
            + "| " + "x" * 130 + " |\n\n" + "y" * 121 + "\n\n"
            + "```\n" + "z\n" * 9 + "```\n" + "- t\n" * 8 + "u\n" * 6
            + "\n```{note}\n" + "v\n" * 7 + "```\n")
        (root / "docs/b.md").write_text("# B\n\n" + "w " * 20 + "\n")
        (root / "README.md").write_text(("w " * 50 + "\n\n") * 51)
        found = list(faults(root))
    expected = ["docs/a.md:3: #two: no such heading",
                "docs/a.md:4: no.md: no such file",
                "docs/a.md:4: p.svg: no such file",
                "docs/a.md:9: a line of 121 characters",
                "docs/a.md:35: a paragraph of more than 6 lines",
                "docs/a.md:44: a paragraph of more than 6 lines",
                "README.md:1: 2550 words",
                "docs/index.md:5: docs/gone.md: no such page",
                "docs/b.md:1: in no table of contents"]
    return [] if found == expected else [f"found {found}"]


def main():
    found = self_check() if sys.argv[1] == "--self" else list(
        faults(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
