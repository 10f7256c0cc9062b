#!/usr/bin/env python3
"""Completions and man page know every command and option of the program, and
name no other.

    completion.py SPALL
"""
import pathlib
import re
import subprocess
import sys

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "completion"


def commands_of(spall):
    """Options by command, from the help of the program."""
    text = subprocess.run([spall, "--help"], capture_output=True, text=True,
                          check=True).stdout
    options = {}
    for line in text.splitlines():
        if found := re.match(r"  spall (\w+) (.*)", line):
            command = found.group(1)
            options[command] = set(re.findall(r"--[a-z-]+", found.group(2)))
    return options


def kinds_of(spall):
    """What the template command takes, from its message."""
    ended = subprocess.run([spall, "template"], capture_output=True, text=True,
                           check=False)
    return set(re.search(r"one of ([a-z_, ]+), which",
                         ended.stderr).group(1).split(", ")) | {"parameters"}


def main():
    spall = sys.argv[1]
    commands, kinds = commands_of(spall), kinds_of(spall)
    known = {"--version", "--help"}.union(*commands.values())
    faults = []
    for name in ("spall.bash", "_spall", "spall.1"):
        text = (FOLDER / name).read_text().replace("\\-", "-")
        for word in [*commands, *known, *kinds]:
            if not re.search(rf"(?<![\w-]){word}(?![\w-])", text):
                faults.append(f"{name}: {word} is missing")
        for word in re.findall(r"(?<![\w-])--[a-z][a-z-]+", text):
            if word not in known:
                faults.append(f"{name}: {word} is no option")
    checked = subprocess.run(["bash", "-n", FOLDER / "spall.bash"], check=False)
    if checked.returncode != 0:
        faults.append("spall.bash: is no bash")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
