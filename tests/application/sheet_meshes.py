#!/usr/bin/env python3
"""The small triaxial test with its membrane from a file of gmsh: equal quads
give the exchange of the case without a file, a finer middle closes the books.

    sheet_meshes.py SPALL
"""
import pathlib
import subprocess
import sys
import tempfile

from test_meshes import box_sheet
from triaxial_runs import (ENVIRONMENT, command, differing, report_faults, run,
                           summary, summary_faults)

SHORT = ("Loading/frequency=1000", "Loading/cycles=2",
         "Loading/consolidation_time=6e-3",
         "Loading/consolidation_stress_tolerance=0.5",
         "Loading/consolidation_unbalanced_ratio=0.1",
         "Output/frames_per_cycle=0")


def closed_faults(name, found):
    """Explicit steps of all together: measured 4e-5 and 4e-14."""
    residual = abs(found["energy_residual_ratio_1"])
    energy_error = found["interface"]["work_residual_1"]
    print(f"{name}: energy {residual:.1e}, interface energy error {energy_error:.1e}")
    return [] if residual < 1e-3 and energy_error < 1e-6 else [
        f"{name}: energy {residual}, interface energy error {energy_error}"]


def equal_faults(mine, its):
    faults = [f"{key}: {mine[key]}, {its[key]} without a file"
              for key in ("exchange_gain_1", "exchange_gain_limit_1")
              if abs(mine[key] / its[key] - 1.) > 1e-9]
    # Particle positions diverge with time, as nodes have other numbers.
    peak = "peak_axial_stress_Pa"
    return faults + ([] if abs(mine[peak] / its[peak] - 1.) < 0.1 else [
        f"peak {mine[peak]}, {its[peak]} without a file"])


def resume_faults(spall, root, store, settings):
    """Goes on with the same file alone, whatever its name."""
    mesh, whole, cut = root / "fine.msh", root / "fine", root / "cut"
    run(spall, cut, "membrane", "--until", "1", *store, settings=settings)
    text = mesh.read_text()
    (root / "same.msh").write_text(text)
    mesh.write_text(text.replace("0.45", "0.46"))
    refused = subprocess.run(
        command(spall, cut, "membrane", "--resume", settings=settings),
        capture_output=True, text=True, check=False, env=ENVIRONMENT)
    faults = []
    if refused.returncode != 1 or \
            "contents of Boundary/mesh" not in refused.stderr:
        faults.append(f"a changed mesh: {refused.stderr}")
    run(spall, cut, "membrane", "--resume", settings=(
        *settings, f"Boundary/mesh={root / 'same.msh'}"))
    faults += [f"{name} differs after a restart" for name in
               differing(cut, whole, ["history.csv", "ledger.csv"])]
    return faults + summary_faults(summary(cut), summary(whole))


def main():
    spall = str(pathlib.Path(sys.argv[1]).resolve())
    even = [k / 8 for k in range(9)]
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        (root / "even.msh").write_text(box_sheet(even, even))
        (root / "fine.msh").write_text(box_sheet(
            even, [0., 0.15, 0.3, 0.375, 0.45, 0.525, 0.6, 0.675, 0.85, 1.]))
        store = ("--preparations", str(root / "store"))
        found = {}
        for kind in ("own", "even", "fine"):
            mesh = "" if kind == "own" else root / f"{kind}.msh"
            run(spall, root / kind, "membrane", *store,
                settings=(*SHORT, f"Boundary/mesh={mesh}"))
            found[kind] = summary(root / kind)
        faults = equal_faults(found["even"], found["own"])
        for kind, summed in found.items():
            faults += closed_faults(kind, summed)
            if summed["preparation"]["is_taken"] != (kind != "own"):
                faults.append(f"{kind}: the specimen is not shared")
        # Nodes of the finer middle are lighter.
        if not found["fine"]["exchange_gain_1"] > \
                1.2 * found["own"]["exchange_gain_1"]:
            faults.append(f"gain {found['fine']['exchange_gain_1']}")
        faults += resume_faults(spall, root, store, (
            *SHORT, f"Boundary/mesh={root / 'fine.msh'}"))
    return report_faults(faults)


if __name__ == "__main__":
    sys.exit(main())
