#!/usr/bin/env python3
"""A run that a guard stops leaves one line, status 2 and the state of that
moment; with a wider limit it goes on from there as if it had not stopped. A
membrane that is far too soft folds between the particles, and that stops it too.

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
# One pass loses some work: a limit that it comes to after a hundred windows,
# and at once where a run goes on with it.
SETTINGS = (*SHORT, "Coupling/exchange=one_pass")
NARROW, WIDE = "Coupling/ledger_limit=1e-9", "Coupling/ledger_limit=1"
# A row for every step.
LOADING = (*SETTINGS, "Loading/cycles=2", "Output/samples_per_cycle=250")
SOFT = ("Loading/frequency=500", "Membrane/youngs_modulus=3e4")


def stopped_run(spall, folder, settings, words, *options, before="none",
                hint=""):
    """Faults of a run that a guard stops with these words and this hint."""
    ended = subprocess.run(
        command(spall, folder, "membrane", *options, settings=settings),
        capture_output=True, text=True, timeout=300, check=False,
        env=ENVIRONMENT)
    state = folder / "checkpoint" / "stopped.bin"
    lines = ended.stderr.splitlines()
    faults = []
    if ended.returncode != 2 or len(lines) != 1:
        faults.append(f"status {ended.returncode}: {ended.stderr}")
    for part in (words, hint, str(state), f"last one before: {before}"):
        if part not in ended.stderr:
            faults.append(f"'{part}' is not in: {ended.stderr}")
    if not state.exists():
        faults.append(f"no {state}")
    return faults


def go_on(spall, root, name, settings):
    """Faults of going on from where a guard stopped, against an unbroken run.
    """
    checkpoint = root / name / "checkpoint"
    shutil.move(checkpoint / "stopped.bin", checkpoint / "state.bin")
    run(spall, root / name, "membrane", "--resume", settings=settings)
    whole = root / f"whole_{name}"
    run(spall, whole, "membrane", settings=settings)
    return [f"{path} differs"
            for path in differing(root / name, whole,
                                  ["history.csv", "events.csv", "ledger.csv"])]


def main():
    spall = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        faults = stopped_run(spall, root / "stopped", (*SETTINGS, NARROW),
                             "Coupling/ledger_limit")
        faults += stopped_run(spall, root / "soft", SOFT,
                              "in the surface 'membrane' facets",
                              hint="a higher Membrane/tension or a longer "
                              "Loading/consolidation_time may prevent it")
        loading = root / "loading"
        run(spall, loading, "membrane", "--until", "1",
            settings=(*LOADING, WIDE))
        faults += stopped_run(
            spall, loading, (*LOADING, NARROW), "Coupling/ledger_limit",
            "--resume", before=loading / "checkpoint" / "state.bin")
        if faults:
            return report_faults(faults)
        return report_faults(
            go_on(spall, root, "stopped", (*SETTINGS, WIDE)) +
            go_on(spall, root, "loading", (*LOADING, WIDE)))


if __name__ == "__main__":
    sys.exit(main())
