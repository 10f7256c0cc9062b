#!/usr/bin/env python3
"""spall bench: scenes and files do what they say; nothing is timed here.

    bench.py SPALL
"""
import gzip
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAKER = ROOT / "tests" / "benchmark" / "make_packing.py"
SHAPES = ROOT / "data" / "shapes" / "limestone_blocky"


def bench(spall, folder, packing, *words):
    result = folder / "bench.json"
    subprocess.run([spall, "bench", "--packing", str(packing), "--json",
                    str(result), "--steps", "20", *words], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads(result.read_text())


def checksum(found):
    return found["median"]["checksum"]


def sphere_faults(spall, folder):
    """The lattice as made, compressed, on two threads, and its scenes."""
    packing = folder / "lattice.csv"
    subprocess.run([sys.executable, "-B", MAKER, "250", packing], check=True,
                   stdout=subprocess.DEVNULL)
    with open(packing, "rb") as plain, gzip.open(f"{packing}.gz",
                                                 "wb") as packed:
        shutil.copyfileobj(plain, packed)
    rest = bench(spall, folder, packing, "--settle", "50")
    checks = {
        "number of particles": rest["particles"] == 250,
        "dense": 4. < rest["coordination_1"] < 6.,
        "no kinetic energy to speak of":
            rest["median"]["energy_after"]["kinetic_J"] < 1e-3,
        "gzip": checksum(rest) == checksum(bench(
            spall, folder, f"{packing}.gz", "--settle", "50")),
        "two threads": checksum(rest) == checksum(bench(
            spall, folder, packing, "--settle", "50", "--threads", "2")),
        "repeats": bench(spall, folder, packing, "--settle", "0", "--repeat",
                         "3")["reproducible"],
    }
    # 0.05 v^2 per kilogram, all particles at once.
    jolt = bench(spall, folder, packing, "--settle", "50", "--scene", "jolt")
    checks["jolt"] = jolt["median"]["energy_before"]["kinetic_J"] > 1e-3
    flow = bench(spall, folder, packing, "--settle", "50", "--scene",
                 "collapse")
    checks["collapse"] = (flow["median"]["walls_after"]
                          < rest["median"]["walls_after"])
    return [name for name, is_good in checks.items() if not is_good]


def shape_faults(spall, folder):
    """Five particles with shapes: the box closes, and its file gives the same."""
    packing, closed = folder / "five.csv", folder / "closed.csv"
    rows = ["0.03,0.03,0.03", "0.01,0.01,0.01", "0.05,0.05,0.05",
            "0.01,0.05,0.03", "0.05,0.01,0.03"]
    packing.write_text("# box 0.06 0.06 0.06\nx,y,z,radius\n"
                       + "".join(row + ",0.01\n" for row in rows))
    shapes = ("--shapes", str(SHAPES), "--breakage")
    first = bench(spall, folder, packing, *shapes, "--save", str(closed))
    second = bench(spall, folder, closed, *shapes)
    checks = {
        "box is closed": max(first["box_m"]) < 0.06,
        "box is told": first["closed"]["steps"] > 0,
        "all may break": first["breakable"] == 5,
        "closed packing gives the same": checksum(first) == checksum(second),
        "and is not closed again": "closed" not in second,
    }
    even, joined = folder / "four.csv", folder / "joined.csv"
    rows = closed.read_text().splitlines()
    even.write_text("\n".join(rows[:6]) + "\n")  # box, names, four particles
    many = bench(spall, folder, even, *shapes, "--copies", "2", "--save",
                 str(joined))
    again = bench(spall, folder, joined, *shapes)
    checks |= {
        "eight copies": many["particles"] == 8 * 4,
        "copies are pressed": many["closed"]["steps"] > 0,
        "joined packing gives the same": checksum(many) == checksum(again),
    }
    return ["shapes: " + name for name, is_good in checks.items()
            if not is_good]


def main():
    spall = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        faults = sphere_faults(spall, folder) + shape_faults(spall, folder)
    for fault in faults:
        print(f"wrong: {fault}")
    print(f"bench: {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
