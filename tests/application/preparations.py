#!/usr/bin/env python3
"""Specimens that are kept: a run that takes one up is the run that prepares
itself, bit for bit; a file that is not sound is made again.

    preparations.py SPALL
"""
import pathlib
import subprocess
import sys
import tempfile

from triaxial_runs import (CASE, DATA, QUICK, command, report_faults, run,
                           summary, summary_faults)

OTHER = ("Loading/amplitude=60e3", "Particle/friction=0.7",
         "Breakage/is_active=false", "Loading/confining_pressure=20e3")


def rows_after(folder):
    """Lines of history.csv from the consolidation on."""
    lines = (folder / "history.csv").read_text().splitlines()
    stage = lines[0].split(",").index("stage_1")
    return [line for line in lines[1:] if float(line.split(",")[stage]) > 0]


def equal_faults(name, folder, other):
    """Where the two runs differ after their preparation."""
    faults = [f"{name}: {file} differs" for file in ("events.csv", "ledger.csv")
              if (other / file).exists() and
              (folder / file).read_bytes() != (other / file).read_bytes()]
    if not rows_after(other) or rows_after(folder) != rows_after(other):
        faults.append(f"{name}: history.csv differs after the preparation")
    mine, its = summary(folder), summary(other)
    if mine["preparation"]["hash"] != its["preparation"]["hash"]:
        faults.append(f"{name}: another hash")
    return faults + [f"{name}: {fault}"
                     for fault in summary_faults(mine, its, {"preparation"})]


def is_taken(folder):
    said = "preparation taken from" in (folder / "log.txt").read_text()
    return said and summary(folder)["preparation"]["is_taken"]


def damage_faults(go, store, whole, other):
    """Files that are cut, changed in one byte or of something else: a word, or
    what another preparation has left (`other`, bytes)."""
    kept, = store.iterdir()
    sound = kept.read_bytes()
    middle = len(sound) // 2
    changed = bytes([sound[middle] ^ 1])
    faults = []
    for name, content, word in (
            ("cut", sound[:middle], "is damaged"),
            ("empty", b"", "too early"),
            ("changed", sound[:middle] + changed + sound[middle + 1:],
             "is damaged"),
            ("foreign", b"no preparation at all", "of this version"),
            ("other", other, "another preparation")):
        kept.write_bytes(content)
        folder = go("damage_" + name, *QUICK)
        lines = [line for line in
                 (folder / "log.txt").read_text().splitlines()
                 if "is made again" in line]
        if len(lines) != 1 or word not in lines[0]:
            faults.append(f"{name}: log says {lines}")
        if is_taken(folder):
            faults.append(f"{name}: was taken")
        faults += equal_faults(name, folder, whole)
        if [path.name for path in store.iterdir()] != [kept.name]:
            faults.append(f"{name}: {list(store.iterdir())} in the folder")
        if go("again_" + name, *QUICK) and not is_taken(
                folder.parent / ("again_" + name)):
            faults.append(f"{name}: was not made again")
    return faults


def together_faults(spall, root):
    """Two programs at once that prepare the same: both go well."""
    store = root / "together"
    both = [subprocess.Popen(
        command(spall, root / name, "rigid", "--preparations", str(store),
                settings=QUICK), stdout=subprocess.DEVNULL)
        for name in ("one", "two")]
    status = [program.wait(timeout=600) for program in both]
    faults = [] if status == [0, 0] else [f"together: status {status}"]
    if len(list(store.iterdir())) != 1:
        faults.append(f"together: {list(store.iterdir())}")
    return faults + equal_faults("together", root / "one", root / "two")


def study_faults(spall, root):
    """The cases of a study prepare a specimen once."""
    case = root / "study_case.prm"
    text = CASE.read_text().replace("../../../", str(DATA.parents[2]) + "/")
    text = text.replace("small_gradation.csv", str(DATA / "small_gradation.csv"))
    case.write_text(text.replace("lateral           = membrane",
                                 "lateral = rigid")
                    .replace("frequency          = 100", "frequency = 400"))
    study = root / "study.prm"
    study.write_text(f"""subsection Study
  set case     = {case}
  set seeds    = 1
  set outcomes = permanent_axial_strain_1
end
subsection Sweep
  set Loading/amplitude = 50e3, 80e3
end
""")
    ended = subprocess.run([spall, "study", str(study), "--out",
                            str(root / "study"), "--jobs", "1"],
                           capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        return [f"study: status {ended.returncode}: {ended.stderr}"]
    taken = sorted(summary(path.parent)["preparation"]["is_taken"]
                   for path in (root / "study").glob("*/summary.json"))
    return [] if taken == [False, True] else [f"study: taken {taken}"]


def check_faults(spall, store):
    """`check` times steps from the preparation that is kept, and says so."""
    def said(*settings):
        words = [word for setting in ("Boundary/lateral=rigid", *settings)
                 for word in ("--set", setting)]
        return subprocess.run([spall, "check", str(CASE), "--preparations",
                               str(store), *words], capture_output=True,
                              text=True, check=True).stdout
    kept, = store.iterdir()
    faults = []
    for words, expected in ((QUICK, str(kept)),
                            ((*QUICK, "Preparation/friction=0.45"),
                             "none of this kept")):
        lines = said(*words).splitlines()
        if f"preparation      {expected}" not in lines:
            faults.append(f"check does not say {expected}: {lines}")
        if not any(line.startswith("predicted time") for line in lines):
            faults.append(f"check predicts no time: {lines}")
        has_to = any(line.startswith("to prepare") for line in lines)
        if has_to != (expected == "none of this kept"):
            faults.append(f"time to prepare: {lines}")
    return faults


def main():
    spall = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        store = root / "store"

        def go(folder, *settings, lateral="rigid", options=None):
            options = (("--preparations", str(store)) if options is None
                       else options)
            run(spall, root / folder, lateral, *options, settings=settings)
            return root / folder

        own = go("own", *QUICK, options=())
        faults = equal_faults("keeping", go("first", *QUICK), own)
        if is_taken(root / "first") or len(list(store.iterdir())) != 1:
            faults.append("the first run has not kept its preparation")
        faults += equal_faults("taken", go("second", *QUICK), own)
        faults += check_faults(spall, store)
        for lateral in ("rigid", "membrane"):
            mine = go("other_" + lateral, *QUICK, *OTHER, lateral=lateral)
            its = go("own_" + lateral, *QUICK, *OTHER, lateral=lateral,
                     options=())
            faults += equal_faults(lateral, mine, its)
            if not is_taken(mine):
                faults.append(f"{lateral}: has prepared itself")
        if go("denser", *QUICK, "Preparation/friction=0.45") and is_taken(
                root / "denser"):
            faults.append("took what another friction has prepared")
        hash_of_denser = summary(root / "denser")["preparation"]["hash"]
        denser, = (path for path in store.iterdir()
                   if hash_of_denser in path.name)
        other = denser.read_bytes()
        denser.unlink()
        faults += damage_faults(go, store, own, other)
        faults += together_faults(spall, root)
        faults += study_faults(spall, root)
    return report_faults(faults)


if __name__ == "__main__":
    sys.exit(main())
