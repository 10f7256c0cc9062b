#!/usr/bin/env python3
"""Jumps over load cycles: every cycle is accounted for, what is refused leaves
nothing behind, and a run that was stopped goes on as if it had not been.

    cycle_jump.py SPALL membrane|rigid|periodic
"""
import pathlib
import re
import sys
import tempfile

from triaxial_runs import (differing, report_faults, rows, run, summary,
                           summary_faults)

CYCLES = 24
# Short cycles, weak particles, and jumps that nothing refuses.
SETTINGS = ("Loading/frequency=500", f"Loading/cycles={CYCLES}",
            "Breakage/fracture_energy=1e3",
            "CycleJump/tolerance=0.99", "CycleJump/first=2",
            "CycleJump/observed=2")
TABLES = ["history.csv", "events.csv", "ledger.csv", "cycles.csv"]


def account_faults(name, folder):
    """What the tables of a run say of its cycles."""
    _, cycles = rows(folder, "cycles.csv")
    _, history = rows(folder, "history.csv")
    found = summary(folder)
    stood_for = sum(row["stands_for_1"] for row in cycles)
    faults = []
    if stood_for != CYCLES or found["cycles_1"] != CYCLES:
        faults.append(f"{name}: rows of cycles.csv stand for {stood_for} of "
                      f"{CYCLES} cycles")
    skipped = sum(row["stands_for_1"] - 1. for row in cycles)
    if skipped != found["skipped_cycles_1"]:
        faults.append(f"{name}: {skipped} cycles are skipped in cycles.csv, "
                      f"{found['skipped_cycles_1']} in summary.json")
    loading = [row for row in history if row["stage_1"] == 2.]
    for key in ("cycle_1", "time_s", "laa_percent", "n_events_1"):
        if any(b[key] < a[key] for a, b in zip(loading, loading[1:])):
            faults.append(f"{name}: {key} of history.csv falls")
    _, events = rows(folder, "events.csv")
    least = 5 if sys.argv[2] == "periodic" else 20  # it is denser
    if not least < len(events) == found["n_events"]:
        faults.append(f"{name}: {len(events)} events in events.csv, "
                      f"{found['n_events']} in summary.json")
    # What has gone is the sum of the chips, jumps or not.
    lost = sum(event["removed_volume_m3"] for event in events)
    laa = 100. * lost / (lost + found["solid_volume_m3"])
    if abs(found["laa_percent"] / laa - 1.) > 1e-9:
        faults.append(f"{name}: laa_percent {found['laa_percent']}, chips of "
                      f"events.csv {laa}")
    if not found["energy_residual_ratio_1"] < 1e-3:
        faults.append(f"{name}: energy residual "
                      f"{found['energy_residual_ratio_1']} of the work")
    return faults


def landing_faults(folder):
    """Strain that landings have brought, of what was missing: in cycles of two
    milliseconds the particles spring back by some of it, or press too hard on the
    way."""
    landings = re.findall(r"strain moved on by (\S+) of (\S+) in",
                          (folder / "log.txt").read_text())
    if not landings:
        return ["log.txt tells of no landing"]
    return [f"a landing has brought {moved} of {missing}"
            for moved, missing in landings
            if not 0.3 * float(missing) < float(moved) < 1.1 * float(missing)]


def main():
    spall, lateral = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2]
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)

        def go(folder, *options, settings=()):
            run(spall, root / folder, lateral, *options,
                settings=(*SETTINGS, *settings))

        go("whole")
        faults = account_faults("whole", root / "whole")
        if summary(root / "whole")["n_jumps"] == 0:
            faults.append("whole: it has not jumped")
        faults += landing_faults(root / "whole")

        # Stopped before, within and after jumps.
        for until in (3, 9, 15):
            go("resumed", "--until", str(until), *(
                ["--resume"] if until > 3 else []))
            # A jump may pass the end: the run stops at the next one.
            stopped = summary(root / "resumed")["cycles_1"]
            if stopped < until or stopped % 1. != 0.:
                faults.append(f"--until {until}: stopped at cycle {stopped}")
        go("resumed", "--resume")
        faults += [f"resumed: {path} differs" for path in
                   differing(root / "resumed", root / "whole", TABLES)]
        faults += [f"resumed: {fault}" for fault in summary_faults(
            summary(root / "resumed"), summary(root / "whole"))]

        # Every jump is too far: what is left is the run without any.
        go("refused", settings=("CycleJump/tolerance=1e-9",))
        go("plain", settings=("CycleJump/tolerance=0",))
        faults += account_faults("refused", root / "refused")
        faults += [f"refused: {path} differs" for path in
                   differing(root / "refused", root / "plain", TABLES)]
        found = summary(root / "refused")
        if found["n_refused_jumps"] == 0 or found["n_jumps"] != 0:
            faults.append(f"refused: {found['n_refused_jumps']} jumps refused, "
                          f"{found['n_jumps']} not")
    return report_faults(faults)


if __name__ == "__main__":
    sys.exit(main())
