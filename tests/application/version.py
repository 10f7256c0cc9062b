#!/usr/bin/env python3
"""spall --version: version of the project, commit of the sources, libraries; the
same version in CITATION.cff, and a section of it in the changelog.

    version.py SPALL VERSION SOURCE HDF5

HDF5 is 1 where the program is built with it, else 0.
"""
import pathlib
import re
import subprocess
import sys
from shutil import which

from triaxial_runs import report_faults

LIBRARIES = ("deal.II", "Trilinos", "VTK", "Eigen", "MPI", "compiler")
NUMBER = re.compile(r"\d+\.\d+")


def commits_of(source):
    """Commits that the program may name: any that the sources had."""
    if not (pathlib.Path(source) / ".git").exists() or not which("git"):
        return {"unknown"}
    listed = subprocess.run(["git", "-C", source, "rev-list", "--all", "HEAD"],
                            capture_output=True, text=True, check=False)
    return set(listed.stdout.split()) or {"unknown"}


def written_faults(version, source):
    """Where else the version stands."""
    citation = (source / "CITATION.cff").read_text(encoding="utf-8")
    if f"\nversion: {version}\n" not in citation:
        yield f"CITATION.cff has another version than {version}"
    changelog = (source / "docs/CHANGELOG.md").read_text(encoding="utf-8")
    if f"\n## {version} - " not in changelog:
        yield f"docs/CHANGELOG.md has no section {version}"


def faults(spall, version, source, has_hdf5):
    printed = subprocess.run([spall, "--version"], capture_output=True,
                             text=True, check=True).stdout
    lines = printed.splitlines()
    if lines[0] != f"spall {version}":
        yield f"first line {lines[0]!r}, not spall {version}"
    commits = [line.split()[1] for line in lines
               if line.startswith("commit ")]
    if len(commits) != 1 or commits[0] not in commits_of(source):
        yield f"commits {commits}"
    for library in (*LIBRARIES, "HDF5"):
        found = [line for line in lines if line.startswith(library + " ")]
        expected = int(library != "HDF5" or has_hdf5 == "1")
        if len(found) != expected or not all(map(NUMBER.search, found)):
            yield f"{library}: {found}"
    yield from written_faults(version, pathlib.Path(source))


if __name__ == "__main__":
    sys.exit(report_faults(list(faults(*sys.argv[1:5]))))
