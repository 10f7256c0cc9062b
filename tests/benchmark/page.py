#!/usr/bin/python3
"""Renews the tables of the pages of docs/performance.

    page.py SPALL [--only NAME ...] [--peers FOLDER] [--quick]

Each table stands between <!-- begin NAME --> and <!-- end NAME --> and is
replaced: peers, scenes, particles, sizes, threads, instructions. What needs the
packings of ../shared/peers is left as it is where they are missing.
--quick: a quarter of the steps, one repeat, sizes to 10 000.
"""
import argparse
import pathlib
import platform
import re
import subprocess
import sys
import tempfile

from bench_runs import bench, table

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PAGES = ROOT / "docs" / "performance"
SHAPES = ROOT / "data" / "shapes" / "limestone_blocky"


def output(script, *words):
    """What one of the scripts here prints."""
    return subprocess.run([sys.executable, "-B", HERE / script,
                           *map(str, words)], check=True, text=True,
                          stdout=subprocess.PIPE).stdout.strip()


def lattice(folder, count):
    path = pathlib.Path(folder) / f"lattice_{count}.csv"
    if not path.exists():
        output("make_packing.py", count, path)
    return path


def row_of(found):
    """The figures that most tables show."""
    sample, phases = found["median"], found["median"]["phases_s"]
    share = [f"{100 * phases[name] / sample['wall_s']:.0f}"
             for name in ("contacts", "search", "breakage", "motion")]
    return [f"{sample['updates'] / sample['steps']:.0f}",
            sample["listed_pairs"],
            f"{1e-6 * sample['updates_per_cpu_s']:.2f}",
            f"{sample['cpu_ns_per_update']:.0f}",
            f"{1e9 * sample['cpu_s'] / sample['steps'] / found['particles']:.0f}",
            " / ".join(share),
            f"{1e3 * sample['rebuilds'] / sample['steps']:.1f}"]


ROW = ["contacts", "listed pairs", "million updates per CPU second",
       "ns per update", "ns per particle and step",
       "contacts / search / breakage / motion, %", "rebuilds per 1000 steps"]


def peers_table(options, _):
    """One thread; two threads and the large packing at rest only."""
    calls = [["--sizes", "5k", "--threads", 1, "--repeat", 3],
             ["--sizes", "30k", "--threads", 1, "--scenes", "rest"],
             ["--threads", 2, "--scenes", "rest",
              "--codes", "liggghts,lammps,spall"]]
    if options.quick:
        calls = [[*calls[0], "--scale", 0.25, "--repeat", 1]]
    lines = []
    for words in calls:
        found = output("peers.py", options.spall, "--peers", options.peers,
                       *words).splitlines()
        lines += found[2:] if lines else found
    return "\n".join(lines)


def scenes_table(options, _):
    rows = []
    for size in ("5k", "30k"):
        packing = next(options.peers.glob(f"packing_{size}.csv*"))
        steps = {"5k": 2000, "30k": 300}[size] // (4 if options.quick else 1)
        for scene in ("rest", "jolt", "collapse"):
            found = bench(options.spall, packing, "--scene", scene, "--steps",
                          steps, "--repeat", 1 if options.quick else 3)
            rows.append([size, scene, *row_of(found)])
    return table(["packing", "scene", *ROW], rows)


def particles_rows(options, label, packing, steps, folder, settle=()):
    """Spheres, and particles at their positions once the box is closed round them."""
    name = packing.name.removesuffix(".gz")
    closed = pathlib.Path(folder) / f"closed_{name}"
    shapes, rows = ["--shapes", SHAPES], []
    bench(options.spall, packing, *shapes, "--save", closed, "--steps", 1,
          "--settle", 0)
    for name, path, words in (("spheres", packing, []),
                              ("particles", closed, [*shapes, *settle]),
                              ("particles, breakage on", closed,
                               [*shapes, *settle, "--breakage"])):
        found = bench(options.spall, path, *words, "--steps", steps,
                      "--repeat",
                      1 if options.quick or "--settle" in words else 3)
        rows.append([label, name, f"{found['solid_fraction_1']:.3f}",
                     f"{found['coordination_1']:.2f}", *row_of(found),
                     f"{found['median']['steps_per_s']:.0f}",
                     f"{found['memory_bytes']['per_particle_run']:.0f}"])
    return rows


def particles_table(options, folder):
    rows = particles_rows(options, "lattice, 5 000", lattice(folder, 5000),
                       300 if options.quick else 1000, folder)
    graded = list(options.peers.glob("packing_30k.csv*"))
    if graded and not options.quick:
        # Small particles fall for a tenth of a second until they lie.
        rows += particles_rows(options, "graded, 30k", graded[0], 300, folder,
                            ["--settle", 25000])
    return table(["packing", "particles", "solid fraction", "coordination number",
                  *ROW, "steps per second", "bytes per particle"], rows)


def sizes_table(options, folder):
    rows = []
    for count in (1000, 10000, 100000, 1000000)[:2 if options.quick else 4]:
        steps = max(10, 3000000 // count)
        found = bench(options.spall, lattice(folder, count), "--steps", steps,
                      "--settle", 50)
        memory = found["memory_bytes"]
        rows.append([found["particles"], *row_of(found),
                     f"{found['median']['steps_per_s']:.2f}",
                     f"{memory['per_particle_run']:.0f}",
                     f"{memory['per_particle_peak']:.0f}"])
    return table(["spheres on a lattice", *ROW, "steps per second",
                  "bytes per particle", "at the peak"], rows)


def threads_table(options, folder):
    rows = []
    for count in (500, 1000, 2000, 5000, 30000):
        path, steps = lattice(folder, count), max(200, 6000000 // count)
        ends = [bench(options.spall, path, "--steps", steps, "--settle", 50,
                      "--repeat", 1 if options.quick else 3, threads=threads)
                for threads in (1, 2)]
        speeds = [end["median"]["steps_per_s"] for end in ends]
        rows.append([ends[0]["particles"],
                     *(f"{speed:.1f}" for speed in speeds),
                     f"{speeds[1] / speeds[0]:.2f}",
                     "yes" if ends[0]["median"]["checksum"]
                     == ends[1]["median"]["checksum"] else "NO"])
    return table(["spheres on a lattice", "steps per wall second, 1 thread",
                  "2 threads", "ratio", "same bits"], rows)


def instructions_table(options, _):
    return output("instructions.py", options.spall, "--rows", 12)


TABLES = {"peers": peers_table, "scenes": scenes_table,
          "particles": particles_table, "sizes": sizes_table,
          "threads": threads_table, "instructions": instructions_table}
NEEDS_PEERS = {"peers", "scenes"}


def machine():
    """What the tables were measured on, one line."""
    text = pathlib.Path("/proc/cpuinfo").read_text(encoding="ascii")
    model = re.search(r"^model name\s*:\s*(.*)$", text, re.M)
    cores = len(re.findall(r"^processor", text, re.M))
    return f"{model[1] if model else platform.processor()}, {cores} CPUs"


def replace(name, text):
    """Puts a table between its marks, in the page that has them."""
    pattern = rf"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)"
    for path in sorted(PAGES.glob("*.md")):
        page, n = re.subn(pattern, lambda m: m[1] + text + "\n" + m[2],
                          path.read_text(encoding="utf-8"), flags=re.S)
        if n == 1:
            path.write_text(page, encoding="utf-8")
            return
    raise SystemExit(f"{PAGES}: no marks for the table {name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("spall", type=pathlib.Path)
    parser.add_argument("--only", nargs="*", choices=TABLES, default=TABLES)
    parser.add_argument("--peers", type=pathlib.Path,
                        default=ROOT.parent / "shared" / "peers")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    options.spall = options.spall.resolve()
    with tempfile.TemporaryDirectory() as folder:
        for name in options.only:
            if name in NEEDS_PEERS and not options.peers.is_dir():
                print(f"{name}: no {options.peers}, left as it is")
                continue
            text = TABLES[name](options, folder)
            replace(name, f"Measured on: {machine()}.\n\n{text}")
            print(f"{name}\n{text}\n", flush=True)


if __name__ == "__main__":
    main()
