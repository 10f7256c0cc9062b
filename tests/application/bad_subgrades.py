"""Broken cases of kind subgrade for bad_input.py."""
from bad_cases import CASE, Bad, prm
from test_meshes import block, gmsh

# Refused before anything is built, but for the last ones.
SOUND = {
    "Case": {"kind": "subgrade"},
    "Layer": {"gradation": "g.csv", "shapes": "", "length": 0.1, "width": 0.1,
              "thickness": 0.03, "solid_fraction": 0.4},
    "LoadPlate": {"diameter": 0.08},
    "Subgrade": {"length": 0.4, "width": 0.4, "cell_size": 0.04,
                 "layers": "0.2 40e6 0.3 1800"},
    "Record": {"stress_depths": "0.1"},
    "Breakage": {"is_active": "false"},
    "Wall": {"normal_stiffness": 1e6, "shear_stiffness": 0.85e6},
    "GroundContact": {"normal_stiffness": 1e6, "shear_stiffness": 0.85e6},
    "Coupling": {"exchange": "one_pass", "particle_steps": 1},
    "Time": {"fixed_step": 1e-6},
}


ACROSS = [-200., -100., 0., 100., 200.]
TETRAHEDRON = ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n"
               "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 -1\n$EndNodes\n"
               "$Elements\n1\n1 4 2 1 1 1 3 2 4\n$EndElements\n")


def ground(changes, *message):
    """A case with these changes and what must be said about it."""
    case = {section: dict(entries) for section, entries in SOUND.items()}
    name = "subgrade"
    for name_of_key, text in changes.items():
        section, key = name_of_key.split("/")
        case.setdefault(section, {})[key] = text
        name += "_" + key + "_" + str(text).replace("/", "_")
    last = list(changes)[-1]
    return Bad(name.replace(" ", "_"), CASE, [last, *message],
               files={"case.prm": prm(case),
                      "bad.csv": "a,b\n0,1\n0.5;3\n",
                      "short.csv": "time_s,force_N\n0,1000\n",
                      "no.msh": "no mesh\n", "tetrahedron.msh": TETRAHEDRON,
                      "millimetres.msh": gmsh(*block(
                          ACROSS, ACROSS, [-200., -100., 0.]))})


SUBGRADES = [
    ground({"Layer/length": 0.03}, "three times the largest particle"),
    ground({"Layer/thickness": 0.01}, "largest particle"),
    ground({"Layer/layers": 900}, "number of particles"),
    ground({"LoadPlate/diameter": 0.2}, "Layer/length"),
    ground({"LoadPlate/form": "ring"}, "disc, block"),
    ground({"Subgrade/length": 0.05}, "Layer/length"),
    ground({"Subgrade/layers": "0.2 40e6 0.5 1800"}, "0 to below 0.5"),
    ground({"Subgrade/layers": ""}, "from the top down"),
    ground({"Subgrade/layers": "0.2 40e6 0.3"}, "from the top down"),
    ground({"Subgrade/layers": "0.2 40e6 0.3 1800 5e3"}, "dilation angle"),
    ground({"Subgrade/layers": "0.2 40e6 0.3 1800 5e3 30 40"},
           "0 to the friction angle"),
    ground({"Record/stress_depths": "", "Coupling/body_time": "implicit",
            "Subgrade/layers": "0.2 40e6 0.3 1800 5e3 30",
            "Subgrade/body": "condensed"}, "must be full"),
    ground({"Subgrade/cell_size": 0.1}, "narrow side of the plate"),
    ground({"Subgrade/bottom": "soft"}, "absorbing, rigid"),
    ground({"Record/stress_depths": "0.1 0.05"}, "ascend"),
    ground({"Record/stress_depths": "0.5"}, "less deep"),
    ground({"Record/row_interval": 1e-7}, "a window"),
    ground({"Pulse/form": "table", "Pulse/table": ""}, "time_s,force_N"),
    ground({"Pulse/form": "table", "Pulse/table": "short.csv"}, "ends at 0 s"),
    ground({"Pulse/form": "table", "Pulse/table": "bad.csv"},
           "header must be time_s,force_N"),
    ground({"Pulse/form": "train", "Pulse/axle_spacing": 30}, "car_length"),
    ground({"Pulse/form": "train", "Pulse/share": "table",
            "Pulse/share_table": "bad.csv"}, "distance_m,share_1"),
    ground({"Coupling/exchange": "none"}, "every_step, one_pass, iterated"),
    ground({"Coupling/particle_steps": 2, "Coupling/exchange": "every_step"}, "must be 1"),
    ground({"Coupling/window_tolerance": 1e-3,
            "Coupling/exchange": "every_step"}, "must be 0, except"),
    ground({"Subgrade/body": "condensed", "Record/stress_depths": "0.1"},
           "has no inside"),
    ground({"Subgrade/body": "condensed", "Record/stress_depths": "",
            "Coupling/body_time": "explicit"}, "must be implicit"),
    ground({"Subgrade/body": "condensed", "Record/stress_depths": "",
            "Coupling/body_time": "implicit", "Time/step": "stable"},
           "must be fixed"),
    ground({"Time/step": "error"}, "fixed or stable"),
    # Once particles and ground are known.
    ground({"Subgrade/mesh": "none.msh"}, "no such file or folder"),
    ground({"Subgrade/mesh": "no.msh"}, "not a gmsh file of hexahedra"),
    ground({"Subgrade/mesh": "tetrahedron.msh"}, "must be hexahedra"),
    ground({"Subgrade/mesh": "millimetres.msh"}, "200 m deep",
           "in all, 0.2 m (files are in metres)"),
    ground({"Record/row_interval": 1e-2, "Time/fixed_step": 1e-3},
           "must be at most"),
    ground({"Record/row_interval": 1e-2, "Time/fixed_step": 1e-5,
            "Coupling/particle_steps": 60, "Coupling/body_steps": 1},
           "of the subgrade"),
]
