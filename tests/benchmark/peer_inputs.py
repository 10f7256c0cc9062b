"""Inputs of the peer codes for one scene, from those of ../shared/peers.

The scenes of `spall bench`: at rest, after a jolt, and flowing out after the
wall at +x has moved to 1.6 sides (5000 steps of 4e-6 s before the warm-up).
Each input is changed in three respects only: it writes down its state when the
timed steps begin, and a collapse has its wall elsewhere and flows first.
"""
import pathlib
import subprocess

SIDES = {"5k": 0.1651, "30k": 0.3}
WIDER = 1.6
FLOW_STEPS, FLOW_STEP = 5000, 4e-6


def packing_file(peers, size):
    for ending in (".csv", ".csv.gz"):
        path = peers / f"packing_{size}{ending}"
        if path.exists():
            return path
    raise SystemExit(f"{peers}: no packing_{size}.csv")


def box_of(size, scene):
    """Upper corner of the box [m]."""
    side = SIDES[size]
    return (WIDER * side if scene == "collapse" else side, side, side)


def replaced(text, old, new):
    if old not in text:
        raise SystemExit(f"input of the peer has changed: no \"{old}\"")
    return text.replace(old, new)


def liggghts_input(text, width, is_flowing):
    text = replaced(
        text, "# ---- timed",
        "dump b all custom 1 ${tag}.begin id x y z radius\n"
        'dump_modify b sort id format "%d %.12g %.12g %.12g %.12g"\n'
        "run 0\nundump b\n# ---- timed")
    if is_flowing:
        text = replaced(text, "xplane ${side}", f"xplane {width}")
    return text


def lammps_input(text, width, is_flowing):
    text = replaced(
        text, "# ---- timed",
        "write_dump all custom ${tag}.begin id x y z radius modify sort id "
        "format float %.12g\n# ---- timed")
    if is_flowing:
        text = replaced(text, "xplane 0.0 ${side}", f"xplane 0.0 {width}")
    return text


YADE_STATE = """
def write_begin():
    with open(a["tag"] + ".begin", "w") as f:
        f.write("ITEM: ATOMS id x y z radius\\n")
        for b in O.bodies:
            if isinstance(b.shape, Sphere):
                p = b.state.pos
                f.write(f"{b.id+1} {p[0]:.12g} {p[1]:.12g} {p[2]:.12g} "
                        f"{b.shape.radius:.12g}\\n")


write_begin()
stamp("begin")
"""


def yade_input(text, width, is_flowing):
    text = replaced(text, '\nstamp("begin")\n', YADE_STATE)
    if is_flowing:
        text = replaced(text, "(side, side, side)", f"({width}, side, side)")
        text = replaced(text, "if warm:\n",
                        f"O.dt = {FLOW_STEP}\nO.run({FLOW_STEPS}, True)\n"
                        "O.dt = dt\nif warm:\n")
    return text


def flow_first(text):
    """LIGGGHTS and LAMMPS: the collapse comes into flow."""
    return replaced(text, "run             ${warm}",
                    f"timestep {FLOW_STEP}\nrun {FLOW_STEPS}\n"
                    "timestep ${dt}\nrun ${warm}")


def write_input(peers, code, size, scene, folder):
    """Writes the input of this code into the folder; returns its path."""
    name = "peer.py" if code == "yade" else "in.peer"
    text = (peers / code / name).read_text()
    width, is_flowing = box_of(size, scene)[0], scene == "collapse"
    change = {"liggghts": liggghts_input, "lammps": lammps_input,
              "yade": yade_input}[code]
    text = change(text, width, is_flowing)
    if is_flowing and code != "yade":
        text = flow_first(text)
    path = pathlib.Path(folder) / name
    path.write_text(text)
    if code != "yade":
        write_data(peers, size, width, path.parent / "packing.data")
    return path


def write_data(peers, size, width, path):
    side = SIDES[size]
    subprocess.run(["/usr/bin/python3", peers / "tools" / "csv_to_data.py",
                    packing_file(peers, size), str(side), path], check=True)
    path.write_text(replaced(path.read_text(), f"0.0 {side:.9g} xlo",
                             f"0.0 {width:.9g} xlo"))


def command(peers, code, size, scene, threads, steps, path):
    """The words that start the run, in the folder of the input."""
    jolt = {"vx": 0.1, "vz": -0.3} if scene == "jolt" else {}
    values = {"side": SIDES[size], "tag": "run", "steps": steps,
              "tools": (peers / "tools").resolve(), **jolt}
    if code == "yade":
        values["csv"] = packing_file(peers, size).resolve()
        return ["yade", "-n", "-x", f"-j{threads}", path.name,
                *(f"{key}={value}" for key, value in values.items())]
    program = "lmp" if code == "lammps" else "liggghts"
    words = [program, "-in", path.name, "-log", "none",
             "-var", "data", "packing.data"]
    for key, value in values.items():
        words += ["-var", key, str(value)]
    if threads > 1:
        return ["mpirun", "--allow-run-as-root", "--bind-to", "none", "-np",
                str(threads), *words]
    return words
