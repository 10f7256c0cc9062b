#!/usr/bin/env python3
"""One thread and two give the same bits.

    threads.py SPALL
"""
import pathlib
import sys
import tempfile

from triaxial_runs import LATERALS, QUICK, differing, report_faults, run


def main():
    spall, faults = str(pathlib.Path(sys.argv[1]).resolve()), []
    with tempfile.TemporaryDirectory() as name:
        for lateral, step in (*((lateral, "fixed") for lateral in LATERALS),
                              ("membrane", "error")):
            folders = [pathlib.Path(name) / f"{lateral}_{step}_{threads}"
                       for threads in (1, 2)]
            for threads, folder in zip((1, 2), folders):
                run(spall, folder, lateral, threads=threads,
                    settings=("Loading/cycles=1", f"Time/step={step}", *QUICK))
            faults += [f"{lateral}, {step}: {path} differs" for path in
                       differing(*folders, ["history.csv", "events.csv",
                                            "ledger.csv"])]
    return report_faults(faults)


if __name__ == "__main__":
    sys.exit(main())
