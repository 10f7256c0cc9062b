#!/usr/bin/python3
"""Spall beside LIGGGHTS, LAMMPS and Yade: the same packings, in turn.

    peers.py SPALL [--peers FOLDER] [--sizes 5k,30k] [--threads 1,2]
             [--scenes rest,jolt,collapse] [--codes liggghts,spall]
             [--ranks] [--repeat N] [--scale F] [--json FILE]

FOLDER (../shared/peers) has the packings and the inputs of the peers. A code
that is not installed is left out with a line. Needs numpy and scipy.
LIGGGHTS and LAMMPS have as many MPI ranks as --threads says, Spall threads;
with --ranks it has ranks, too.

The rate of a run is its contact updates (touching pairs and walls, counted by
one tool from the positions at both ends of the timed steps; Spall: its own
count) over its CPU time, user and system, of all ranks or threads. Wall time
is only good on an idle machine.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

from bench_runs import bench, group, spread, table
from peer_inputs import box_of, command, packing_file, write_input

PROGRAMS = {"liggghts": "liggghts", "lammps": "lmp", "yade": "yade"}
# Some seconds each.
STEPS = {("liggghts", "5k"): 4000, ("liggghts", "30k"): 600,
         ("lammps", "5k"): 3000, ("lammps", "30k"): 500,
         ("yade", "5k"): 600, ("yade", "30k"): 80,
         ("spall", "5k"): 4000, ("spall", "30k"): 600}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("spall", type=pathlib.Path)
    root = pathlib.Path(__file__).resolve().parents[2]
    parser.add_argument("--peers", type=pathlib.Path,
                        default=root.parent / "shared" / "peers")
    for name, default in (("sizes", "5k,30k"), ("threads", "1,2"),
                          ("scenes", "rest,jolt,collapse"),
                          ("codes", "liggghts,lammps,yade,spall")):
        parser.add_argument("--" + name, default=default)
    parser.add_argument("--ranks", action="store_true",
                        help="Spall runs on ranks, not threads")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--scale", type=float, default=1.,
                        help="more or fewer steps than usual")
    parser.add_argument("--json", type=pathlib.Path, help="all runs")
    return parser.parse_args()


def present(codes):
    found = []
    for code in codes:
        if code != "spall" and not shutil.which(PROGRAMS[code]):
            print(f"{code}: not installed, left out", file=sys.stderr)
        else:
            found.append(code)
    return found


def contacts_in(peers, path, box):
    """Touching pairs and walls of a state that a peer has written."""
    sys.path.insert(0, str(peers / "tools"))
    import numpy
    from packing import pairs
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            if line.startswith("ITEM: ATOMS"):
                break
        state = numpy.loadtxt(lines)
    x, r = state[:, 1:4], state[:, 4]
    i, j = pairs(x, r).T
    touching = numpy.linalg.norm(x[i] - x[j], axis=1) < r[i] + r[j]
    walls = (r[:, None] > x).sum() + (x + r[:, None] > box).sum()
    return int(touching.sum()) + int(walls)


def stamps(path):
    """Differences between both stamps, and the peak memory [MB]."""
    ends = []
    for line in path.read_text().splitlines()[-2:]:
        words = line.split()
        ends.append({words[k]: float(words[k + 1]) for k in range(1, 11, 2)}
                    | {"peak": max(map(int, words[12:])) * 1.024e-3})
    return ({key: ends[1][key] - ends[0][key] for key in ends[0]}
            | {"peak": ends[1]["peak"]})


def rebuilds(code, log):
    if code == "yade":
        return int(re.search(r"^BUILDS (\d+)", log, re.M)[1])
    # One line per run; the last is a run of no steps for the final state.
    return int(re.findall(r"Neighbor list builds = (\d+)", log)[-2])


def run_peer(peers, code, size, scene, threads, steps):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        path = write_input(peers, code, size, scene, folder)
        ended = subprocess.run(
            command(peers, code, size, scene, threads, steps, path),
            cwd=folder, capture_output=True, text=True, check=False,
            env={**os.environ, "OMP_NUM_THREADS": str(threads)})
        if not (folder / "run.dump").exists():
            raise SystemExit(f"{code}, {size}, {scene}: failed\n"
                             + (ended.stdout + ended.stderr)[-2000:])
        box = box_of(size, scene)
        contacts = [contacts_in(peers, folder / f"run.{end}", box)
                    for end in ("begin", "dump")]
        spent = stamps(folder / "run.stamp")
        log = ended.stdout + ended.stderr
    return {"cpu_s": spent["user"] + spent["sys"], "wall_s": spent["wall"],
            "contacts": statistics.mean(contacts),
            "rebuilds": rebuilds(code, log), "peak_MB": spent["peak"]}


def run_spall(options, size, scene, threads, steps):
    cores = {"ranks": threads} if options.ranks else {"threads": threads}
    found = bench(options.spall, packing_file(options.peers, size), "--scene",
                  scene, "--steps", steps, **cores)
    sample = found["median"]
    return {"cpu_s": sample["cpu_s"], "wall_s": sample["wall_s"],
            "contacts": sample["updates"] / sample["steps"],
            "rebuilds": sample["rebuilds"], "phases_s": sample["phases_s"],
            "peak_MB": 1e-6 * found["memory_bytes"]["peak"]}


def run_all(options):
    """One row per run; the codes take turns."""
    rows, codes = [], present(options.codes.split(","))
    cases = [(size, scene, int(threads))
             for size in options.sizes.split(",")
             for scene in options.scenes.split(",")
             for threads in options.threads.split(",")]
    for repeat in range(options.repeat):
        for size, scene, threads in cases:
            for code in codes:
                steps = max(1, round(options.scale * STEPS[code, size]))
                case = (size, scene, threads, steps)
                found = (run_spall(options, *case)
                         if code == "spall"
                         else run_peer(options.peers, code, *case))
                rows.append({"code": code, "size": size, "scene": scene,
                             "threads": threads, "steps": steps,
                             "repeat": repeat, **found})
                row = rows[-1]
                row["rate"] = row["contacts"] * steps / row["cpu_s"]
                print(f"{code} {size} {scene} x{threads}: "
                      f"{1e-6 * row['rate']:.2f} M/CPU-s", file=sys.stderr)
    return rows


def summary(rows):
    """Medians over the repeats, with ratios to LIGGGHTS."""
    lines, reference = [], {}
    for key, runs in group(rows, "size", "scene", "threads", "code").items():
        middle = {name: statistics.median(run[name] for run in runs)
                  for name in ("rate", "contacts", "peak_MB")}
        middle["steps"] = statistics.median(run["steps"] / run["cpu_s"]
                                            for run in runs)
        middle["wall"] = statistics.median(
            run["contacts"] * run["steps"] / run["wall_s"] for run in runs)
        reference[key] = middle
        base = reference.get((*key[:3], "liggghts"))
        alone = reference.get((*key[:2], 1, key[3]))
        lines.append([
            *key[:2], key[2], key[3], f"{middle['contacts']:.0f}",
            f"{1e-6 * middle['rate']:.2f} ± "
            f"{100 * spread([run['rate'] for run in runs]):.0f} %",
            f"{middle['rate'] / base['rate']:.2f}" if base else "",
            f"{middle['steps'] / base['steps']:.2f}" if base else "",
            f"{1e-6 * middle['wall']:.2f}",
            f"{middle['wall'] / alone['wall']:.2f}" if alone else "",
            f"{1e3 * runs[0]['rebuilds'] / runs[0]['steps']:.1f}",
            f"{middle['peak_MB']:.0f}"])
    return table(["packing", "scene", "threads", "code", "contacts",
                  "million updates per CPU second", "to LIGGGHTS",
                  "steps to LIGGGHTS", "per wall second", "to one",
                  "rebuilds per 1000 steps", "peak MB"], lines)


def main():
    options = arguments()
    if not (options.peers / "liggghts" / "in.peer").exists():
        print(f"{options.peers}: no inputs of the peers here: skipped")
        return 77
    rows = run_all(options)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")
    print(summary(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
