#!/usr/bin/env python3
"""docs/parameters/ is what the program writes, in whole sentences.

    parameters_page.py SPALL FOLDER            compares
    parameters_page.py SPALL FOLDER --write    writes the pages again
"""
import pathlib
import re
import subprocess
import sys
import tempfile

LONGEST_SENTENCE = 25  # words


def pages(folder):
    return {path.name: path.read_text() for path in folder.glob("*.md")}


def differences(written, kept):
    for name in sorted(written.keys() | kept.keys()):
        if written.get(name) != kept.get(name):
            yield f"{name} is not up to date"


def sentence_faults(text):
    """Sentences of the last column that are long or no sentences."""
    for line in text.splitlines():
        if not line.startswith("| `"):
            continue
        cells = re.split(r"(?<!\\) \| ", line.strip("| "))
        key, meaning = cells[0], cells[-1]
        if not meaning[0].isupper() or not meaning.endswith("."):
            yield f"{key}: '{meaning}' is no sentence"
        for sentence in re.split(r"(?<=[.])\s+(?=[A-Z])", meaning):
            if len(sentence.split()) > LONGEST_SENTENCE:
                yield f"{key}: '{sentence}' has more than " \
                      f"{LONGEST_SENTENCE} words"


def link_faults(name, text, folder):
    """Files that the links of a page name and that are not there."""
    for target in re.findall(r"\]\(([^)#]+)", text):
        if not (folder / target).is_file():
            yield f"{name}: {target} is not there"


def main():
    folder = pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as name:
        subprocess.run([sys.argv[1], "template", "parameters", "--out", name],
                       check=True)
        written = pages(pathlib.Path(name))
    if "--write" in sys.argv:
        for old in folder.glob("*.md"):
            old.unlink()
        for file, text in written.items():
            (folder / file).write_text(text)
    faults = list(differences(written, pages(folder)))
    if faults:
        faults.append(f"run\n  spall template parameters --out {folder}")
    for file, text in written.items():
        faults += [*sentence_faults(text), *link_faults(file, text, folder)]
    if faults:
        print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
