#!/usr/bin/env python3
"""Wide instructions stay in their unit.

    wide_symbols.py NM OBJECT [OBJECT ...]

A function that several units define is linked from one of them. A unit that is
compiled for a wider instruction set must not offer one, or a processor without
it would run it. Only functions whose name carries the width of their lanes may
be weak.
"""
import subprocess
import sys


def faults(tool, path):
    symbols = subprocess.run([tool, path], capture_output=True, text=True,
                             check=True).stdout
    found = []
    for line in symbols.splitlines():
        kind, name = line.split()[-2:]
        # Weak functions and objects; a reference to the exception tables is
        # data.
        if kind in "WVu" and "simd_abi" not in name \
                and not name.startswith("DW.ref."):
            found.append(f"{path}: {name} may be linked elsewhere")
    return found


all_faults = [fault for path in sys.argv[2:]
              for fault in faults(sys.argv[1], path)]
print("\n".join(all_faults + [f"{len(sys.argv) - 2} objects, "
                              f"{len(all_faults)} faults"]))
sys.exit(1 if all_faults else 0)
