#!/usr/bin/env python3
"""A run that a guard stops leaves one line, status 2 and the state of that
moment; with a wider limit it goes on from there as if it had not stopped. A
membrane that is far too soft folds between the stones, and that stops it too.

    guards.py SPALL
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

from triaxial_runs import ENVIRONMENT, command, differing, report_faults, run

SHORT = ("Loading/frequency=2000", "Loading/cycles=1",
         "Loading/consolidation_time=1e-3")
# One pass loses some work: a limit that it comes to after a hundred windows.
SETTINGS = (*SHORT, "Coupling/exchange=one_pass")
SOFT = ("Loading/frequency=500", "Membrane/youngs_modulus=3e4")


def stopped_run(spall, folder, settings, words):
    """Faults of a run that a guard stops with these words."""
    ended = subprocess.run(
        command(spall, folder, "membrane", settings=settings),
        capture_output=True, text=True, timeout=300, check=False,
        env=ENVIRONMENT)
    state = folder / "checkpoint" / "stopped.bin"
    lines = ended.stderr.splitlines()
    faults = []
    if ended.returncode != 2 or len(lines) != 1:
        faults.append(f"status {ended.returncode}: {ended.stderr}")
    for part in (words, str(state), "last one before: none"):
        if part not in ended.stderr:
            faults.append(f"'{part}' is not in: {ended.stderr}")
    if not state.exists():
        faults.append(f"no {state}")
    return faults


def main():
    spall = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        faults = stopped_run(
            spall, root / "stopped",
            (*SETTINGS, "Coupling/ledger_limit=1e-9"), "Coupling/ledger_limit")
        faults += stopped_run(spall, root / "soft", SOFT,
                              "in the surface 'membrane' facets")
        if faults:
            return report_faults(faults)
        wide = (*SETTINGS, "Coupling/ledger_limit=1")
        checkpoint = root / "stopped" / "checkpoint"
        shutil.move(checkpoint / "stopped.bin", checkpoint / "state.bin")
        run(spall, root / "stopped", "membrane", "--resume", settings=wide)
        run(spall, root / "whole", "membrane", settings=wide)
        return report_faults(
            f"{path} differs"
            for path in differing(root / "stopped", root / "whole",
                                  ["history.csv", "events.csv", "ledger.csv"]))


if __name__ == "__main__":
    sys.exit(main())
