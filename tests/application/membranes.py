#!/usr/bin/env python3
"""The triaxial test with a neo-Hookean membrane under tension, explicit and
implicit, and with quads halved where particles press. Energy and ledger close,
and implicit steps find what explicit ones find.

    membranes.py SPALL
"""
import pathlib
import sys
import tempfile

from triaxial_runs import report_faults, run, summary

SHORT = ("Loading/frequency=1000", "Loading/cycles=1",
         "Loading/consolidation_time=2e-3")
RUBBER = ("Membrane/law=neo_hooke", "Membrane/poisson_ratio=0.5",
          "Membrane/tension=100")
IMPLICIT = ("Coupling/exchange=one_pass", "Coupling/body_time=implicit")
# Small quads fold where the pressure comes on within a millisecond.
HALVED = ("Boundary/refined=pressed", "Loading/consolidation_time=4e-3")
# Explicit steps of all together lose no work; one pass is of third order.
KINDS = {"plain": ((), 1e-3, 1e-6), "halved": (HALVED, 1e-3, 1e-6),
         "rubber": (RUBBER, 1e-3, 1e-6),
         "implicit_rubber": (IMPLICIT + RUBBER, 1e-2, 1e-2)}
# Peaks of the same membrane; particle positions diverge with time.
PAIRS = (("implicit_rubber", "rubber"),)
NEAR = 0.1


def main():
    spall = sys.argv[1]
    faults, peak, quads, gain = [], {}, {}, {}
    with tempfile.TemporaryDirectory() as name:
        for kind, (settings, energy, ledger) in KINDS.items():
            folder = pathlib.Path(name) / kind
            run(spall, folder, "membrane", settings=(*SHORT, *settings))
            found = summary(folder)
            peak[kind] = found["peak_axial_stress_Pa"]
            quads[kind] = found["n_membrane_quads"]
            gain[kind] = found["exchange_gain_1"]
            residual = abs(found["energy_residual_ratio_1"])
            energy_error = found["interface"]["work_residual_1"]
            print(f"{kind}: peak {peak[kind]:.0f} Pa, energy {residual:.1e}, "
                  f"interface energy error {energy_error:.1e}")
            if residual > energy:
                faults.append(f"{kind}: energy residual {residual} > {energy}")
            if energy_error > ledger:
                faults.append(f"{kind}: interface energy error {energy_error} > {ledger}")
    faults += [f"{one}: peak {peak[one]} Pa, {other} {peak[other]} Pa"
               for one, other in PAIRS
               if abs(peak[one] / peak[other] - 1.) > NEAR]
    halved = quads["halved"] - quads["plain"]
    if halved <= 0 or halved % 3 or quads["halved"] >= 4 * quads["plain"]:
        faults.append(f"halved: {quads['halved']} quads of {quads['plain']}")
    # The step is chosen as if all were halved: a quarter of the mass of a node.
    if gain["halved"] < 3. * gain["plain"]:
        faults.append(f"halved: gain {gain['halved']} of {gain['plain']}")
    return report_faults(faults)


if __name__ == "__main__":
    sys.exit(main())
