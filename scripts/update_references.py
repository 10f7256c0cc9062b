#!/usr/bin/env python3
"""Writes the references of the application tests anew.

    scripts/update_references.py [SPALL]     SPALL: build/apps/spall

The commit that does this says why the numbers changed.
"""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def main():
    spall = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/apps/spall"
    tests = ROOT / "tests" / "application"
    return subprocess.run([sys.executable, "-B", tests / "triaxial.py",
                           str(spall), "--write"], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
