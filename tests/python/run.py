#!/usr/bin/env python3
"""Tests of the Python package.

    run.py SPALL MODULE ...    the modules test_MODULE.py with this program

Exit status 77, skipped, without numpy.
"""
import os
import pathlib
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent


def main():
    try:
        import numpy  # noqa: F401
    except ImportError:
        print("no numpy for this Python: skipped (apt install python3-numpy)")
        return 77
    os.environ["SPALL"] = str(pathlib.Path(sys.argv[1]).resolve())
    os.environ["OMP_WAIT_POLICY"] = "passive"
    os.environ.setdefault("MPLBACKEND", "agg")
    sys.path[:0] = [str(HERE), str(HERE.parents[1] / "apps" / "python")]
    names = [f"test_{name}" for name in sys.argv[2:]]
    found = unittest.defaultTestLoader.loadTestsFromNames(names)
    ended = unittest.TextTestRunner(verbosity=2).run(found)
    return 0 if ended.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
