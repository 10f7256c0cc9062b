#!/usr/bin/env python3
"""What the presets of each kind cost, and how far they are from `reference`.

    preset_table.py PROGRAM [--page PAGE] [--kinds KIND ...] [--seeds N]
                    [--runs FOLDER]

The presets run a shortened case of their kind with the same seeds, one thread.
Cost is processor time over that of `reference`. The error of a quantity is the
mean over the seeds of its difference from `reference`, over the standard
deviation of `reference` over the seeds. PAGE has the tables between two marks;
with --kinds those of other kinds stay as they are in FOLDER.
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile
import textwrap
from dataclasses import dataclass

from bench_runs import table

ROOT = pathlib.Path(__file__).resolve().parents[2]
MARKS = ("<!-- tables of preset_table.py -->", "<!-- end of the tables -->")
PRESETS = ("reference", "standard", "fast", "article")


@dataclass
class Kind:
    """A shortened case."""
    case: str
    seed_key: str
    text: str        # what the case is, for the page
    settings: tuple  # Section/key=value
    outcomes: dict   # of summary.json: heading by name
    presets: tuple = PRESETS


KINDS = {
    "dynamic_triaxial": Kind(
        "dynamic_triaxial_quick", "Specimen/seed",
        "226 particles between rigid sides, one load cycle of 100 kPa, "
        "fracture energy 2 kJ/m²",
        ("Specimen/side=0.065", "Specimen/initial_solid_fraction=0.2",
         "Boundary/lateral=rigid", "Coupling/exchange=none",
         "Breakage/fracture_energy=2e3", "Loading/cycles=1",
         "Loading/consolidation_unbalanced_ratio=0.01",
         "Output/frames_per_cycle=0", "Output/surfaces=none"),
        {"permanent_axial_strain_1": "permanent strain",
         "resilient_modulus_Pa": "resilient modulus (Pa)",
         "coordination_end_1": "coordination number",
         "mean_contact_force_end_N": "mean contact force (N)",
         "laa_percent": "LAA (%)"}),
    "single_particle": Kind(
        "single_particle", "Particle/seed",
        "a limestone of 30 mm pressed by 2 mm", (),
        {"peak_force_N": "largest force (N)",
         "n_events": "events", "laa_percent": "LAA (%)"}),
    "los_angeles": Kind(
        "los_angeles_quick", "Charge/seed",
        "0.5 kg of weak limestone and a steel ball, one turn",
        ("Charge/mass=0.5", "Charge/balls=1", "Charge/ball_mass=0.35",
         "Breakage/fracture_energy=1e3", "Drum/turns=1"),
        {"laa_percent": "LAA (%)", "n_events": "events",
         "roundness_1": "roundness"}),
    "vibratory_compaction": Kind(
        "vibratory_compaction_quick", "Filling/seed",
        "a container of 75 by 45 mm, blocky particles of 7 to 22 mm in one "
        "layer of 1500 kg/m³, a plate of 150 kg, two periods of vibration",
        ("Container/diameter=0.075", "Container/height=0.045",
         "Filling/gradation=gradations/quick_7_22mm.csv",
         "Filling/shapes=shapes/limestone_blocky", "Filling/layers=1",
         "Filling/density=1500", "Filling/tamper_speed=0.2",
         "Filling/unbalanced_ratio=0.02", "Plate/mass=150",
         "Vibration/eccentric_mass=0.6", "Vibration/duration=0.0625",
         "Vibration/reports=0.0625"),
        {"seating_settlement_m": "settlement under the plate (m)",
         "settlement_m": "settlement by vibration (m)",
         "coordination_end_1": "coordination number",
         "mean_contact_force_end_N": "mean contact force (N)"}),
    "subgrade": Kind(
        "subgrade_quick", "Layer/seed",
        "a layer of 0.16 by 0.16 by 0.08 m under a plate of 0.1 m on a "
        "subgrade of 1 m, one pulse of 670 N",
        ("Layer/length=0.16", "Layer/width=0.16", "Layer/thickness=0.08",
         "LoadPlate/diameter=0.1", "Subgrade/length=1", "Subgrade/width=1",
         "Pulse/cycles=1", "Pulse/amplitude=670", "Pulse/rest=0.05",
         "Record/frame_interval=0"),
        {"plate_settlement_peak_m": "settlement of the plate (m)",
         "subgrade_settlement_peak_m": "settlement of the subgrade (m)",
         "subgrade_force_peak_N": "force on the subgrade (N)",
         "coordination_end_1": "coordination number"},
        ("reference", "standard", "fast")),
}


def run(program, name, preset, seed, folder):
    """The summary, or the line with which the run stopped."""
    kind = KINDS[name]
    out = folder / f"{name}_{preset}_{seed}"
    words = [program, "run", ROOT / "data" / "cases" / f"{kind.case}.prm",
             "--out", out, "--overwrite", "--threads", "1"]
    for setting in (f"preset={preset}", "Run/threads=1",
                    *(("CycleJump/tolerance=0",)
                      if name == "dynamic_triaxial" else ()),
                    f"{kind.seed_key}={seed}", *kind.settings):
        words += ["--set", setting]
    done = subprocess.run(list(map(str, words)), stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True)
    if done.returncode:
        return done.stderr.strip().splitlines()[-1].split("; ")[0]
    return json.loads((out / "summary.json").read_text())


def error(name, found, reference):
    """Mean over the seeds, over the scatter of the reference, as a cell."""
    scatter = statistics.stdev(one[name] for one in reference)
    differences = [a[name] - b[name] for a, b in zip(found, reference)]
    mean = statistics.fmean(differences)
    if scatter == 0.:
        return "0" if mean == 0. else "no scatter"
    sure = statistics.stdev(differences) / math.sqrt(len(differences))
    return f"{mean / scatter:+.2g} ± {sure / scatter:.1g}".replace("-", "−")


def ratio(key, found, reference):
    return (sum(one[key] for one in found) /
            sum(one[key] for one in reference))


def scatter_row(kind, reference):
    cells = []
    for name in kind.outcomes:
        values = [one[name] for one in reference]
        cells.append(f"{statistics.fmean(values):.3g} ± "
                     f"{statistics.stdev(values):.2g}")
    seconds = statistics.fmean(one["loading_processor_s"] for one in reference)
    every = statistics.fmean(one["processor_s"] for one in reference)
    return [f"`{kind.presets[0]}`, mean ± scatter", f"1 ({seconds:.3g} s)",
            f"1 ({every:.3g} s)", *cells]


def preset_row(kind, preset, found, reference):
    return [f"`{preset}`",
            f"{ratio('loading_processor_s', found, reference):.2g}",
            f"{ratio('processor_s', found, reference):.2g}",
            *(error(name, found, reference) for name in kind.outcomes)]


def kind_table(program, name, n_seeds, folder):
    kind = KINDS[name]
    seeds = range(1, n_seeds + 1)
    found = {preset: [] for preset in kind.presets}
    stopped = {}
    for seed in seeds:  # in turn, so that a slow minute falls on all
        for preset in kind.presets:
            if preset in stopped:
                continue
            one = run(program, name, preset, seed, folder)
            if isinstance(one, str):
                stopped[preset] = f"seed {seed}: {one}"
            else:
                found[preset].append(one)
            print(name, preset, seed, stopped.get(preset) or
                  f"{one['processor_s']:.1f} s", file=sys.stderr, flush=True)
    reference = found[kind.presets[0]]
    rows = [scatter_row(kind, reference)]
    rows += [preset_row(kind, preset, found[preset], reference)
             for preset in kind.presets[1:] if preset not in stopped]
    said = textwrap.fill(f"{kind.text[0].upper()}{kind.text[1:]}; {n_seeds} "
                         "seeds.", 120)
    text = (f"### {name}\n\n{said}\n\n" +
            table(["preset", "cost of the test", "with the preparation",
                   *kind.outcomes.values()], rows) + "\n")
    for preset, line in stopped.items():
        text += f"\n`{preset}` stopped ({line}).\n"
    return text


def put_into(page, text):
    before, rest = page.read_text().split(MARKS[0])
    page.write_text(f"{before}{MARKS[0]}\n{text}{MARKS[1]}"
                    f"{rest.split(MARKS[1])[1]}")


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("program", type=pathlib.Path)
    words.add_argument("--page", type=pathlib.Path)
    words.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    words.add_argument("--seeds", type=int, default=3)
    words.add_argument("--runs", type=pathlib.Path)
    options = words.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = options.runs or pathlib.Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        for kind in options.kinds:
            (folder / f"{kind}.md").write_text(
                kind_table(options.program.resolve(), kind, options.seeds,
                           folder))
        parts = [folder / f"{kind}.md" for kind in KINDS]
        text = "\n".join(part.read_text() for part in parts if part.exists())
    print(text)
    if options.page:
        put_into(options.page, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
