#!/usr/bin/env python3
"""Writes that fail, and runs that are killed while they write.

A library (tests/support/failing_files.cc) makes the n-th operation on the files
of a run fail, or ends the program there. The run must then end with one clear
line and leave no damaged file under its final name. The same command or
--resume must give the tables and frames of the unbroken run, bit for bit.

    failing_files.py SPALL LIBRARY single|triaxial|subgrade|kills|commands|disk
        [STRIDE]
"""
import dataclasses
import pathlib
import shutil
import subprocess
import sys
import tempfile
from xml.etree import ElementTree

from lab import CUBE, write_prm
from subgrade import changed
from triaxial_runs import (CASE, ENVIRONMENT, report_faults, summary,
                           summary_faults)

# A sphere between platens, ten rows, a tenth of a second of work.
SPHERE = {
    "Case": {"kind": "single_particle"},
    "Particle": {"shape": "", "diameter": 0.02},
    "Press": {"displacement": 1e-4, "speed": 0.1, "rows": 10},
    "Time": {"fixed_step": 1e-5},
}
GROUND = changed(
    Layer={"length": 0.14, "width": 0.14, "thickness": 0.045},
    LoadPlate={"diameter": 0.1, "mass": 20},
    Subgrade={"length": 0.4, "width": 0.4, "layers": "0.1 40e6 0.3 1900",
              "cell_size": 0.1},
    Pulse={"rest": 0.01},
    Record={"checkpoint_interval": 0.01, "frame_interval": 0.02,
            "stress_depths": "0.05"})
# Files that grow by lines while the test runs.
GROWING = {"history.csv", "events.csv", "ledger.csv", "cycles.csv"}
# What an interrupted run says when it starts from the beginning.
STARTS_OVER = "ended before its first checkpoint"


@dataclasses.dataclass
class Setup:
    """A run, its unbroken folder, and the library that makes it fail."""
    words: list
    whole: pathlib.Path
    preloaded: str
    root: pathlib.Path

    def run(self, folder, *options, **fault):
        """fault: at = operation, kind = fail, full or kill."""
        return spall([*self.words, "--out", folder, *options], self.preloaded,
                     folder, **fault)


def spall(words, library="", folder="", at=0, kind="fail", stdout=None):
    environment = dict(ENVIRONMENT)
    if at:
        environment |= {"LD_PRELOAD": library, "FAULT_FOLDER": str(folder),
                        "FAULT_AT": str(at), "FAULT_KIND": kind,
                        "FAULT_LOG": "/dev/null"}
    return subprocess.run(
        list(map(str, words)), stdout=stdout or subprocess.PIPE,
        stderr=subprocess.PIPE, text=True, timeout=300, check=False,
        env=environment)


def operations(setup):
    """What an unbroken run does with its files: lines "name path"."""
    log, folder = setup.root / "operations", setup.root / "counted"
    environment = {**ENVIRONMENT, "LD_PRELOAD": setup.preloaded,
                   "FAULT_FOLDER": str(folder), "FAULT_LOG": str(log)}
    subprocess.run(list(map(str, [*setup.words, "--out", folder])),
                   stdout=subprocess.DEVNULL, check=True, env=environment)
    shutil.rmtree(folder)
    return [line.split(" ", 1)[1] for line in log.read_text().splitlines()]


def files_of(folder):
    return {str(path.relative_to(folder)): path
            for path in folder.rglob("*") if path.is_file()}


def is_whole(name, path, setup):
    """Whether a file that has its final name is sound."""
    unbroken = setup.whole / name
    if name in GROWING:
        text = path.read_bytes()
        return (unbroken.read_bytes().startswith(text) and
                (not text or text.endswith(b"\n")))
    if name == "summary.json":
        return bool(summary(path.parent))
    if name == "run.pvd":
        return all((path.parent / entry.get("file")).exists()
                   for entry in ElementTree.parse(path).iter("DataSet"))
    # The sizes of the log and times in the checkpoint vary; a damaged
    # checkpoint is refused when the run is resumed.
    return (name == "log.txt" or name.startswith("checkpoint/") or
            path.read_bytes() == unbroken.read_bytes())


def damage(folder, setup, is_killed):
    faults = []
    for name, path in files_of(folder).items():
        if name.endswith(".part"):
            if not is_killed:
                faults.append(f"{name} is left behind")
        elif is_killed and name in GROWING:
            if not (setup.whole / name).read_bytes().startswith(
                    path.read_bytes()):
                faults.append(f"{name} is damaged")
        elif not is_whole(name, path, setup):
            faults.append(f"{name} is damaged")
    return faults


def differences(folder, setup):
    """Where a run that has come to its end differs from the unbroken one."""
    mine, whole = files_of(folder), files_of(setup.whole)
    faults = [f"{name} is there in one run only"
              for name in sorted(set(mine) ^ set(whole))]
    for name in sorted(set(mine) & set(whole)):
        if (name not in ("log.txt", "summary.json") and
                not name.startswith("checkpoint/") and
                mine[name].read_bytes() != whole[name].read_bytes()):
            faults.append(f"{name} differs from that of the unbroken run")
    return faults + summary_faults(summary(folder), summary(setup.whole))


def line_faults(ended, words=()):
    lines = ended.stderr.splitlines()
    if (ended.returncode in (1, 2) and len(lines) == 1 and
            lines[0].startswith("spall: ") and
            all(word in lines[0] for word in words)):
        return []
    return [f"status {ended.returncode}: {ended.stderr.strip()}"]


def recovery_options(folder, number):
    """Every way to go on that there is, in turn."""
    if (folder / "checkpoint" / "state.bin").exists():
        return ["--overwrite"] if number % 3 == 0 else ["--resume"]
    return ["--resume"] if folder.exists() and number % 2 == 0 else []


def fault_at(setup, number, kind, what):
    """Faults of a run whose operation of this number fails."""
    folder = setup.root / f"{kind}_{number}"
    ended = setup.run(folder, at=number, kind=kind)
    is_killed = kind == "kill"
    if is_killed:
        faults = [] if ended.returncode == -9 else [
            f"status {ended.returncode}: {ended.stderr}"]
    elif ended.returncode != 0:
        faults = line_faults(ended)
    else:  # then nothing is lost
        faults = differences(folder, setup)
    if folder.exists():
        faults += damage(folder, setup, is_killed)
    if ended.returncode != 0:
        options = recovery_options(folder, number)
        again = setup.run(folder, *options)
        if again.returncode != 0:
            faults.append(f"again with {options}: {again.stderr.strip()}")
        else:
            faults += differences(folder, setup)
            if options == ["--resume"] and is_killed and (
                    "case.prm" in what or number < 9) and \
                    STARTS_OVER not in again.stdout:
                faults.append("starts over without a line")
    shutil.rmtree(folder, ignore_errors=True)
    return [f"{kind} {number} ({what}): {fault}" for fault in faults]


def make_setup(program, library, root, case, *more):
    words = [program, "run", case, "--threads", 1, *more]
    setup = Setup(words, root / "whole", library, root)
    # Twice: a store of preparations is filled by the first.
    for name in ("first", "whole") if "--preparations" in more else ("whole",):
        ended = spall([*words, "--out", root / name])
        if ended.returncode != 0:
            raise SystemExit(f"{ended.args}: {ended.stderr}")
    return setup


def walk(setup, numbers, kinds):
    """Faults at these operations, and how many operations there are."""
    done, faults = operations(setup), []
    last = len(done)
    for kind in kinds:
        for number in numbers(last):
            faults += fault_at(setup, number, kind, done[number - 1])
    print(f"{last} operations, {len(numbers(last))} of them with "
          f"{', '.join(kinds)}")
    if setup.root.joinpath("first").exists():
        shutil.rmtree(setup.root / "first")
    return faults


def strided(stride):
    return lambda last: range(1 + last % stride, last + 1, stride)


def single(program, library, root, stride):
    case = write_prm(root / "case.prm", SPHERE)
    setup = make_setup(program, library, root, case)
    return walk(setup, strided(stride), ("fail", "full"))


def kills(program, library, root, stride):
    """Every stage before case.prm is there, then every stride-th."""
    case = write_prm(root / "case.prm", SPHERE)
    setup = make_setup(program, library, root, case)
    return walk(setup, lambda last: [*range(1, 13),
                                     *range(13, last + 1, stride)], ("kill",))


def triaxial(program, library, root, stride):
    setup = make_setup(
        program, library, root, CASE, "--preparations", root / "store",
        "--set", "Loading/frequency=2000", "--set",
        "Loading/consolidation_time=1e-4", "--set",
        "Output/samples_per_cycle=10")
    return walk(setup, strided(stride), ("fail", "full", "kill"))


def subgrade(program, library, root, stride):
    case = write_prm(root / "case.prm", GROUND)
    setup = make_setup(program, library, root, case, "--preparations",
                       root / "store")
    return walk(setup, strided(stride), ("fail", "full", "kill"))


def is_same(mine, other):
    """Pictures vary with the driver; they have an end that shows them whole."""
    if not (mine.exists() and other.exists()):
        return False
    mine, ending, other = mine.read_bytes(), other.suffix, other.read_bytes()
    return mine == other or (ending in (".html", ".png") and
                             mine[-8:] == other[-8:])


def same_files(folder, other):
    return [f"{name} differs" for name, path in files_of(other).items()
            if not is_same(folder / name, path)]


def command_walk(words, library, root, stride):
    """A command that writes into root/out: what is there is whole."""
    faults, out, number = [], root / "out", 1
    out.mkdir()
    spall(words)
    whole = out.rename(root / "whole_out")
    while True:
        out.mkdir()
        ended = spall(words, library, out, at=number)
        is_unharmed = ended.returncode == 0 and not same_files(out, whole)
        if not is_unharmed:
            faults += line_faults(ended, ["cannot"])
        for name, path in files_of(out).items():
            if not is_same(path, whole / name):
                faults.append(f"{number}: {name} is damaged or a draft")
        shutil.rmtree(out)
        if is_unharmed:
            break
        number += stride
    shutil.rmtree(whole)
    print(f"{words[1]}: {number} operations")
    return faults


def study_faults(program, library, root):
    """A study goes on where a write failed in it or in one of its runs."""
    write_prm(root / "case.prm", SPHERE)
    file = write_prm(root / "study.prm", {
        "Study": {"case": "case.prm", "outcomes": "n_events"},
        "Sweep": {"Particle/friction": "0.5"}})
    words = [program, "study", file, "--jobs", 1, "--out"]
    spall([*words, root / "whole_study"])
    faults = []
    for number in (2, 6, 20):
        folder = root / f"study_{number}"
        faults += line_faults(spall([*words, folder], library, folder,
                                    at=number), ["study" if number > 6 else ""])
        again = spall([*words, folder])
        if again.returncode != 0 or (folder / "study.csv").read_bytes() != (
                root / "whole_study" / "study.csv").read_bytes():
            faults.append(f"study {number}: {again.stderr}")
    return faults


def commands(program, library, root, stride):
    case = write_prm(root / "case.prm", SPHERE)
    spall([program, "run", case, "--out", root / "run"])
    cube = pathlib.Path(__file__).parents[2] / "data" / \
        CUBE["Particle"]["shape"]
    packing = root / "packing.csv"
    packing.write_text("# box 0.1 0.1 0.1\nx,y,z,radius\n"
                       "0.03,0.05,0.05,0.01\n0.06,0.05,0.05,0.01\n")
    faults = []
    for words in (
            ["report", root / "run", "--out", root / "out" / "report.html",
             "--figures", root / "out" / "figures"],
            ["shape", "info", cube, "--json", root / "out" / "facts.json"],
            ["bench", "--packing", packing, "--steps", 1, "--save",
             root / "out" / "packing.csv"]):
        faults += command_walk([program, *words], library, root, stride)
    faults += study_faults(program, library, root)
    for words in (["template", "single_particle"],
                  ["shape", "info", cube]):
        with open("/dev/full", "w", encoding="ascii") as full:
            faults += line_faults(spall([program, *words], stdout=full),
                                  ["standard output: cannot be written"])
    return faults + line_faults(
        spall([program, "shape", "info", cube, "--json", "/dev/full"]),
        ["/dev/full: cannot be written: No space left on device"])


def mounted(folder, size):
    folder.mkdir()
    return subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k",
                           "tmpfs", str(folder)], capture_output=True,
                          check=False).returncode == 0


def disk(program, library, root, _):
    """A disk that is really full, and a folder that is not all Spall's."""
    case = write_prm(root / "case.prm", SPHERE)
    setup = make_setup(program, library, root, case)
    faults = foreign_faults(setup)
    for size in (16, 40, 64):
        folder = root / f"disk_{size}"
        if not mounted(folder, size):
            print("no file system may be mounted here")
            return faults
        try:
            faults += line_faults(setup.run(folder / "run"),
                                  ["No space left on device"])
            faults += damage(folder / "run", setup, False)
            subprocess.run(["mount", "-o", "remount,size=4m", str(folder)],
                           check=True)
            again = setup.run(folder / "run",
                              *recovery_options(folder / "run", 1))
            faults += ([] if again.returncode == 0 else [again.stderr]) + \
                differences(folder / "run", setup)
        finally:
            subprocess.run(["umount", str(folder)], check=True)
    return faults


def foreign_faults(setup):
    """A new run removes the files of the earlier one and no others."""
    faults, folder = [], setup.root / "own"
    shutil.copytree(setup.whole, folder)
    mine = ["notes.txt", "frames/picture.png", "checkpoint/copy_of_state",
            "sections_of_a_book.txt"]
    for name in mine:
        (folder / name).write_text("mine")
    (folder / "frames" / "particles_00007.vtu").write_text("old")
    again = setup.run(folder)
    if again.returncode != 0:
        faults.append(f"own files: {again.stderr}")
    for name in mine:
        if not (folder / name).exists() or \
                (folder / name).read_text() != "mine":
            faults.append(f"{name} is removed")
        (folder / name).unlink(missing_ok=True)
    faults += differences(folder, setup)
    for name, text in {"log.txt": "of another program", "frames/a.png": "x",
                       "case.prm.part": "subsection Case\n"}.items():
        other = setup.root / "other"
        (other / name).parent.mkdir(parents=True)
        (other / name).write_text(text)
        for options in ([], ["--overwrite"], ["--resume"]):
            faults += line_faults(setup.run(other, *options), ["other"])
        if list(files_of(other)) != [name] or \
                (other / name).read_text() != text:
            faults.append(f"{name} of another program is touched")
        shutil.rmtree(other)
    return faults


def main():
    program, library = (str(pathlib.Path(word).resolve())
                        for word in sys.argv[1:3])
    stride = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    walks = {"single": single, "triaxial": triaxial, "subgrade": subgrade,
             "kills": kills, "commands": commands, "disk": disk}
    with tempfile.TemporaryDirectory() as name:
        return report_faults(walks[sys.argv[3]](
            program, library, pathlib.Path(name).resolve(), stride))


if __name__ == "__main__":
    sys.exit(main())
