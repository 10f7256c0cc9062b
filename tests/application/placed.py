#!/usr/bin/env python3
"""Placed particles in all kinds of tests: the last state of a run as the start
of another, preparations that are kept, input.

    placed.py SPALL drum|compaction|subgrade|triaxial|input
"""
import pathlib
import shutil
import sys
import tempfile

import compaction
import subgrade
from lab import DRUM, near, spall_run, write_prm
from triaxial_runs import report_faults, rows, run, summary


def table(folder):
    """Header and rows of particles.csv."""
    lines = (folder / "particles.csv").read_text().splitlines()
    return lines[0].split(","), [line.split(",") for line in lines[1:]]


def same_particles(first, second):
    """Both runs have the particles of the first one's end: their volumes to
    round-off, for a volume is an integral over the shape."""
    faults = near("solid volume", summary(second)["solid_volume_m3"],
                  summary(first)["solid_volume_m3"], 1e-12)
    if summary(second)["n_particles"] != summary(first)["n_particles"]:
        faults.append("another number of particles")
    return faults


def drum(spall, root):
    """The charge continues with the shapes and velocities that it has come
    to; a particle that has broken has a shape of its own."""
    case = write_prm(root / "drum.prm", DRUM)
    first, second = root / "first", root / "second"
    spall_run([spall, "run", case, "--out", first, "--threads", 1])
    header, particles = table(first)
    names = {row[header.index("shape")] for row in particles}
    files = {path.stem for path in (first / "shapes").iterdir()}
    faults = []
    if names != files | {"sphere"}:
        faults.append(f"shapes {sorted(names)}, files {sorted(files)}")
    if not any(name.startswith("particle_") for name in names):
        faults.append("no particle has broken")
    if [row[header.index("material")] for row in particles].count("other") != 1:
        faults.append("the steel ball is not of material other")
    # Nothing breaks before the drum turns: the volume stays.
    spall_run([spall, "run", case, "--out", second, "--threads", 1,
               "--set", f"Charge/particles={first}", "--set", "Drum/turns=0.01",
               "--set", "Drum/settling_time=0.02",
               "--set", "Breakage/is_active=false"])
    faults += same_particles(first, second)
    faults += near("kinetic energy",
                   rows(second, "history.csv")[1][0]["kinetic_energy_J"],
                   rows(first, "history.csv")[1][-1]["kinetic_energy_J"], 1e-12)
    if (second / "gradation.csv").exists():
        faults.append("placed particles have a gradation.csv")
    return faults


def again(spall, case, out, start, section, *settings):
    words = [spall, "run", case, "--out", out, "--threads", 1,
             "--set", f"{section}/particles={start}"]
    for setting in settings:
        words += ["--set", setting]
    spall_run(words, timeout=1000)
    return out


def taken(folder):
    return "preparation taken from" in (folder / "log.txt").read_text()


def compaction_run(spall, root):
    """A layer that is in the container already; a filling is kept by the
    contents of the files that it begins with."""
    case = compaction.write_case(root, "rigid")
    first, state = root / "first", root / "state"
    short = ("Vibration/duration=0.02", "Vibration/reports=0.02",
             "Breakage/is_active=false")
    words = [spall, "run", case, "--out", first, "--threads", 1]
    for setting in short:
        words += ["--set", setting]
    spall_run(words, timeout=1000)
    shutil.copytree(first / "shapes", state / "shapes")
    shutil.copy(first / "particles.csv", state)

    def go(name):
        out = root / name
        spall_run([spall, "run", case, "--out", out, "--threads", 1,
                   "--preparations", root / "kept",
                   "--set", f"Filling/particles={state}",
                   *(word for setting in short
                     for word in ("--set", setting))], timeout=1000)
        return out

    faults = same_particles(first, go("second"))
    if len(summary(root / "second")["filling"]["layers"]) != 1:
        faults.append("placed particles are not one layer")
    if taken(root / "second") or not taken(go("third")):
        faults.append("the filling was not kept")
    if (root / "second" / "particles.csv").read_bytes() != \
            (root / "third" / "particles.csv").read_bytes():
        faults.append("the end differs after a filling from a file")
    shape = sorted((state / "shapes").iterdir())[0]
    shape.write_text(shape.read_text().replace('"source"', '"origin"'))
    if taken(go("fourth")):
        faults.append("the filling of another shape file was taken")
    return faults


def subgrade_run(spall, root):
    """Spheres that lie on the ground already."""
    case = write_prm(root / "case.prm", subgrade.changed(
        Pulse={"rest": 0.01, "frequency": 200}, Subgrade={"cell_size": 0.1},
        Record={"stress_depths": ""}))
    first = root / "first"
    spall_run([spall, "run", case, "--out", first, "--threads", 1],
              timeout=1000)
    second = again(spall, case, root / "second", first, "Layer")
    faults = same_particles(first, second)
    depth = [max(float(row[table(out)[0].index("z")]) for row in table(out)[1])
             for out in (first, second)]
    # Friction while they are poured is lower than before: they may slip a bit.
    return faults + near("top of the layer", depth[1], depth[0], 0.05)


def triaxial_run(spall, root):
    """A specimen is compacted from the end of another one, where it is at
    once."""
    first, second = root / "first", root / "second"
    short = ("Loading/frequency=400", "Loading/cycles=1")
    run(spall, first, "rigid", settings=short)
    run(spall, second, "rigid",
        settings=(*short, "Breakage/is_active=false",
                  f"Specimen/particles={first}"))
    faults = same_particles(first, second)
    # As dense as the load has left it, but for the friction of the compaction.
    return faults + near("porosity", summary(second)["initial_porosity"],
                         summary(first)["porosity_end_1"], 0.05)


HEADER = "x,y,z,radius\n"
OVERLAP = HEADER + "0,0,0.02,0.015\n0.02,0,0.02,0.015\n"
BELOW = HEADER + "0,0,0.012,0.015\n"


def refused(spall, root, name, case, particles, words):
    file = root / f"{name}.csv"
    file.write_text(particles)
    said = spall_run([spall, "check", case[0], "--set",
                      f"{case[1]}/particles={file}"], status=1).stderr.strip()
    faults = [f"{name}: {said}: must have '{word}'"
              for word in words if word not in said]
    return faults + ([f"{name}: {said}"] if "\n" in said else [])


def bad_input(spall, root):
    """One clear line with both names, or what the file must have."""
    drum_case = write_prm(root / "drum.prm", DRUM), "Charge"
    layer = write_prm(root / "subgrade.prm", subgrade.SCENE), "Layer"
    filling = compaction.write_case(root, "rigid"), "Filling"
    faults = []
    for case in (drum_case, layer, filling):
        faults += refused(spall, root, f"overlap_{case[1]}", case, OVERLAP,
                          [".csv:2: overlaps", ".csv:3 by 0.6667",
                           f"{case[1]}/largest_overlap = 0.05"])
    faults += refused(spall, root, "outside", drum_case,
                      HEADER + "0,0,-0.19,0.02\n",
                      [".csv:2: overlaps the drum by 0.5"])
    for case in (layer, filling):
        faults += refused(spall, root, f"below_{case[1]}", case, BELOW,
                          [".csv:2: overlaps the plane", "by 0.2"])
        faults += refused(spall, root, f"material_{case[1]}", case,
                          "x,y,z,radius,material\n0,0,0.02,0.015,other\n",
                          [".csv:2: material other: must be particle"])
    (root / "no_run").mkdir()
    said = spall_run([spall, "check", drum_case[0], "--set",
                      f"Charge/particles={root / 'no_run'}"], status=1).stderr
    if "must be that of a run that has ended" not in said:
        faults.append(f"no run: {said}")
    return faults


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        tests = {"drum": drum, "compaction": compaction_run,
                 "subgrade": subgrade_run, "triaxial": triaxial_run,
                 "input": bad_input}
        sys.exit(report_faults(tests[sys.argv[2]](sys.argv[1],
                                                  pathlib.Path(temporary))))
