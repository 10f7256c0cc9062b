#!/usr/bin/env python3
"""A run that was stopped and resumed is the unbroken run, bit for bit.

    resume.py SPALL membrane|rigid|periodic [SECTION/KEY=VALUE ...]
"""
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

from triaxial_runs import (QUICK, command, differing, missing_frame_faults,
                           report_faults, run, summary, summary_faults)

TABLES = ["history.csv", "events.csv", "ledger.csv", "cycles.csv",
          "boundary_profile_start.csv", "boundary_profile_end.csv",
          "sections_start.csv", "sections_end.csv", "slices_start.csv",
          "slices_end.csv", "gradation.csv"]


def stop_when(is_time, spall, folder, lateral, *options, settings=()):
    """Sends SIGTERM once `is_time()`; what is wrong with the answer."""
    words = command(spall, folder, lateral, *options,
                    settings=(*QUICK, *settings))
    with subprocess.Popen(words, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True) as running:
        while running.poll() is None and not is_time():
            time.sleep(0.002)
        running.send_signal(signal.SIGTERM)
        _, stderr = running.communicate(timeout=100)
    lines = stderr.splitlines()
    if (running.returncode == 2 and len(lines) == 1 and
            lines[0].startswith("spall: stopped at step") and
            "--resume" in lines[0]):
        return []
    return [f"stopped: status {running.returncode}, stderr {stderr.strip()}"]


def time_of(path):
    return path.stat().st_mtime_ns if path.exists() else 0


def faults_of(name, folder, whole, frames_too=True):
    """Where the resumed run differs from the whole one."""
    names = list(TABLES)
    if frames_too:
        names += ["run.pvd", "case.prm",
                  *sorted({str(path.relative_to(of)) for of in (folder, whole)
                           for path in (of / "frames").iterdir()})]
    faults = [f"{name}: {path} differs"
              for path in differing(folder, whole, names)]
    return faults + [f"{name}: {fault}" for fault in summary_faults(
        summary(folder), summary(whole))]


def frame_faults(name, folder, n_instants=None):
    """Every instant once; of so many, if that is known."""
    frames = re.findall(r'timestep="([^"]+)" part="([^"]+)"',
                        (folder / "run.pvd").read_text())
    instants = sorted({float(time) for time, _ in frames})
    with open(folder / "history.csv") as history:
        end = float(history.readlines()[-1].split(",")[0])
    faults = []
    if len(set(frames)) != len(frames) or instants[-1] != end:
        faults.append(f"{name}: run.pvd has {frames}, the run ended at {end}")
    if n_instants not in (None, len(instants)):
        faults.append(f"{name}: frames of {instants}")
    return faults


def other_step_faults(spall, root, lateral, extra, go):
    """Where a cycle ends a run goes on with another step, elsewhere not."""
    go("other", "--until", "1")
    go("other", "--resume", settings=("Time/step=stable",))
    found, faults = summary(root / "other"), []
    if found["cycles_1"] != 2. or "longest_step_s" not in found:
        faults.append("other step: the run did not go on with it")
    if ("resumed with Time/step = stable, was fixed" not in
            (root / "other" / "log.txt").read_text()):
        faults.append("other step: the log does not name it")
    go("within", "--until", "1")
    state = root / "within" / "checkpoint" / "state.bin"
    before = time_of(state)

    # A checkpoint is written where a cycle ends: stop a little later.
    def is_within():
        written = time_of(state)
        return written != before and time.time_ns() - written > 2 * 10**7

    faults += stop_when(is_within, spall, root / "within", lateral, "--resume",
                        settings=(*extra, "Loading/cycles=50"))
    ended = subprocess.run(
        command(spall, root / "within", lateral, "--resume",
                settings=(*QUICK, *extra, "Loading/cycles=50",
                          "Time/step=stable")),
        capture_output=True, text=True, check=False)
    if ended.returncode != 1 or "end of a load cycle" not in ended.stderr:
        faults.append(f"other step within a cycle: status {ended.returncode}, "
                      f"{ended.stderr}")
    return faults


def refusal_faults(spall, whole, lateral, extra):
    """What a finished run cannot go on from is said in one line."""
    state = whole / "checkpoint" / "state.bin"
    bytes_of_state = bytearray(state.read_bytes())
    bytes_of_state[len(bytes_of_state) // 2] ^= 0x40
    history = (whole / "history.csv").read_bytes()
    faults = []

    def refused(said, *more):
        ended = subprocess.run(
            command(spall, whole, lateral, "--resume",
                    settings=(*QUICK, *extra, *more)),
            capture_output=True, text=True, check=False)
        if (ended.returncode != 1 or said not in ended.stderr or
                len(ended.stderr.splitlines()) != 1):
            faults.append(f"'{said}': status {ended.returncode}, "
                          f"{ended.stderr}")

    refused("has reached 2 where Loading/cycles is 1", "Loading/cycles=1")
    (whole / "history.csv").unlink()
    refused("history.csv: is missing")
    (whole / "history.csv").write_bytes(history)
    state.write_bytes(bytes_of_state)
    refused("checkpoint is damaged")
    return faults


def main():
    spall, lateral = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2]
    extra = sys.argv[3:]
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)

        def go(folder, *options, settings=()):
            run(spall, root / folder, lateral, *options,
                settings=(*QUICK, *extra, *settings))

        go("whole")
        go("until", "--until", "1")
        go("until", "--resume")
        faults = faults_of("--until", root / "until", root / "whole")
        go("until", "--resume")  # nothing left to do
        faults += faults_of("resumed when done", root / "until",
                            root / "whole")
        faults += frame_faults("whole", root / "whole")

        # A finished run goes on with more cycles; its last frame stays.
        go("more", settings=("Loading/cycles=1", "Output/frames_per_cycle=0"))
        faults += frame_faults("no frames", root / "more", n_instants=2)
        for frame in (root / "more" / "frames").glob("*_00000.vtu"):
            frame.unlink()
        go("more", "--resume")
        faults += missing_frame_faults(root / "more")
        faults += faults_of("more cycles", root / "more", root / "whole",
                            frames_too=False)

        # Stopped in the preparation, again within the second cycle.
        stopped = root / "stopped"
        faults += stop_when((stopped / "log.txt").exists, spall, stopped,
                            lateral, settings=extra)
        state = stopped / "checkpoint" / "state.bin"
        before = time_of(state)
        faults += stop_when(lambda: time_of(state) != before, spall, stopped,
                            lateral, "--resume", settings=extra)
        go("stopped", "--resume")
        faults += faults_of("SIGTERM", stopped, root / "whole")
        if lateral == "rigid":
            faults += other_step_faults(spall, root, lateral, extra, go)
        faults += refusal_faults(spall, root / "whole", lateral, extra)
    return report_faults(faults)


if __name__ == "__main__":
    sys.exit(main())
