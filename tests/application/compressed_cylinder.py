#!/usr/bin/env python3
"""Triaxial compression of a cylinder to 10 %: both membranes, rigid side.

    compressed_cylinder.py SPALL [SECTION/KEY=VALUE ...]

A dense specimen of spheres from one preparation: stress rises to a peak or a
plateau, the volume shrinks and then grows, the energies close. What the
membrane bears is compared with what laboratories take off for it.
"""
import pathlib
import sys
import tempfile

from triaxial_runs import report_faults, rows, run, summary

CONFINEMENT = 30e3  # Pa
STRAIN, RATE = 0.1, 0.5  # -, 1/s: inertial number 1.6e-3
DIAMETER, MODULUS, THICKNESS = 0.05, 1.4e6, 1e-3  # m, Pa, m
SETTINGS = ("Specimen/form=cylinder", f"Specimen/diameter={DIAMETER}",
            "Specimen/height=0.08", "Specimen/shapes=",
            "Boundary/elements_around=24", "Contact/geometry=sphere",
            "Preparation/friction=0.1", "Particle/friction=0.6",
            "Breakage/is_active=false", "Loading/form=compression",
            f"Loading/strain_rate={RATE}", f"Loading/final_strain={STRAIN}",
            "Loading/consolidation_time=0.03", "Time/step=stable",
            "Output/samples_per_cycle=200")
VARIANTS = {"bearing": ("membrane",),
            "wrinkled": ("membrane", "Membrane/wrinkling=tension_field"),
            "rigid": ("rigid",)}


PEAK = (3., 12.)  # of the stress ratio; three specimens: 5.7 to 9.0
ENERGY = 1e-3     # of the work; measured 2e-6 to 1e-4


def smooth(values, reach=5):
    """Means over neighbours: single particles jump."""
    parts = [values[max(0, k - reach):k + reach + 1]
             for k in range(len(values))]
    return [sum(part) / len(part) for part in parts]


def curve(folder):
    """Columns of the history while it loads."""
    loading = [row for row in rows(folder, "history.csv")[1]
               if row["stage_1"] >= 2.]
    return {key: [row[key] for row in loading] for key in loading[0]}


def ratio_of(line):
    return smooth([axial / side for axial, side in
                   zip(line["axial_stress_Pa"], line["lateral_stress_Pa"])])


def promise_faults(found, line):
    """Strain and confinement are those asked for, the energies close."""
    faults = []
    if abs(line["axial_strain_1"][-1] / STRAIN - 1.) > 1e-3:
        faults.append(f"went to a strain of {line['axial_strain_1'][-1]}")
    side = sum(line["lateral_stress_Pa"]) / len(line["lateral_stress_Pa"])
    if abs(side / CONFINEMENT - 1.) > (1e-9 if found["lateral"] == "membrane"
                                       else 0.05):
        faults.append(f"mean lateral stress {side} Pa")
    if found["energy_residual_ratio_1"] > ENERGY:
        faults.append(f"energy residual {found['energy_residual_ratio_1']}")
    return faults


def curve_faults(line, is_wrinkled):
    """A dense specimen shrinks and then dilates; the peak is not at the end,
    but for a sleeve that wrinkles: it holds one of three specimens so well
    that they bear most there. Limits: half of what three specimens have at
    least, each prepared three times with sums in another order, which makes
    other specimens of them: behind the peak they lose up to 22 % in sleeves,
    21 to 46 % between rigid sides."""
    faults = []
    ratio, volume = ratio_of(line), line["volumetric_strain_1"]
    strain = line["axial_strain_1"]
    top = ratio.index(max(ratio))
    if not PEAK[0] < ratio[top] < PEAK[1]:
        faults.append(f"peak stress ratio {ratio[top]}")
    last = 1.01 * STRAIN if is_wrinkled else 0.95 * STRAIN
    if not 0.005 < strain[top] < last:
        faults.append(f"peak at a strain of {strain[top]}")
    if not (is_wrinkled or ratio[-1] < 0.99 * ratio[top]):
        faults.append(f"stress ratio {ratio[-1]} after a peak of {ratio[top]}")
    least = volume.index(max(volume))
    if not (volume[least] > 1e-3 and strain[least] < strain[top]):
        faults.append(f"shrinks by {volume[least]} to a strain of "
                      f"{strain[least]}")
    if not min(volume[least:]) < volume[least] - 4e-3:
        faults.append(f"dilates by {volume[least] - min(volume[least:])}")
    return faults


def shortening_share(line):
    """What the membrane has come to bear along the axis, mean of the last
    rows, over what a smooth elastic sleeve would: 4 E h strain / D, which
    ASTM D4767 takes off [-]."""
    stress = line["membrane_axial_stress_Pa"]
    change = sum(stress[-20:]) / 20. - stress[0]
    return change / (4. * MODULUS * THICKNESS * STRAIN / DIAMETER)


def membrane_faults(lines):
    """A tension field is never in compression, and bears less of it than a
    sheet that does not wrinkle."""
    faults = []
    for key in ("membrane_axial_stress_Pa", "membrane_lateral_stress_Pa"):
        if max(lines["wrinkled"][key]) >= 0.:
            faults.append(f"{key} up to {max(lines['wrinkled'][key])} where "
                          "it wrinkles")
    share = {name: shortening_share(line) for name, line in lines.items()}
    if not 0.15 < share["bearing"] < 1.:
        faults.append(f"bears {share['bearing']} of an elastic sleeve")
    if not share["wrinkled"] < 0.7 * share["bearing"]:
        faults.append(f"wrinkled {share['wrinkled']} of an elastic sleeve, "
                      f"bearing {share['bearing']}")
    return faults


def row_of(name, found, line):
    """For docs/results/triaxial.md."""
    ratio, volume = ratio_of(line), line["volumetric_strain_1"]
    top = ratio.index(max(ratio))
    return (f"| {name} | {ratio[top]:.2f} at {line['axial_strain_1'][top]:.3f}"
            f" | {ratio[-1]:.2f} | {max(volume):.4f} | {min(volume):.4f} | "
            f"{line['membrane_axial_stress_Pa'][0]:.0f}, "
            f"{line['membrane_axial_stress_Pa'][-1]:.0f} | "
            f"{line['membrane_lateral_stress_Pa'][-1]:.0f} | "
            f"{shortening_share(line):.2f} | "
            f"{found['energy_residual_ratio_1']:.0e} | "
            f"{found['processor_s']:.0f} |")


def main():
    spall = str(pathlib.Path(sys.argv[1]).resolve())
    more = sys.argv[2:]  # settings: another seed
    faults, lines = [], {}
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(scratch)
        for name, (lateral, *own) in VARIANTS.items():
            run(spall, root / name, lateral, "--preparations",
                str(root / "store"), settings=(*SETTINGS, *own, *more))
            found, line = summary(root / name), curve(root / name)
            faults += [f"{name}: {fault}" for fault in
                       promise_faults(found, line) +
                       curve_faults(line, name == "wrinkled")]
            print(row_of(name, found, line))
            if lateral == "membrane":
                lines[name] = line
    raise SystemExit(report_faults(faults + membrane_faults(lines)))


if __name__ == "__main__":
    main()
