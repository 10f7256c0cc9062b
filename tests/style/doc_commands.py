#!/usr/bin/env python3
"""Commands in the code blocks of the docs can be typed as they stand.

    doc_commands.py ROOT [PATH ...]   checks docs/, README.md, CONTRIBUTING.md
                                      and data/README.md, or these paths alone
    doc_commands.py --self            checks that faults are caught

Looked at are blocks of console, bash and sh: in console the lines after `$ `
if there are any. A command `spall` must have a known subcommand and options,
files that exist or that the page names before, and keys of docs/parameters with
an allowed value. Scripts must exist, and be executable where they are called by
their path. Words in capitals and <words> stand for
something. A line `<!-- not run -->` before a block excepts it; one with a
reason, `<!-- not run: takes an hour -->`, does not.
"""
import os
import pathlib
import re
import shlex
import sys
import tempfile

BLOCK = re.compile(r"^( *)```(console|bash|sh)\n(.*?)^\1```", re.M | re.S)
EXCEPTED = "<!-- not run -->"
PLACEHOLDER = re.compile(r"^[A-Z][A-Z_/.]*(\.prm)?$|^<.*>$|^\$")
PROGRAM = re.compile(r"(^|/)spall$")
PREFIX = re.compile(r"^(\w+=.*|mpirun|srun|nice|nohup|time|env|taskset)$")
FILE = re.compile(r".\.(prm|json|csv|stl|obj|ply|msh)$")
ROW = re.compile(r"^\| `(\w+)` \| [^|]* \| [^|]* \| ([^|]*) \|", re.M)
STUDY = ("Study", "Base", "Sweep", "Expect", "Variants")


def program(root):
    """Options of each command, as apps/program/program.cc prints them."""
    text = (root / "apps/program/program.cc").read_text(encoding="utf-8")
    table = text[text.index(" commands = {"):text.index("std::string usage")]
    found = {}
    for entry in re.split(r"\{(?=\")", table)[1:]:
        name = re.match(r'"(\w+)"', entry)[1]
        found[name] = set(re.findall(r"--[a-z-]+", entry))
    return found


def parameters(root):
    """Allowed values of each Section/key."""
    text = "\n".join(page.read_text(encoding="utf-8") for page in
                     sorted((root / "docs/parameters").glob("*.md")))
    found = {}
    for section in re.split(r"^## ", text, flags=re.M)[1:]:
        name = section.split("\n", 1)[0].split("/")[0].strip()
        for key, allowed in ROW.findall(section):
            found[name, key] = allowed
    return found


class Page:
    """A page with what its commands may use."""

    def __init__(self, root, path, options, keys):
        self.root, self.path = root, path
        self.options, self.keys = options, keys
        self.text = path.read_text(encoding="utf-8")

    def faults(self):
        for block in BLOCK.finditer(self.text):
            before = self.text[:block.start()]
            if before.rstrip().endswith(EXCEPTED):
                continue
            line = before.count("\n") + 2
            for number, command in commands(block[3], block[2]):
                for fault in self.command_faults(command, block.start()):
                    yield f"{line + number}: {fault}"

    def command_faults(self, command, start):
        try:
            words = shlex.split(command, comments=True)
        except ValueError as error:
            yield f"{command}: {error}"
            return
        for word in words:
            if (re.match(r"(scripts|tests)/", word)
                    and not (self.root / word).exists()):
                yield f"{word}: no such file"
        if (words and re.match(r"(scripts|tests)/", words[0])
                and (self.root / words[0]).exists()
                and not os.access(self.root / words[0], os.X_OK)):
            yield f"{words[0]}: is not executable"
        at = 0
        if words and PREFIX.match(words[0]):
            at = next((i for i, word in enumerate(words)
                       if PROGRAM.search(word)), len(words))
        if at + 1 < len(words) and PROGRAM.search(words[at]):
            yield from self.spall_faults(words[at + 1:], start)

    def spall_faults(self, words, start):
        name, words = words[0], words[1:]
        if name in ("--version", "--help") or PLACEHOLDER.match(name):
            return
        if name not in self.options:
            yield f"spall {name}: no such command"
            return
        for i, word in enumerate(words):
            before = words[i - 1] if i else ""
            if word in (">", "|", "&", "&&", "2>&1", ";"):
                break
            if before == "--set" or word.startswith("--set="):
                yield from self.setting_faults(word.removeprefix("--set="))
            elif word.startswith("--"):
                if word.split("=")[0] not in self.options[name] | {"--help"}:
                    yield f"{word}: no option of spall {name}"
            elif FILE.search(word) and not before.startswith("--"):
                if not self.is_known_file(word, start):
                    yield f"{word}: no such file"
        if name == "template" and not self.is_kind(words[0] if words else ""):
            yield f"spall template {' '.join(words[:1])}: no such kind"

    def is_known_file(self, name, start):
        if PLACEHOLDER.match(name) or "*" in name or name.startswith("runs/"):
            return True
        if name.startswith(("~", "/")):  # an installation, or another folder
            _, is_data, inside = name.rpartition("/data/")
            return not is_data or (self.root / "data" / inside).exists()
        return ((self.root / name).exists()
                or (self.root / "data" / name).exists()
                or re.search(r"(^|[\s`/>])" + re.escape(name),
                             self.text[:start]) is not None
                or any("> " + name in block[3] or "cp " in block[3]
                       for block in BLOCK.finditer(self.text)
                       if block.start() == start))

    def is_kind(self, name):
        allowed = self.keys.get(("Case", "kind"), "")
        return (name == "parameters" or PLACEHOLDER.match(name)
                or re.search(rf"\b{re.escape(name)}\b", allowed) is not None)

    def setting_faults(self, setting):
        name, _, value = setting.partition("=")
        if name == "preset":
            if not any((self.root / "data/presets").glob(f"*/{value}.prm")):
                yield f"{setting}: no such preset"
            return
        section, _, key = name.partition("/")
        key = key.split("/")[-1]
        if section in STUDY or PLACEHOLDER.match(name):
            return
        allowed = self.keys.get((section, key))
        if allowed is None:
            yield f"{name}: no such key"
        elif allowed.startswith("one of "):
            if value not in allowed.removeprefix("one of ").split(", "):
                yield f"{setting}: must be {allowed}"


def commands(block, language):
    """Line number in the block and command; lines end with a backslash."""
    has_prompts = language == "console" and re.search(r"^\s*\$ ", block, re.M)
    lines = block.split("\n")
    i = 0
    while i < len(lines):
        first, line = i, lines[i].strip()
        while line.endswith("\\") and i + 1 < len(lines):
            i += 1
            line = line[:-1] + " " + lines[i].strip()
        i += 1
        if has_prompts and not line.startswith("$ "):
            continue
        line = line.removeprefix("$ ")
        if line and not line.startswith("#"):
            yield first, line


def pages(root, paths):
    for path in paths or ("docs", "README.md", "CONTRIBUTING.md",
                          "data/README.md"):
        full = root / path
        if full.is_dir():
            yield from sorted(full.rglob("*.md"))
        elif full.exists():
            yield full


def faults(root, paths=()):
    options, keys = program(root), parameters(root)
    for path in pages(root, paths):
        for fault in Page(root, path, options, keys).faults():
            yield f"{path.relative_to(root)}:{fault}"


def self_check():
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        for folder in ("apps/program", "docs/parameters", "data/presets/scene",
                       "scripts"):
            (root / folder).mkdir(parents=True)
        (root / "data/presets/scene/fast.prm").touch()
        (root / "data/a.prm").touch()
        (root / "scripts/text.sh").touch(0o644)
        (root / "scripts/program.sh").touch(0o755)
        (root / "apps/program/program.cc").write_text(
            '> commands = {\n {{"template", "KIND", "print"},\n'
            '{"run",\n "CASE [--out DIR] [--set S/key=value ...]", "run"}}};\n'
            "std::string usage()\n")
        (root / "docs/parameters/index.md").write_text(
            "## Case\n\n| `kind` | - | scene | one of scene, drum | Kind. |\n\n"
            "## Time\n\n| `step` | - | fixed | one of fixed, stable | Rule. |\n"
            "| `safety` | - | 0.1 | a number | Share. |\n")
        (root / "docs/a.md").write_text(
            "# A\n\n```console\n$ spall run data/a.prm --set preset=fast \\\n"
            "    --set Time/safety=0.2 --out runs/a\nspall no output\n```\n\n"
            "```bash\nspall template drum > mine.prm\nspall run mine.prm\n"
            "spall run gone.prm --hurry --set Time/step=long\n"
            "mpirun -n 2 build/apps/spall walk CASE.prm\n"
            "spall template dream\nspall run CASE.prm --set Time/no=1\n"
            "scripts/gone.sh --set preset=none\n"
            "python3 a.py build/apps/spall --any\n"
            "spall run ~/share/data/a.prm\nspall run /opt/data/b.prm\n"
            "bash scripts/text.sh\nscripts/program.sh\n"
            "scripts/text.sh\n```\n\n"
            "<!-- not run -->\n```bash\nspall dance\n```\n")
        found = list(faults(root))
    expected = ["docs/a.md:12: gone.prm: no such file",
                "docs/a.md:12: --hurry: no option of spall run",
                "docs/a.md:12: Time/step=long: must be one of fixed, stable",
                "docs/a.md:13: spall walk: no such command",
                "docs/a.md:14: spall template dream: no such kind",
                "docs/a.md:15: Time/no: no such key",
                "docs/a.md:16: scripts/gone.sh: no such file",
                "docs/a.md:19: /opt/data/b.prm: no such file",
                "docs/a.md:22: scripts/text.sh: is not executable"]
    return [] if found == expected else [f"found {found}"]


def main():
    found = self_check() if sys.argv[1] == "--self" else list(
        faults(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
