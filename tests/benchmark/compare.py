#!/usr/bin/env python3
"""Two builds in turn on the same scenes, and their ratios.

    compare.py BEFORE_BUILD AFTER_BUILD [--packing P.csv] [--repeat N]
               [--steps N] [--scenes rest,jolt,collapse] [--threads 1]
               [--shapes DIR] [--geometry G] [--breakage]

A BUILD is a build folder or the program itself. Without --packing a lattice
of 5000 particles is made (make_packing.py). The builds run ABAB..., so that a
slow minute of the machine falls on both; the ratio is that of the medians of
the contact updates per CPU second, its spread that of the ratios of the
single turns. With --shapes the box is closed once, by the first build.
"""
import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile

from bench_runs import bench, spread, table

HERE = pathlib.Path(__file__).resolve().parent


def program(path):
    """The program of a build folder."""
    path = pathlib.Path(path).resolve()
    return path / "apps" / "spall" if path.is_dir() else path


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("before", type=program)
    parser.add_argument("after", type=program)
    parser.add_argument("--packing", type=pathlib.Path)
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--scenes", default="rest,jolt,collapse")
    parser.add_argument("--threads", default="1")
    parser.add_argument("--shapes")
    parser.add_argument("--geometry")
    parser.add_argument("--breakage", action="store_true")
    return parser.parse_args()


def packing_for(options, folder):
    """The packing both builds read, with its box closed for shapes."""
    packing = options.packing
    if packing is None:
        packing = folder / "lattice.csv"
        subprocess.run([sys.executable, HERE / "make_packing.py", "5000",
                        packing], check=True)
    if not options.shapes:
        return packing
    closed = folder / "closed.csv"
    bench(options.before, packing, *shape_words(options), "--save", closed,
          "--steps", 1, "--settle", 0)
    return closed


def shape_words(options):
    words = ["--shapes", options.shapes] if options.shapes else []
    return words + (["--geometry", options.geometry] if options.geometry else [])


def compare(options, packing, scene, threads):
    """A row: ratio of rates, after over before."""
    words = ["--scene", scene, "--steps", options.steps]
    words += shape_words(options)
    words += ["--breakage"] if options.breakage else []
    found = {options.before: [], options.after: []}
    for _ in range(options.repeat):
        for spall, runs in found.items():
            runs.append(bench(spall, packing, *words, threads=threads))
    rates = [[run["median"]["updates_per_cpu_s"] for run in runs]
             for runs in found.values()]
    turns = [after / before for before, after in zip(*rates)]
    middle = [statistics.median(one) for one in rates]
    ends = [runs[0]["median"]["checksum"] for runs in found.values()]
    return [scene, threads, *(f"{1e-6 * rate:.3f} ± {100 * spread(one):.0f} %"
                              for rate, one in zip(middle, rates)),
            f"{middle[1] / middle[0]:.3f}",
            f"{min(turns):.3f} to {max(turns):.3f}",
            "yes" if ends[0] == ends[1] else "no"]


def main():
    options = arguments()
    if options.before == options.after:
        raise SystemExit("compare.py: the two builds are one")
    with tempfile.TemporaryDirectory() as name:
        packing = packing_for(options, pathlib.Path(name))
        rows = [compare(options, packing, scene, threads)
                for scene in options.scenes.split(",")
                for threads in map(int, options.threads.split(","))]
    print(table(["scene", "threads", "before, M updates/CPU-s", "after",
                 "after / before", "single turns", "same bits"], rows))


if __name__ == "__main__":
    main()
