"""Broken mesh files for bad_input.py."""
from bad_cases import CASE, Bad, fit, prm
from test_meshes import (binary_stl, box_triangles, scaled, second_order_quad,
                         stl)

SQUARE_OBJ = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
BOX = stl(box_triangles())
LARGE = stl(scaled(box_triangles(), 20))


def sheet(name, text, *message):
    """A case whose membrane comes from this file of gmsh."""
    return Bad("mesh_" + name, CASE, ["Boundary/mesh = m.msh", *message],
               {"Boundary": {"mesh": "m.msh"}}, {"m.msh": text})


def wall(name, settings, *message, sections=()):
    """A scene of one particle above a wall with these settings."""
    return Bad("wall_" + name, ["check", "w.prm"], list(message),
               files={"m.stl": stl(scaled(box_triangles(), 0.1)),
                      "p.csv": "x,y,z,radius\n0.05,0.05,0.2,0.01\n",
                      "w.prm": prm({"Case": {"kind": "scene"},
                                    "Scene": {"particles": "p.csv"},
                                    **dict(sections)}) +
                      "subsection Walls\n  subsection lid\n"
                      "    set mesh = m.stl\n" +
                      "".join(f"    set {one}\n" for one in settings) +
                      "  end\nend\n"})


MESH_FILES = [
    wall("force", ["force = 0, 0, -50"],
         "w.prm:10: Walls/lid/force = 0, 0, -50: must be 0 along axes that are "
         "not in Walls/lid/free"),
    wall("force_across", ["free = x", "force = 1, 0, -50"],
         "Walls/lid/force = 1, 0, -50: must be 0 along axes that are not in"),
    wall("cyclic_force", ["free = z", "force_amplitude = 0, 0, 50"],
         "Walls/lid/frequency = 0: must be above 0 with Walls/lid/"
         "force_amplitude"),
    wall("velocity", ["free = z", "velocity = 0, 0, 0.1"],
         "Walls/lid/velocity = 0, 0, 0.1: must be 0 along the axes in "
         "Walls/lid/free"),
    wall("torque", ["torque = 2"],
         "Walls/lid/torque = 2: must be 0 unless Walls/lid/inertia is above 0"),
    wall("rotation", ["inertia = 1", "rotation_rate = 3"],
         "Walls/lid/rotation_rate = 3: must be 0 with Walls/lid/inertia"),
    wall("box", [], "p.csv:2: is beyond a wall as placed, at (0.05, 0.05, 0.2) "
         "m", sections={"Box": {"z": "rigid",
                                           "upper": "1, 1, 0.15"}}.items()),
    wall("period", [], "w.prm: Scene/particles as placed: a periodic cell of "
         "0.03 m is too short",
         sections={"Box": {"x": "periodic", "lower": "0.04, 0, 0",
                           "upper": "0.07, 1, 1"}}.items()),
    *[fit("obj_" + name, "m.obj", SQUARE_OBJ + face, "m.obj: line 5", word)
      for name, face, word in [
          ("index", "f 4 1 5 1000008\n", "vertex 1000008, the file has 4"),
          ("zero", "f 0 1 2\n", "vertex 0"),
          ("back", "f 1 2 -5\n", "vertex -5"),
          ("overflow", "f 1 2 99999999999999999999\n", "below 0 to count"),
          ("comma", "v 0,5 1 2\n", "decimal comma: write 0.5")]],
    fit("stl_promises", "m.stl", binary_stl(box_triangles(), 0x7fffffff),
        "promises 2147483647 triangles", "has room for 12"),
    fit("stl_cut_off", "m.stl", BOX[:700], "without endsolid", "cut off?"),
    fit("stl_comma", "m.stl", BOX.replace("vertex 1 ", "vertex 1,5 ", 1),
        "line ", "decimal comma: write 1.5"),
    fit("stl_gap", "m.stl", BOX.replace("vertex 1 1 1", "vertex 1.00001 1 1",
                                        1),
        "is open", "1e-06 of its diagonal"),
    fit("millimetres", "m.stl", LARGE, "m.stl: is 20 m across", "--unit mm"),
    Bad("info_millimetres", ["shape", "info", "m.stl"],
        ["is 20 m across", "--unit mm"], files={"m.stl": LARGE}),
    Bad("wall_in_millimetres", ["check", "w.prm"],
        ["Walls/lid/mesh = m.stl: is 300 m wide: must be at most 100 m",
         "scale = 0.001"],
        files={"m.stl": stl(scaled(box_triangles(), 300)),
               "p.csv": "x,y,z,radius\n2,2,2,0.1\n",
               "w.prm": prm({"Case": {"kind": "scene"},
                             "Scene": {"particles": "p.csv"}}) +
               "subsection Walls\n  subsection lid\n    set mesh = m.stl\n"
               "  end\nend\n"}),
    sheet("second_order", second_order_quad(), "quads of order 2",
          "must be of order 1"),
    sheet("count", second_order_quad().replace("$Nodes\n8", "$Nodes\n900000000")
          [:81], "line 9", "cut off?"),
]
