#!/usr/bin/env python3
"""Every message of the program stands on the pages of messages of the manual.

    messages.py ROOT     checks the C++ sources of apps, coupling, dem and fem
    messages.py --self   checks that a missing message is caught

A message is what a call of throw, refuse, fail, require or a warning builds
from texts. It stands on a page when a row of a table there has one of its
texts in the first column, as code; `...` stands for what differs. Faults of
the program itself (logic_error) and the Python module are left out.
"""
import pathlib
import re
import sys
import tempfile

FOLDERS = ("apps", "coupling", "dem", "fem")
PAGES = "docs/user/messages_of_*.md"
CALL = re.compile(r"\b(?:throw\s+[\w:]+|refuse\w*|fail|require|RunFailure|"
                  r"InputError|say|warnings\.push_back|deprecated_line)"
                  r"\s*[({]")
TEXT = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
SHORTEST = 8  # letters of a text that tells one message from another
# Programmer errors, and words of commands that are no messages.
ABSENT = re.compile(r"logic_error|usage: spall|overflow_error")


def statement(text, start):
    """From a call to the end of its arguments."""
    depth, k, in_text = 0, start, False
    while k < len(text):
        c = text[k]
        if in_text:
            if c == "\\":
                k += 1
            elif c == '"':
                in_text = False
        elif c == '"':
            in_text = True
        elif c in "({":
            depth += 1
        elif c in ")}":
            depth -= 1
            if depth == 0:
                break
        k += 1
    return text[start:k + 1]


def messages(path):
    """(line, texts) of each message of a source."""
    text = path.read_text(encoding="utf-8")
    last = -1
    for call in CALL.finditer(text):
        if call.start() < last or text[:call.start()].endswith("void "):
            continue
        found = statement(text, call.start())
        if ABSENT.search(found):
            continue
        joined = re.sub(r'(?<!\\)"\s*"', "", found)
        texts = [t for t in TEXT.findall(joined)
                 if len(words_of(t)) >= SHORTEST and " " in t.strip()]
        if texts:
            last = call.start() + len(found)
            yield text.count("\n", 0, call.start()) + 1, texts


def words_of(text):
    """Letters alone: neither quotes, values nor formats matter."""
    text = re.sub(r"%[-+.\d]*[a-z]+", " ", text)
    return " ".join(re.findall(r"[A-Za-z_/]+", text)).lower()


def patterns(root):
    for page in root.glob(PAGES):
        for row in re.findall(r"^\| (`[^|]*`) \|", page.read_text(
                encoding="utf-8"), flags=re.M):
            for code in re.findall(r"`([^`]+)`", row):
                for part in code.split("..."):
                    if len(words_of(part)) >= SHORTEST:
                        yield words_of(part)


def faults(root):
    known = set(patterns(root))
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if "python" in path.relative_to(root).parts:
                continue  # its exceptions are documented with the module
            if path.suffix not in (".h", ".cc"):
                continue
            for line, texts in messages(path):
                if not any(part in words_of(text) or
                           words_of(text) in part
                           for text in texts for part in known):
                    yield (f"{path.relative_to(root)}:{line}: "
                           f"{max(texts, key=len)}")


def self_check():
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        (root / "dem").mkdir()
        (root / "docs/user").mkdir(parents=True)
        (root / "dem/a.cc").write_text(
            'throw std::runtime_error("the mesh " + name + " is not "\n'
            '  "closed at all");\n  refuse(c, "must be round and red");\n')
        (root / "docs/user/messages_of_data.md").write_text(
            "| message | cause |\n|---|---|\n"
            "| `the mesh ... is not closed at all` | holes |\n")
        found = list(faults(root))
    expected = ["dem/a.cc:3: must be round and red"]
    return [] if found == expected else [f"found {found}"]


def main():
    found = self_check() if sys.argv[1] == "--self" else list(
        faults(pathlib.Path(sys.argv[1])))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
