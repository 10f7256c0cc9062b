#!/usr/bin/env python3
"""Any number of MPI ranks gives the same bits; faults end all ranks at once.

    ranks.py SPALL same|membrane|jumps|drum|study|compaction|
        subgrade|continued|faults
    ranks.py SPALL membrane_long|compaction_long|subgrade_long

77: no mpirun on this machine
"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import compaction
import cycle_jump
import subgrade
from lab import DRUM, write_prm
from triaxial_runs import (ENVIRONMENT, QUICK, command, differing,
                           report_faults, rows, run, summary, summary_faults)

MPIRUN = shutil.which("mpirun")
TABLES = ["history.csv", "events.csv", "ledger.csv", "cycles.csv",
          "gradation.csv", "boundary_profile_start.csv",
          "boundary_profile_end.csv", "sections_start.csv",
          "sections_end.csv", "slices_start.csv", "slices_end.csv",
          "transfer.csv", "profile.csv", "bowl.csv",
          "case.prm", "run.pvd"]
# Root in a container, and fewer cores than ranks, are fine for this.
LAUNCHED = {**ENVIRONMENT, "OMPI_ALLOW_RUN_AS_ROOT": "1",
            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
PATIENCE = 10.  # of the user, with ranks that have nothing to wait for [s]


def on_ranks(n_ranks, words):
    return [MPIRUN, "-n", str(n_ranks), "--oversubscribe", "--bind-to", "none",
            "--mca", "mpi_yield_when_idle", "1", *map(str, words)]


def launch(n_ranks, words, timeout=600):
    return subprocess.run(on_ranks(n_ranks, words), env=LAUNCHED, check=False,
                          capture_output=True, text=True, timeout=timeout)


def go(spall, n_ranks, folder, *options, lateral="rigid", settings=()):
    """A run of the small case to its end."""
    ended = launch(n_ranks, command(spall, folder, lateral, *options,
                                    settings=(*QUICK, *settings)))
    if ended.returncode != 0:
        raise SystemExit(f"{n_ranks} ranks: status {ended.returncode}\n"
                         f"{ended.stdout}\n{ended.stderr}")


def logged_warnings(folder):
    return [line for line in (folder / "log.txt").read_text().splitlines()
            if line.startswith("warning: ")]


def differences(name, folder, whole):
    """Where a run differs from that of one rank, costs left out."""
    frames = sorted({str(path.relative_to(of)) for of in (folder, whole)
                     for path in (of / "frames").iterdir()})
    faults = [f"{name}: {path} differs"
              for path in differing(folder, whole, [*TABLES, *frames])]
    return faults + [f"{name}: {fault}" for fault in summary_faults(
        summary(folder), summary(whole), left_out=("ranks",))]


def same(spall, root):
    faults = []
    for name, ranks, settings in (
            ("fixed", (2, 3), ("Time/step=fixed",
                               "Contact/overlap_warning=1e-4")),
            ("stable", (2,), ("Time/step=stable",)),
            ("error", (2,), ("Time/step=error",)),
            ("scaled", (2,), ("Time/step=stable",
                              "Time/density_scaling_diameter=0.012")),
            ("surfaces", (2,), ("Contact/geometry=surface",
                                "Contact/wall_geometry=surface",
                                "Particle/rolling_friction=0",
                                "Specimen/initial_solid_fraction=0.12",
                                "Time/step=stable", "Loading/cycles=1")),
            ("cylinder", (2,), ("Specimen/form=cylinder",
                                "Specimen/diameter=0.05",
                                "Specimen/height=0.07"))):
        whole = root / name
        run(spall, whole, "rigid", settings=(*QUICK, *settings))
        for n_ranks in ranks:
            folder = root / f"{name}_{n_ranks}"
            go(spall, n_ranks, folder, settings=settings)
            faults += differences(f"{name}, {n_ranks} ranks", folder, whole)
            if logged_warnings(folder) != logged_warnings(whole):
                faults.append(f"{name}: other warnings in log.txt")
            if summary(folder)["ranks"] != n_ranks:
                faults.append(f"{n_ranks} ranks: not in summary.json")
    if summary(root / "fixed")["n_events"] == 0:
        faults.append("no event: the test shows nothing of breakage")
    if len(logged_warnings(root / "fixed")) < 2:
        faults.append("no overlap is deep: the test shows nothing of warnings")
    return faults


WINDOWS = ("Coupling/particle_steps=4", "Time/step=stable")
MEMBRANES = {
    "every_step": ("Time/step=stable",),
    "one_pass": ("Coupling/exchange=one_pass", "Loading/cycles=1", *WINDOWS),
    "iterated": ("Coupling/exchange=iterated", "Loading/cycles=1", *WINDOWS),
    "error": ("Time/step=error", "Loading/cycles=1"),
    "surfaces": ("Contact/geometry=surface", "Contact/wall_geometry=surface",
                 "Particle/rolling_friction=0",
                 "Specimen/initial_solid_fraction=0.12", "Time/step=stable",
                 "Loading/cycles=1"),
}


def membrane_faults(spall, root, names):
    """In a flexible membrane, by each way of exchange."""
    faults = []
    for name in names:
        settings = MEMBRANES[name]
        run(spall, root / name, "membrane", settings=(*QUICK, *settings))
        go(spall, 2, root / f"{name}_2", lateral="membrane",
           settings=settings)
        faults += differences(f"membrane, {name}", root / f"{name}_2",
                              root / name)
    return faults


def membrane(spall, root):
    """And continued on other numbers of ranks, between which it breaks."""
    faults = membrane_faults(spall, root,
                             ("every_step", "one_pass", "surfaces"))
    parts, settings = root / "parts", MEMBRANES["every_step"]
    go(spall, 3, parts, "--until", "1", lateral="membrane", settings=settings)
    run(spall, parts, "membrane", "--resume", settings=(*QUICK, *settings))
    faults += differences("3 ranks, then 1", parts, root / "every_step")
    if summary(parts)["n_events"] == 0:
        faults.append("no event: the test shows nothing of breakage")
    return faults


def membrane_long(spall, root):
    return membrane_faults(spall, root, ("iterated", "error"))


def jumps(spall, root):
    """Over load cycles, of particles in a membrane."""
    whole, two = root / "whole", root / "two"
    settings = (*cycle_jump.SETTINGS, *QUICK)
    run(spall, whole, "membrane", settings=settings)
    go(spall, 2, two, lateral="membrane", settings=settings)
    faults = differences("jumps", two, whole)
    if summary(whole)["skipped_cycles_1"] == 0:
        faults.append("jumps: no cycle was skipped")
    return faults


def case_faults(spall, root, name, case):
    words = [spall, "run", case, "--threads", 1, "--out"]
    subprocess.run([*map(str, words), str(root / name)], check=True,
                   stdout=subprocess.DEVNULL, env=ENVIRONMENT)
    ended = launch(2, [*words, root / f"{name}_2"])
    if ended.returncode != 0:
        raise SystemExit(f"{name}: status {ended.returncode}\n{ended.stderr}")
    return differences(name, root / f"{name}_2", root / name)


def compaction_faults(spall, root, forms):
    """Particles are added layer by layer; plates and a sleeve deform."""
    faults = []
    for form in forms:
        faults += case_faults(spall, root, form,
                              compaction.write_case(root, form))
        if summary(root / form)["n_events"] == 0:
            faults.append(f"{form}: no event")
    return faults


def compacted(spall, root):
    return compaction_faults(spall, root, ("flexible", "elastic"))


def compacted_long(spall, root):
    return compaction_faults(spall, root, ("rigid", "tilting"))


def ground(spall, root):
    case = write_prm(root / "case.prm", subgrade.SCENE)
    return case_faults(spall, root, "subgrade", case)


def distributed_faults(spall, root):
    """A ground whose linear systems are spread over two ranks against one that
    every rank factorises: to the tolerance of the solver, not bit for bit."""
    found = {}
    for solver in ("direct", "distributed_amg"):
        case = write_prm(root / f"{solver}.prm", subgrade.changed(
            Subgrade={"solver": solver}, Coupling={"body_time": "implicit"}))
        ended = launch(2, [spall, "run", case, "--threads", 1, "--out",
                           root / solver])
        if ended.returncode != 0:
            return [f"{solver}: status {ended.returncode}\n{ended.stderr}"]
        found[solver] = rows(root / solver, "history.csv")[1]
    faults = []
    for column in ("plate_settlement_m", "subgrade_force_N",
                   "vertical_stress_0.05m_Pa"):
        direct, spread = ([row[column] for row in found[solver]]
                          for solver in ("direct", "distributed_amg"))
        size = max(map(abs, direct))
        apart = max(abs(a - b) for a, b in zip(direct, spread, strict=True))
        if not apart < 1e-6 * size:
            faults.append(f"distributed_amg: {column} {apart / size} apart")
        print(f"distributed_amg: {column} {apart / size:.1e} apart")
    return faults


def ground_long(spall, root):
    case = write_prm(root / "case.prm",
                     subgrade.changed(Subgrade={"body": "full"}))
    return (case_faults(spall, root, "full subgrade", case) +
            distributed_faults(spall, root))


def drum(spall, root):
    """A Los Angeles drum with a few large bodies and a ball."""
    faults = case_faults(spall, root, "whole",
                         write_prm(root / "drum.prm", DRUM))
    faults += [f"drum: {path.name} differs"
               for path in (root / "whole").glob("roundness_*.csv")
               if differing(root / "whole_2", root / "whole", [path.name])]
    if summary(root / "whole")["n_events"] == 0:
        faults.append("drum: no event")
    return faults


def study(spall, root):
    """Cases on two ranks each; one that needs one rank gets it."""
    write_prm(root / "drum.prm", {**DRUM, "Drum": {
        **DRUM["Drum"], "turns": 0.25, "settling_time": 0.05}})
    file = write_prm(root / "study.prm", {
        "Study": {"case": "drum.prm", "outcomes": "n_events, laa_percent"},
        "Sweep": {"Breakage/memory": "contact, patch"}})
    faults = []
    for name, more in (("one", ()), ("two", (
            "--ranks-per-case", 2, "--mpirun",
            f"{MPIRUN} --oversubscribe --bind-to none"))):
        words = [spall, "study", file, "--out", root / name, "--jobs", 1,
                 *more]
        subprocess.run(list(map(str, words)), check=True, env=LAUNCHED,
                       stdout=subprocess.DEVNULL, timeout=200)
    if (root / "one/study.csv").read_text() != \
            (root / "two/study.csv").read_text():
        faults.append("study: other outcomes on two ranks")
    ranks = sorted(summary(run)["ranks"]
                   for run in (root / "two").glob("run_*") if run.is_dir())
    return faults + ([] if ranks == [1, 2] else [f"study: ranks {ranks}"])


def check_faults(spall, root):
    case = command(spall, root / "none", "membrane")[2]
    ended = launch(2, [spall, "check", case, "--set", "Loading/cycles=1"])
    said = [line for line in ended.stdout.splitlines()
            if line.startswith(("ranks", "predicted", "memory"))]
    return [] if ended.returncode == 0 and len(said) == 3 else [
        f"check: status {ended.returncode}, {ended.stdout}{ended.stderr}"]


def continued(spall, root):
    """Of two ranks, then three, then one, a cycle each."""
    whole, parts = root / "whole", root / "parts"
    settings = ("Loading/cycles=3",)
    run(spall, whole, "rigid", settings=(*QUICK, *settings))
    go(spall, 2, parts, "--until", "1", settings=settings)
    go(spall, 3, parts, "--resume", "--until", "2", settings=settings)
    run(spall, parts, "rigid", "--resume", settings=(*QUICK, *settings))
    faults = differences("2, 3, 1 ranks", parts, whole)

    # Preparations that one number of ranks keeps serve any other.
    kept = root / "kept"
    for n_ranks, name in ((2, "first"), (3, "second")):
        go(spall, n_ranks, root / name, "--preparations", kept,
           settings=settings)
    return faults + [
        f"preparation kept: {path} differs" for path in
        differing(root / "second", root / "first", ["events.csv", "cycles.csv"])]


def children(process):
    """The ranks that mpirun has started."""
    found = []
    for status in pathlib.Path("/proc").glob("[0-9]*/status"):
        try:
            lines = dict(line.split(":", 1)
                         for line in status.read_text().splitlines())
        except OSError:  # it has ended
            continue
        if int(lines["PPid"]) == process.pid and "spall" in lines["Name"]:
            found.append(int(lines["Pid"]))
    return found


def started(spall, folder, n_ranks):
    """A run that would take long, after its first checkpoint."""
    words = command(spall, folder, "rigid",
                    settings=(*QUICK, "Loading/cycles=200"))
    running = subprocess.Popen(on_ranks(n_ranks, words), env=LAUNCHED,
                               stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
    state = folder / "checkpoint" / "state.bin"
    while running.poll() is None and not state.exists():
        time.sleep(0.01)
    return running


def ends(running, name):
    """What stderr has, and faults: it takes too long."""
    try:
        return running.communicate(timeout=PATIENCE)[1], []
    except subprocess.TimeoutExpired:
        running.kill()
        return running.communicate()[1], [f"{name}: runs on"]


def one_line(name, ended, said):
    lines = [line for line in ended.stderr.splitlines()
             if line.startswith("spall: ")]
    if ended.returncode == 1 and len(lines) == 1 and said in lines[0]:
        return []
    return [f"{name}: status {ended.returncode}, {ended.stderr}"]


def faults(spall, root):
    found = []
    # What no rank can do is said once.
    found += one_line("check", launch(2, [spall, "check", "x.prm"]), "x.prm")
    found += check_faults(spall, root)
    found += one_line("no file", launch(2, [spall, "run", "x.prm"]), "x.prm")
    found += one_line("patch", launch(2, command(
        spall, root / "patch", "membrane",
        settings=("Breakage/memory=patch",))), "Breakage/memory = patch")
    found += one_line("periodic sides", launch(2, command(
        spall, root / "periodic", "periodic")), "Boundary/lateral = periodic")
    scene = write_prm(root / "scene.prm", {
        "Case": {"kind": "scene"}, "Box": {"y": "periodic"},
        "Fill": {"mass": 1, "gradation":
                 "gradations/los_angeles_20_45mm.csv"}})
    found += one_line("periodic box", launch(2, [
        spall, "run", scene, "--out", root / "box"]), "Box/y = periodic")
    found += [f"{name}: left a folder" for name in ("patch", "periodic", "box")
              if (root / name).exists()]
    (root / "file").write_text("")
    found += one_line("no folder", launch(2, command(
        spall, root / "file", "rigid")), "is a file")

    # A rank is killed: all end.
    folder = root / "killed"
    running = started(spall, folder, 2)
    os.kill(children(running)[1], signal.SIGKILL)
    found += ends(running, "killed")[1]
    go(spall, 2, folder, "--resume", "--until", "3",
       settings=("Loading/cycles=200",))

    # A request to stop reaches all.
    folder = root / "stopped"
    running = started(spall, folder, 3)
    running.send_signal(signal.SIGTERM)
    stderr, late = ends(running, "stopped")
    found += late
    lines = [line for line in stderr.splitlines()
             if line.startswith("spall: ")]
    if len(lines) > 1 or (lines and "--resume" not in lines[0]):
        found.append(f"stopped: {stderr}")
    return found


def main():
    if not MPIRUN:
        print("no mpirun on this machine: skipped")
        return 77
    spall = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        ask = {"same": same, "membrane": membrane,
               "membrane_long": membrane_long, "jumps": jumps,
               "drum": drum, "study": study, "compaction": compacted,
               "compaction_long": compacted_long, "subgrade": ground,
               "subgrade_long": ground_long, "continued": continued,
               "faults": faults}[sys.argv[2]]
        return report_faults(ask(spall, pathlib.Path(name)))


if __name__ == "__main__":
    sys.exit(main())
