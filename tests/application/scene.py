#!/usr/bin/env python3
"""Scenes of placed particles and walls: closed forms, restarts, ranks, input.

    scene.py SPALL physics|restart|input
"""
import json
import math
import pathlib
import shutil
import sys
import tempfile

from lab import near, spall_run
from report_pages import page_faults
from triaxial_runs import differing, report_faults, rows, summary

DATA = pathlib.Path(__file__).parents[2] / "data"
RADIUS = 0.01
FLOOR = """# Square of 200 mm, normal up.
v -0.1 -0.1 0
v 0.1 -0.1 0
v 0.1 0.1 0
v -0.1 0.1 0
f 1 2 3 4
"""
# Closed cube of 100 mm from the origin, normals outward.
BLOCK = "".join(f"v {x} {y} {z}\n" for z in (0, 0.1) for y in (0, 0.1)
                for x in (0, 0.1)) + """f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
"""
LINEAR = {"law": "linear", "normal_stiffness": 2e5, "shear_stiffness": 1.7e5,
          "normal_damping": 0, "shear_damping": 0}
BARE = {
    "Case": {"kind": "scene"},
    "Scene": {"particles": "particles.csv", "duration": 0.1, "rows": 100,
              "frames": 2},
    "Particle": {"normal_damping": 0, "shear_damping": 0, "friction": 0.3},
    "Breakage": {"is_active": False},
    # Velocity Verlet: the error of an impact falls with the square of the step.
    "Time": {"safety": 0.1},
}


def write_case(folder, sections, particles, files=()):
    """The case with its particles and other files, as JSON."""
    folder.mkdir(parents=True, exist_ok=True)
    merged = {section: dict(entries) for section, entries in BARE.items()}
    for section, entries in sections.items():
        merged.setdefault(section, {}).update(entries)
    if particles:
        (folder / "particles.csv").write_text(particles)
    for name, text in dict(files).items():
        (folder / name).write_text(text)
    path = folder / "case.json"
    path.write_text(json.dumps(merged))
    return path


def run_scene(spall, folder, sections, particles, files=(), options=()):
    case = write_case(folder, sections, particles, files)
    spall_run([spall, "run", case, "--out", folder / "run", "--threads", 1,
               *options])
    return folder / "run"


def flight(spall, root):
    """A thrown particle of another material flies on a parabola."""
    out = run_scene(spall, root / "flight", {"Scene": {"gravity": [1, 0, -9]}},
                    "x,y,z,diameter,vx,vy,vz,material\n"
                    "0,0,0,0.02,1,2,3,other\n")
    end = rows(out, "history.csv")[1][-1]
    t = end["time_s"]
    faults = []
    for axis, exact in (("x", t + 0.5 * t * t), ("y", 2 * t),
                        ("z", 3 * t - 4.5 * t * t)):
        faults += near(f"flight along {axis}",
                       end[f"centre_of_mass_{axis}_m"], exact, 1e-9)
    return faults


def collision(spall, root):
    """Two equal particles that meet head on exchange their velocities; the
    last state of the run is one to begin with."""
    particles = ("x,y,z,radius,vx,vy,vz\n"
                 "0,0,0,0.01,0.5,0,0\n0.03,0,0,0.01,-0.3,0,0\n")
    out = run_scene(spall, root / "hit", {"Scene": {"gravity": [0, 0, 0]}},
                    particles)
    table = [line.split(",") for line in
             (out / "particles.csv").read_text().splitlines()]
    speed = [float(row[table[0].index("vx")]) for row in table[1:]]
    faults = near("first after the collision", speed[0], -0.3, 1e-5)
    faults += near("second after the collision", speed[1], 0.5, 1e-5)
    if not 0. < summary(out)["energy_residual_ratio_1"] < 1e-5:
        faults.append("the energy as placed is not in the balance")
    again = run_scene(spall, root / "again",
                      {"Scene": {"gravity": [0, 0, 0], "particles": str(out)}},
                      "")
    first = rows(again, "history.csv")[1][0]
    last = rows(out, "history.csv")[1][-1]
    for name in ("centre_of_mass_x_m", "kinetic_energy_J"):
        if first[name] != last[name]:
            faults.append(f"{name} of the next run: {first[name]}, was "
                          f"{last[name]}")
    return faults + json_faults(spall, root, out)


def linear_collision(spall, root):
    """Springs that end between two steps keep the energy, and its books: both
    halves of the work of the last force count, however long the steps."""
    out = run_scene(spall, root / "linear",
                    {"Scene": {"gravity": [0, 0, 0]},
                     "Contact": {"law": "linear"}, "Time": {"safety": 0.8}},
                    "x,y,z,radius,vx,vy,vz\n"
                    "0,0,0,0.01,0.5,0,0\n0.03,0,0,0.02,-0.3,0,0\n")
    return [f"linear collision: {name} = {summary(out)[name]}"
            for name in ("energy_residual_ratio_1",
                         "non_conservative_work_ratio_1")
            if not abs(summary(out)[name]) < 1e-12]


def overlap_at_start(spall, root):
    """A particle that overlaps a wall as placed leaves with the energy of the
    spring, which counts as put in and not as a fault of the integration."""
    depth = 0.01 * RADIUS
    out = run_scene(
        spall, root / "sprung",
        {"Scene": {"gravity": [0, 0, 0]}, "Wall": LINEAR,
         "Walls": {"floor": {"mesh": "floor.obj"}}},
        f"x,y,z,radius\n0,0,{RADIUS - depth},{RADIUS}\n",
        {"floor.obj": FLOOR})
    energy = 0.5 * LINEAR["normal_stiffness"] * depth**2
    end, result = rows(out, "history.csv")[1][-1], summary(out)
    faults = (near("work at first", end["external_work_J"], energy, 1e-9) +
              near("motion in the end", end["kinetic_energy_J"], energy, 1e-2))
    for key, limit in (("energy_residual_ratio_1", 1e-3),
                       ("non_conservative_work_ratio_1", 1e-2)):
        if abs(result[key]) > limit:
            faults.append(f"overlap at first: {key} = {result[key]}")
    return faults


def json_faults(spall, root, from_csv):
    """The same particles as JSON give the same bits."""
    particles = {"box": [0.1, 0.1, 0.1], "particles": [
        {"x": 0, "y": 0, "z": 0, "radius": 0.01, "vx": 0.5, "vy": 0, "vz": 0},
        {"x": 0.03, "y": 0, "z": 0, "radius": 0.01, "vx": -0.3, "vy": 0,
         "vz": 0}]}
    out = run_scene(spall, root / "json",
                    {"Scene": {"gravity": [0, 0, 0],
                               "particles": "particles.json"}},
                    "", [("particles.json", json.dumps(particles))])
    return [f"particles.json: {name} differs"
            for name in ("history.csv", "particles.csv")
            if (out / name).read_text() != (from_csv / name).read_text()]


def weight_on_walls(spall, root):
    """What lies on a mesh, or on the box, weighs on it; the balance of energy
    closes with a wall that is lifted."""
    mass = 2750. * 4. / 3. * math.pi * RADIUS**3
    resting = {"Wall": {**LINEAR, "normal_damping": 0.62},
               "Scene": {"duration": 0.3}}
    particles = (f"x,y,z,radius\n0.01,0.02,{RADIUS},{RADIUS}\n"
                 f"-0.03,0,{RADIUS},{RADIUS}\n")
    on_mesh = run_scene(
        spall, root / "mesh",
        {**resting, "Walls": {"floor": {
            "mesh": "floor.obj", "velocity": [0, 0, 0.05], "start": 0.05}}},
        particles, {"floor.obj": FLOOR})
    end = rows(on_mesh, "history.csv")[1][-1]
    faults = near("force on the mesh", end["floor_force_z_N"],
                  -2 * mass * 9.81, 1e-6)
    # About the origin of the floor: y F_z of the one beside the axis.
    faults += near("moment on the mesh", end["floor_moment_x_Nm"],
                   -0.02 * mass * 9.81, 1e-3)
    faults += near("lift of the mesh", end["floor_displacement_z_m"],
                   0.05 * (end["time_s"] - 0.05), 1e-9)
    if abs(end["energy_residual_J"]) > 1e-6 * abs(end["external_work_J"]):
        faults.append(f"residual {end['energy_residual_J']} J of "
                      f"{end['external_work_J']} J")
    in_box = run_scene(
        spall, root / "box",
        {**resting, "Box": {"z": "rigid", "lower": [-1, -1, 0],
                            "upper": [1, 1, 1]}}, particles)
    end = rows(in_box, "history.csv")[1][-1]
    faults += near("force on the box", end["box_z_min_force_z_N"],
                   -2 * mass * 9.81, 1e-6)
    # About the origin: y F_z and -x F_z of each.
    faults += near("moment about x on the box", end["box_z_min_moment_x_Nm"],
                   -0.02 * mass * 9.81, 1e-6)
    faults += near("moment about y on the box", end["box_z_min_moment_y_Nm"],
                   (0.01 - 0.03) * mass * 9.81, 1e-6)
    return faults


def sliding(spall, root):
    """A ball that is thrown along a mesh without spin slides until it rolls:
    2/7 of its energy is dissipated there, whatever the friction."""
    mass = 2750. * 4. / 3. * math.pi * RADIUS**3
    sunk = mass * 9.81 / LINEAR["normal_stiffness"]
    out = run_scene(
        spall, root / "sliding",
        {"Wall": {**LINEAR, "normal_damping": 0.62, "shear_damping": 0.62,
                  "friction": 0.3, "rolling_friction": 0},
         "Walls": {"floor": {"mesh": "floor.obj"}}},
        f"x,y,z,radius,vx,vy,vz\n-0.05,0.01,{RADIUS - sunk},{RADIUS},0.3,0,0\n",
        {"floor.obj": FLOOR})
    end = rows(out, "history.csv")[1][-1]
    faults = near("friction on the floor", end["floor_friction_J"],
                  2. / 7. * 0.5 * mass * 0.3**2, 2e-3)
    if end["floor_friction_J"] != end["friction_dissipation_J"]:
        faults.append("the floor has not all of the friction")
    return faults


def periodic_box(spall, root):
    """A particle that leaves at one face hits another one behind the other."""
    out = run_scene(
        spall, root / "periodic",
        {"Scene": {"gravity": [0, 0, 0], "duration": 0.05},
         "Box": {"x": "periodic", "lower": [0, 0, 0],
                 "upper": [0.1, 0.1, 0.1]}},
        "x,y,z,radius,vx,vy,vz\n"
        "0.09,0.05,0.05,0.008,1,0,0\n0.015,0.05,0.05,0.008,0,0,0\n")
    table = [line.split(",") for line in
             (out / "particles.csv").read_text().splitlines()]
    speed = [float(row[table[0].index("vx")]) for row in table[1:]]
    return near("speed handed over", speed[1], 1., 1e-4)


def physics(spall, root):
    return (flight(spall, root) + collision(spall, root) +
            linear_collision(spall, root) + overlap_at_start(spall, root) +
            weight_on_walls(spall, root) + sliding(spall, root) +
            periodic_box(spall, root))


# Spheres and shapes, a turning paddle, a lid on a spring of particles.
BUSY = {
    "Scene": {"duration": 0.05, "rows": 50, "frames": 2, "particles": ""},
    "Fill": {"mass": 0.25, "gradation": "gradations/quick_7_22mm.csv",
             "shapes": "shapes/limestone_blocky",
             "lower": [-0.05, -0.05, 0], "upper": [0.05, 0.05, 0.045]},
    "Box": {"x": "rigid", "y": "rigid", "lower": [-0.05, -0.05, 0],
            "upper": [0.05, 0.05, 0.1]},
    "Walls": {
        "floor": {"mesh": "floor.obj", "amplitude": [0, 0, 0.0005],
                  "frequency": 60},
        "lid": {"mesh": "floor.obj", "position": [0, 0, 0.046],
                "particles": "inside", "free": "z", "mass": 0.5,
                "force": [0, 0, -20], "rotation_rate": 0.5}},
    "Wall": LINEAR,
}


def contents(folder):
    return {path: path.read_bytes() for path in folder.rglob("*")
            if path.is_file()}


def restart(spall, root):
    """Stopped and continued, and on other numbers of threads and ranks: the
    same bits."""
    files = {"floor.obj": FLOOR}
    whole = run_scene(spall, root / "whole", BUSY, "", files)
    part = root / "part"
    run_scene(spall, part, BUSY, "", files,
              ["--set", "Scene/duration=0.02", "--set", "Scene/rows=20",
               "--set", "Scene/frames=0"])
    spall_run([spall, "run", part / "case.json", "--out", part / "run",
               "--threads", 2, "--resume"])
    names = ["history.csv", "events.csv", "particles.csv"]
    faults = [f"{name} differs after a restart"
              for name in differing(part / "run", whole, names)]
    before = contents(part / "run")
    spall_run([spall, "run", part / "case.json", "--out", part / "run",
               "--resume", "--set", "Fill/seed=2"], status=1)
    if contents(part / "run") != before:
        faults.append("a refused --resume has changed the run")
    if len(set((whole / "events.csv").read_text().splitlines()[0]
               .split(","))) != 15:
        faults.append("events.csv: not 15 columns of different names")
    faults += ranks_faults(spall, root, whole, names)
    for pattern in ("walls_*.vtu", "particles_*.vtu"):
        if not list((whole / "frames").glob(pattern)):
            faults.append(f"no frames/{pattern}")
    if "walls" not in summary(whole):
        faults.append("no walls in summary.json")
    spall_run([spall, "report", whole])
    return faults + page_faults(whole / "report.html",
                                ["Mechanical response", "Boundaries", "Input"])


def ranks_faults(spall, root, whole, names):
    if not shutil.which("mpirun"):
        return []
    from ranks import launch
    faults = []
    for n_ranks in (2, 3):
        case = write_case(root / f"on_{n_ranks}", BUSY, "",
                          {"floor.obj": FLOOR})
        out = root / f"on_{n_ranks}" / "run"
        ended = launch(n_ranks, [spall, "run", case, "--out", out,
                                 "--threads", 1])
        if ended.returncode:
            return [f"{n_ranks} ranks: {ended.stderr}"]
        faults += [f"{name} differs on {n_ranks} ranks"
                   for name in differing(out, whole, names)]
    return faults


HEADER = "x,y,z,radius\n"
TWO = HEADER + "0,0,0,0.01\n0.05,0,0,0.01\n"
BAD = [
    ("overlap", {}, HEADER + "0,0,0,0.01\n1,0,0,0.01\n0.018,0,0,0.01\n",
     ["particles.csv:2", "particles.csv:4", "0.2 of its radius",
      "Scene/largest_overlap = 0.05"]),
    ("one centre", {}, TWO + "0.05,0,0,0.005\n",
     ["particles.csv:4: has the same centre as", "particles.csv:3"]),
    ("in a wall", {"Box": {"z": "rigid", "lower": [-1, -1, -0.005],
                           "upper": [1, 1, 1]}},
     TWO, ["particles.csv:", "overlaps the plane of the normal (0, 0, 1)", "0.5 of its radius"]),
    ("no shape", {}, "x,y,z,radius,shape\n0,0,0,0.01,pebble\n",
     ["particles.csv:2", "shape pebble", "must be sphere"]),
    ("no material", {}, "x,y,z,radius,material\n0,0,0,0.01,wood\n",
     ["particles.csv:2", "material wood", "particle", "other"]),
    ("no number", {}, HEADER + "0,zero,0,0.01\n",
     ["particles.csv:2", "zero", "must be a number"]),
    ("short row", {}, HEADER + "0,0,0\n",
     ["particles.csv:2", "has 3 cells, must have 4"]),
    ("half a velocity", {}, "x,y,z,radius,vx\n0,0,0,0.01,1\n",
     ["particles.csv:1", "the header must be"]),
    ("nothing", {"Scene": {"particles": ""}}, "",
     ["Scene/particles", "Fill/mass"]),
    ("no mesh", {"Walls": {"floor": {"velocity": [0, 0, 1]}}}, TWO,
     ["Walls/floor/mesh", "must name a mesh"]),
    ("mesh that is none", {"Walls": {"floor": {"mesh": "particles.csv"}}}, TWO,
     ["Walls/floor/mesh = particles.csv", ".stl"]),
    ("bad name", {"Walls": {"the floor": {"mesh": "floor.obj"}}}, TWO,
     ["Walls/the floor", "letters, digits and _"]),
    ("two numbers", {"Walls": {"floor": {"mesh": "floor.obj",
                                         "velocity": [0, 1]}}}, TWO,
     ["Walls/floor/velocity = 0, 1", "three numbers"]),
    ("unknown key", {"Walls": {"floor": {"mesh": "floor.obj",
                                         "speed": 1}}}, TWO,
     ["Walls/floor/speed", "no key of this name"]),
    ("table", {"Walls": {"floor": {"mesh": "floor.obj", "table": "t.csv"}}},
     TWO, ["t.csv:3", "increase"]),
    ("moved table", {"Walls": {"floor": {"mesh": "floor.obj",
                                         "table": "moved.csv"}}},
     TWO, ["moved.csv:2", "the first displacement must be 0, 0, 0"]),
    ("in a block", {"Walls": {"block": {"mesh": "block.obj"}}},
     HEADER + "0.2,0,0,0.01\n0.05,0.04,0.05,0.01\n",
     ["particles.csv:3", "the wall 'block'", "at (0.05, 0.04, 0.05) m",
      "Walls/block/particles"]),
    ("out of a room", {"Walls": {"room": {"mesh": "block.obj",
                                          "particles": "inside"}}},
     HEADER + "0.05,0.04,0.05,0.01\n0.2,0,0,0.01\n",
     ["particles.csv:3", "the wall 'room'"]),
    ("cut json", {"Scene": {"particles": "cut.json"}}, "",
     ["cut.json: is not JSON: at byte"]),
    ("short json", {"Scene": {"particles": "short.json"}}, "",
     ["short.json: particle 2", "must have the keys x,y,z,radius"]),
    ("word in json", {"Scene": {"particles": "word.json"}}, "",
     ["word.json: particle 1", "zero", "must be a number"]),
    ("corners", {"Box": {"lower": [0, 0, 0], "upper": [1, 0, 1]}}, TWO,
     ["Box/upper = 1, 0, 1", "must be above"]),
]


BAD_JSON = {
    "cut.json": '[{"x": 0, "y": 0',
    "short.json": '[{"x": 0, "y": 0, "z": 0, "radius": 0.01}, {"x": 1}]',
    "word.json": '[{"x": 0, "y": 0, "z": "zero", "radius": 0.01}]',
}


def bad_input(spall, root):
    """One clear line with file, section, key and what is allowed."""
    faults = []
    for name, sections, particles, words in BAD:
        case = write_case(root / name, sections, particles,
                          {"floor.obj": FLOOR, "block.obj": BLOCK, **BAD_JSON,
                           "t.csv": "time_s,x_m,y_m,z_m\n0,0,0,0\n0,1,0,0\n",
                           "moved.csv": "time_s,x_m,y_m,z_m\n1,0,0,0.1\n"})
        said = spall_run([spall, "check", case], status=1).stderr.strip()
        faults += [f"{name}: {said}: must have '{word}'"
                   for word in words if word not in said]
        if "\n" in said:
            faults.append(f"{name}: more than one line: {said}")
    # Of a .prm, with the line; nested sections and --set.
    folder = root / "prm"
    write_case(folder, {}, TWO, {"floor.obj": FLOOR})
    case = folder / "case.prm"
    case.write_text("subsection Case\n  set kind = scene\nend\n"
                    "subsection Scene\n  set particles = particles.csv\nend\n"
                    "subsection Walls\n  subsection floor\n"
                    "    set mesh = floor.obj\n    set free = up\n  end\nend\n")
    said = spall_run([spall, "check", case], status=1).stderr
    if "case.prm:10: Walls/floor/free = up: must be one of none" not in said:
        faults.append(f"prm: {said}")
    spall_run([spall, "check", case, "--set", "Walls/floor/free=z",
               "--set", "Walls/floor/position=0,0,-0.1"])
    return faults


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        tests = {"physics": physics, "restart": restart, "input": bad_input}
        sys.exit(report_faults(tests[sys.argv[2]](sys.argv[1],
                                                  pathlib.Path(temporary))))
