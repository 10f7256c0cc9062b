"""The broken inputs of bad_input.py and what must be said about each."""
import dataclasses
import gzip
import json

from test_meshes import (box_triangles, mushroom_triangles, stl,
                         torus_triangles)

# Small and quick should a case be accepted by mistake.
SOUND = {
    "Coupling": {"exchange": "every_step"},
    "Specimen": {"side": 0.05, "gradation": "g.csv", "shapes": "",
                 "solid_fraction": 0.4},
    "Loading": {"cycles": 1, "consolidation_time": 0},
    "Time": {"fixed_step": "1e-6"},
    "Breakage": {"is_active": "false"},
}


@dataclasses.dataclass
class Bad:
    """One broken input."""
    name: str
    words: list
    message: list  # each must be in the line
    case: dict = dataclasses.field(default_factory=dict)  # over SOUND
    files: dict = dataclasses.field(default_factory=dict)


def prm(sections):
    """A case as a .prm."""
    text = ""
    for section, entries in sections.items():
        text += f"subsection {section}\n"
        for key, value in entries.items():
            text += f"  set {key} = {value}\n"
        text += "end\n"
    return text


def merged(changes):
    result = {section: dict(entries) for section, entries in SOUND.items()}
    for section, entries in changes.items():
        result.setdefault(section, {}).update(entries)
    return result


CASE = ["check", "{case}"]
GRADATION = "# test\ndiameter_m,passing_1\n0.008,0\n0.016,1\n"
ROUND = {"order": 0, "convention": "real orthonormal, no Condon-Shortley",
         "coefficients": [0.0354], "unit": "m", "source": "test",
         "licence": "CC0"}


def value(section, key, text, *message):
    """A case with one bad value; the message names it."""
    return Bad(f"{section}_{key}_{text}".replace("/", "_"), CASE,
               [f"{section}/{key} = {text}: ", *message],
               {section: {key: text}})


VALUES = [
    value("Particle", "shear_modulus", "-5e8", "at least 1"),
    value("Particle", "poisson_ratio", "0.5", "below 0.5"),
    value("Particle", "density", "heavy", "a number above 0"),
    value("Particle", "friction", "nan", "a number"),
    value("Particle", "friction", "-0.1", "at least 0"),
    value("Membrane", "youngs_modulus", "-1.4e6", "above 0"),
    value("Membrane", "thickness", "0", "above 0"),
    value("Membrane", "residual_stiffness", "0.1", "must be 0 unless"),
    value("MembraneContact", "rolling_friction", "0.1", "no rotational"),
    value("Boundary", "lateral", "balloon", "one of membrane, rigid, periodic"),
    Bad("periodic_cylinder", CASE,
        ["Boundary/lateral = periodic: needs Specimen/form = box"],
        {"Boundary": {"lateral": "periodic"},
         "Specimen": {"form": "cylinder"}}),
    Bad("short_periodic_side", CASE,
        ["Specimen/side = 0.032 m: must be at least",
         "two images of another one"],
        {"Boundary": {"lateral": "periodic"}, "Specimen": {"side": 0.032}}),
    value("Boundary", "mesh", "none.msh", "no such file or folder"),
    value("Boundary", "mesh", "g.csv", "is not a gmsh file of a surface of"),
    value("Contact", "geometry", "surface_of_doom",
          "one of sphere, radial, surface"),
    value("Contact", "wall_geometry", "surface", "Contact/geometry = surface"),
    value("Breakage", "is_active", "maybe", "true or false"),
    value("Breakage", "min_equivalent_radius", "0.02", "Breakage/min_diameter"),
    value("Case", "kind", "los_angles", "dynamic_triaxial"),
    value("Loading", "cycles", "0", "at least 1"),
    value("Loading", "cycles", "2.5", "whole number"),
    value("Loading", "frequency", "0", "above 0"),
    value("Loading", "confining_pressure", "-3e4", "above 0"),
    value("CycleJump", "first", "0", "at least 1"),
    value("Output", "samples_per_cycle", "5", "at least 10"),
    value("Output", "frames_per_cycle", "100", "samples_per_cycle"),
    value("Preparation", "pressure", "1e-3 kPa", "a number"),
    value("Run", "threads", "-1", "at least 0"),
    value("Specimen", "solid_fraction", "0.75", "below 0.75"),
    value("Specimen", "initial_solid_fraction", "0.5", "at most 0.35"),
    value("Specimen", "side", "0.02", "twice the largest particle"),
    value("Specimen", "gradation", "none.csv", "no such file"),
    value("Specimen", "gradation", "", "CSV"),
    value("Specimen", "shapes", "no_such_folder", "no such file or folder"),
    value("Specimen", "shapes", "g.csv", "folder"),
    value("Time", "fixed_step", "0.002", "history.csv"),
    value("Time", "step", "adaptive", "one of fixed, stable, error"),
    value("Time", "safety", "1.1", "at most 1"),
    value("Time", "force_tolerance", "0", "above 0"),
    value("Time", "force_tolerance", "5 %", "a number"),
    value("Time", "energy_tolerance", "-0.01", "above 0"),
    value("Time", "energy_tolerance", "2", "at most 1"),
    value("Coupling", "exchange", "none", "every_step, one_pass, iterated"),
    value("Coupling", "contact_tangent", "true", "body_time = implicit"),
    value("Coupling", "particle_steps", "2", "must be 1"),
    value("Coupling", "ledger_limit", "0", "above 0"),
    value("Material", "file", "granite.prm", "no such file"),
]

# Found once the particles and the membrane are known.
SCENE = [
    # The smallest particles, 8 mm, on a wall of 1e8 N/m: 2 sqrt(m / k) = 5e-6 s.
    Bad("unstable_step", CASE, ["Time/fixed_step = 0.0001", "must be at most"],
        {"Time": {"fixed_step": "1e-4"}}),
    # k dt^2 / (4 m) = 1 on a node of (0.05 m / 12)^2 1 mm 1100 kg/m^3 = 19 mg;
    # the particles alone, above 0.7 g, would be stable.
    Bad("gain", CASE, ["MembraneContact/normal_stiffness", "gain"],
        {"MembraneContact": {"normal_stiffness": "8e7"}}),
]

WORDS = [
    Bad("no_command", [], []),  # prints the usage, see below
    Bad("unknown_command", ["ran", "{case}"], ["ran", "template"]),
    Bad("unknown_kind", ["template", "triaxial"], ["dynamic_triaxial"]),
    Bad("template_without_kind", ["template"],
        ["dynamic_triaxial", "subgrade", "parameters"]),
    Bad("check_without_case", ["check"], ["case file"]),
    Bad("run_without_case", ["run"], ["case file"]),
    Bad("two_cases", ["check", "{case}", "{case}"], ["check"]),
    Bad("unknown_option", ["run", "{case}", "--fast"], ["--fast"]),
    Bad("option_without_value", ["run", "{case}", "--out"], ["--out"]),
    Bad("option_empty", ["run", "{case}", "--out", ""], ["run", "empty"]),
    Bad("threads_text", ["run", "{case}", "--threads", "all"], ["all"]),
    Bad("threads_zero", ["run", "{case}", "--threads", "-2"], ["-2"]),
    Bad("threads_many", ["run", "{case}", "--threads", "100000"], ["to 1024"]),
    Bad("title_latin", CASE, ["Case/title", "UTF-8"],
        files={"case.prm": prm(merged({"Case": {"title": "Prüfung"}}))
               .encode("latin-1")}),
    Bad("mesh_folder", CASE, ["Boundary/mesh = .", "gmsh"],
        {"Boundary": {"mesh": "."}}),
    Bad("kind", [*CASE, "--set", "Case/kind=single_particel",
                 "--set", "Particle/diameter=0.03"],
        ["Case/kind = single_particel", "single_particle"]),
    Bad("particles_in_mm", [*CASE, "--set", "Specimen/side=50"],
        ["Specimen/gradation = g.csv", "more than 10000000 particles",
         "must be in m"]),
    Bad("set_form", [*CASE, "--set", "cycles=3"], ["Section/key=value"]),
    Bad("set_section", [*CASE, "--set", "Loding/cycles=3"], ["Loading?"]),
    Bad("set_key", [*CASE, "--set", "Loading/cycle=3"], ["cycles?"]),
    Bad("set_value", [*CASE, "--set", "Loading/cycles=x"],
        ["--set", "Loading/cycles = x", "whole number"]),
    Bad("set_preset", [*CASE, "--set", "preset=quick"],
        ["preset=quick", "article, fast, reference, standard"]),
    Bad("jump_without_cycles", CASE,
        ["CycleJump/tolerance = 0.1", "Loading/form = haversine"],
        {"CycleJump": {"tolerance": 0.1}, "Loading": {"form": "compression"}}),
    Bad("missing_case", ["run", "nowhere.prm"], ["nowhere.prm", "no such"]),
    Bad("case_is_folder", ["run", "."], ["folder"]),
    Bad("case_ending", ["run", "g.csv"], [".prm or .json"]),
    Bad("out_is_file", ["run", "{case}", "--out", "g.csv"], ["g.csv"]),
    Bad("out_is_no_run", ["run", "{case}", "--out", "full"],
        ["full", "not a run"], files={"full/note": "x"}),
    Bad("out_is_of_case", ["run", "mine/case.prm", "--out", "mine"],
        ["mine", "the case file itself"],
        files={"mine/case.prm": prm(SOUND), "mine/g.csv": GRADATION}),
    Bad("out_has_case_only", ["run", "{case}", "--out", "other"],
        ["other", "not a run"], files={"other/case.prm": "x"}),
    Bad("out_is_unfinished", ["run", "{case}", "--out", "half"],
        ["half", "--resume", "--overwrite"],
        files={"half/case.prm": "x", "half/history.csv": "x",
               "half/checkpoint/state.bin": "x",
               "half/summary.json": '{"is_complete": false}'}),
    Bad("resume_and_overwrite",
        ["run", "{case}", "--resume", "--overwrite"], ["only one"]),
    Bad("resume_nothing", ["run", "{case}", "--resume", "--out", "old"],
        ["old", "checkpoint"], files={"old/case.prm": "x"}),
    Bad("resume_nowhere", ["run", "{case}", "--resume", "--out", "nowhere"],
        ["nowhere", "checkpoint"]),
    Bad("report_nothing", ["report"], ["DIR"]),
    Bad("report_missing", ["report", "nowhere"], ["nowhere"]),
    Bad("report_no_run", ["report", "empty"], ["empty"],
        files={"empty/note": "x"}),
    Bad("report_half_a_run", ["report", "half"], ["half"],
        files={"half/summary.json": "{}"}),
]


def case_file(name, text, *message):
    """A case file with this text."""
    ending = ".json" if text.startswith("{") else ".prm"
    return Bad(name, ["check", "bad" + ending], list(message),
               files={"bad" + ending: text})


FILES = [
    case_file("unknown_section", prm({"Particles": {"friction": 0.5}}),
              "bad.prm:2: Particles/friction = 0.5", "did you mean Particle?"),
    case_file("unknown_key", prm({"Particle": {"frction": 0.5}}),
              "Particle/frction = 0.5", "did you mean friction?"),
    case_file("unreadable_line", "subsection Particle\n friction 0.5\nend\n",
              "bad.prm:2", "friction 0.5"),
    case_file("no_end", "subsection Particle\n set friction = 0.5\n", "end"),
    case_file("nested", "subsection Particle\n subsection Wall\n end\nend\n",
              "bad.prm:2", "nested"),
    case_file("end_too_many", "end\n", "bad.prm:1"),
    case_file("outside", "set friction = 0.5\n", "bad.prm:1", "outside"),
    case_file("set_twice", "subsection Particle\n set friction = 0.5\n"
              " set friction = 0.4\nend\n", "bad.prm:3", "twice"),
    case_file("json_syntax", '{"Particle": {"friction": 0.5}', "JSON", "line"),
    case_file("json_form", '{"Particle": 3}', "Particle", "Section"),
    case_file("json_twice", '{"Particle": {"friction": 1, "friction": 2}}',
              "friction", "twice"),
    case_file("json_value", '{"Particle": {"friction": "rough"}}',
              "Particle/friction = rough", "number"),
    case_file("json_number", '{"Particle": {"friction": 1e400}}', "1e400"),
    case_file("json_binary", "{\x01\x02", "JSON"),
    Bad("material_key", CASE, ["m.prm:2", "Particle/hardness"],
        {"Material": {"file": "m.prm"}},
        {"m.prm": prm({"Particle": {"hardness": 3}})}),
    Bad("material_section", CASE, ["m.prm:2", "Loading/cycles"],
        {"Material": {"file": "m.prm"}},
        {"m.prm": prm({"Loading": {"cycles": 3}})}),
    Bad("material_value", CASE, ["m.prm:2", "Particle/density = 0", "above 0"],
        {"Material": {"file": "m.prm"}},
        {"m.prm": prm({"Particle": {"density": 0}})}),
]


def gradation(name, text, *message):
    names_file = () if "Specimen/side" in message else ("bad.csv",)
    return Bad("gradation_" + name, CASE, [*names_file, *message],
               {"Specimen": {"gradation": "bad.csv"}}, {"bad.csv": text})


HEADER = "diameter_m,passing_1\n"
GRADATIONS = [
    gradation("header", "d,p\n0.008,0\n0.016,1\n", "bad.csv:1", "header"),
    gradation("text", HEADER + "0.008,0\nbig,1\n", "bad.csv:3",
              "numbers with decimal points"),
    gradation("order", HEADER + "0.016,0\n0.008,1\n", "increase"),
    gradation("falling", HEADER + "0.008,0\n0.01,0.6\n0.012,0.5\n0.016,1\n",
              "decrease"),
    gradation("share", HEADER + "0.008,0\n0.016,1.5\n", "between 0 and 1"),
    gradation("end", HEADER + "0.008,0\n0.016,0.9\n", "end with 1"),
    gradation("negative", HEADER + "-0.008,0\n0.016,1\n", "above 0"),
    gradation("short", HEADER + "0.008,0\n", "two rows"),
    gradation("empty", "", "first line must be diameter_m,passing_1"),
    gradation("per_cent", HEADER + "0.008,0\n0.016,100\n", "per cent"),
    gradation("mm", HEADER + "8,0\n16,1\n", "bad.csv:3", "at most 10 m",
              "mm must be divided by 1000"),
    gradation("mm_header", "diameter_mm,passing_1\n8,0\n16,1\n",
              "mm must be divided by 1000"),
    gradation("sand_in_mm", HEADER + "0.5,0\n2,1\n", "Specimen/side",
              "mm must be divided by 1000"),
]


def shape(name, text, *message):
    """A folder with one broken shape file, used by a case."""
    return Bad("shape_" + name, CASE, ["bad.json", *message],
               {"Specimen": {"shapes": "shapes"}}, {"shapes/bad.json": text})


SHAPES = [
    Bad("shapes_empty", CASE, ["shapes"], {"Specimen": {"shapes": "shapes"}},
        {"shapes/readme": "x"}),
    shape("syntax", "{"),
    shape("key_missing", json.dumps({"order": 0}), "co"),
    shape("count", json.dumps({**ROUND, "order": 3}), "coefficients"),
    shape("order", json.dumps({**ROUND, "order": 99}), "order"),
    shape("unit", json.dumps({**ROUND, "unit": "mile"}), "unit"),
    shape("text", json.dumps({**ROUND, "coefficients": ["a"]}),
          "coefficients"),
]


def fit(name, file, text, *message, order="8"):
    return Bad("fit_" + name, ["shape", "fit", file, "--order", order,
                               "--out", "s.json"], list(message),
               files={file: text} if text is not None else {})


GENERATE = ["--count", "1", "--seed", "1", "--out", "d"]
MESHES = [
    fit("open", "m.stl", stl(box_triangles(2)), "open"),
    fit("torus", "m.stl", stl(torus_triangles()), "centroid"),
    fit("overhang", "m.stl", stl(mushroom_triangles()), "star"),
    fit("unreadable", "m.stl", "this is no mesh\n", "m.stl"),
    fit("no_triangles", "m.stl", stl([]), "m.stl"),
    fit("ending", "m.xyz", "0 0 0\n", ".xyz"),
    fit("missing", "nowhere.stl", None, "nowhere.stl"),
    fit("order_high", "m.stl", stl(box_triangles()), "31", order="31"),
    fit("order_negative", "m.stl", stl(box_triangles()), "-1", order="-1"),
    fit("order_text", "m.stl", stl(box_triangles()), "many", order="many"),
    Bad("fit_from", ["shape", "fit", "m.stl", "--order", "8", "--out", "s.json",
                     "--from", "edges"], ["--from", "edges", "rays or vertices"],
        files={"m.stl": stl(box_triangles())}),
    Bad("fit_few_vertices", ["shape", "fit", "m.stl", "--order", "8", "--out",
                             "s.json", "--from", "vertices"],
        ["m.stl", "8 points", "81 coefficients"],
        files={"m.stl": stl(box_triangles())}),
    Bad("fit_without_out", ["shape", "fit", "m.stl", "--order", "8"],
        ["--out"], files={"m.stl": stl(box_triangles())}),
    Bad("shape_unknown", ["shape", "polish", "m.stl"], ["polish"]),
    *[Bad("generate_" + name, ["shape", "generate", *words], list(message),
          files={**{f"two/{i}.json": json.dumps(ROUND) for i in range(2)},
                 "full/x": "x"})
      for name, words, message in [
          ("seed", ["two", "--count", "1", "--out", "d"], ["--seed K"]),
          ("sample", ["two", *GENERATE], ["2 shapes", "at least 3"]),
          ("missing", ["nowhere", *GENERATE], ["nowhere", "no such folder"]),
          ("count", ["two", "--count", "0", "--seed", "1", "--out", "d"],
           ["--count is 0", "1 .. 100000"]),
          ("full", ["two", "--count", "1", "--seed", "1", "--out", "full"],
           ["full", "not empty"])]],
    Bad("info_missing", ["shape", "info", "nowhere.json"], ["nowhere.json"]),
]

BENCH = ["bench", "--packing", "p.csv"]
PACKING = "x,y,z,radius\n0.005,0.005,0.005,0.005\n"


def packing(name, text, *message, words=()):
    """A packing for the benchmark, and words after it."""
    return Bad("bench_" + name, [*BENCH, *words], list(message),
               files={"p.csv": text})


PACKINGS = [
    packing("header", "x,y,z,r\n", "p.csv:1", "header", "x,y,z,radius"),
    packing("text", PACKING + "0.005,0.005,0.005,big\n", "p.csv:3", "big",
            "\"big\" must be a number"),
    packing("nan", PACKING + "nan,0.005,0.005,0.005\n", "p.csv:3",
            "\"nan\" must be a number"),
    packing("short", PACKING + "0.005,0.005,0.005\n", "p.csv:3",
            "has 3 cells, must have 4"),
    packing("negative", PACKING + "0.005,0.005,0.005,-0.005\n", "p.csv:3",
            "-0.005", "above 0"),
    packing("quaternion", "x,y,z,radius,qw,qx,qy,qz\n1,1,1,1,0,0,0,0\n",
            "p.csv:2", "length 1"),
    packing("box", "# box 1 1\n" + PACKING, "p.csv:1", "LX LY LZ"),
    packing("outside", "# box 1 0.001 1\n" + PACKING, "particle 1", "y = 0.005",
            "0.001"),
    packing("empty", "x,y,z,radius\n", "p.csv", "no particles"),
    packing("unstable", "# box 1 1 1\nx,y,z,radius\n1e-6,1e-6,1e-6,1e-6\n", "1e-06 s",
            "at most"),
    packing("steps", PACKING, "--steps 0", "whole number from 1",
            words=["--steps", "0"]),
    packing("threads", PACKING, "--threads two", "whole number",
            words=["--threads", "two"]),
    packing("repeat", PACKING, "--repeat -1", "whole number",
            words=["--repeat", "-1"]),
    packing("settle", PACKING, "--settle -1", "whole number from 0",
            words=["--settle", "-1"]),
    packing("scene", PACKING, "--scene flood", "rest, jolt or collapse",
            words=["--scene", "flood"]),
    packing("option", PACKING, "--fast", "--steps", words=["--fast"]),
    packing("no_value", PACKING, "--steps", "value must follow",
            words=["--steps"]),
    packing("breakage", PACKING, "--breakage", "--shapes",
            words=["--breakage"]),
    packing("copies", PACKING, "--copies 2", "--shapes DIR",
            words=["--copies", "2"]),
    packing("shapes", PACKING, "nowhere", "no such folder",
            words=["--shapes", "nowhere"]),
    packing("json", PACKING, "nowhere/a.json", "cannot be written",
            words=["--json", "nowhere/a.json"]),
    packing("save", PACKING, "nowhere/b.csv", "cannot be written",
            words=["--save", "nowhere/b.csv"]),
    Bad("bench_missing", BENCH, ["p.csv", "no such file"]),
    Bad("bench_folder", ["bench", "--packing", "."], ["folder"]),
    Bad("bench_nothing", ["bench"], ["--packing"]),
    Bad("bench_cut_off", ["bench", "--packing", "p.csv.gz"],
        ["p.csv.gz", "cut off"],
        files={"p.csv.gz": gzip.compress(PACKING.encode())[:-6]}),
]

LAB = {"Case": {"kind": "single_particle"}}


def lab(name, sections, *message):
    """A case of another kind."""
    return Bad("lab_" + name, ["check", "lab.prm"], list(message),
               files={"lab.prm": prm({**LAB, **sections})})


def compaction(name, sections, *message):
    return Bad("compaction_" + name, ["check", "c.prm"], list(message),
               files={"c.prm": prm({"Case": {"kind": "vibratory_compaction"},
                                    **sections})})


LABS = [
    lab("section", {"Drum": {"turns": 1}}, "Drum/turns", "single_particle",
        "no section Drum"),
    lab("other_section", {"Particle": {"displacement": 0.001}},
        "no key of this name in section Particle: it is in Press"),
    Bad("kind_by_default", ["check", "k.prm"],
        ["k.prm:2: Drum/radius", "kind dynamic_triaxial (the default: set "
         "Case/kind) has no section Drum"],
        files={"k.prm": prm({"Drum": {"radius": 0.3}})}),
    Bad("fill_beyond_box", ["check", "f.prm"],
        ["f.prm:12: Fill/upper = 1, 1, 3: must be inside the box, up to "
         "Box/upper = 1, 1, 2"],
        files={"f.prm": prm({"Case": {"kind": "scene"},
                             "Box": {"z": "rigid", "upper": "1, 1, 2"},
                             "Fill": {"mass": 1, "gradation": "g.csv",
                                      "lower": "0, 0, 0",
                                      "upper": "1, 1, 3"}})}),
    lab("shape", {"Particle": {"shape": "none.json"}},
        "Particle/shape = none.json", "no such file"),
    lab("axis", {"Particle": {"seed": 0, "axis_z": 0}}, "Particle/axis_z",
        "must not be zero"),
    lab("far", {"Press": {"displacement": 0.5}}, "Press/displacement = 0.5",
        "must be below"),
    lab("step", {"Time": {"fixed_step": 1}}, "Time/fixed_step = 1", "at most"),
    lab("rule", {"Time": {"step": "error"}}, "Time/step = error", "stable"),
    lab("law", {"Wall": {"law": "rubber"}}, "Wall/law = rubber",
        "must be one of hertz, "),
    lab("drum", {"Case": {"kind": "los_angeles"}, "Drum": {"radius": 0.05}},
        "Drum/", "must be"),
    lab("rolling", {"Case": {"kind": "los_angeles"},
                    "Wall": {"rolling_friction": 0.1}},
        "Wall/rolling_friction = 0.1", "must be 0"),
    compaction("small", {"Container": {"diameter": 0.05}},
               "Container/diameter = 0.05", "twice the largest particle"),
    compaction("low", {"Container": {"height": 0.05}},
               "Container/height = 0.05", "twice the largest particle"),
    compaction("dense", {"Filling": {"density": 2500}},
               "Filling/density = 2500", "0.75 Particle/density"),
    compaction("gradation", {"Filling": {"gradation": "none.csv"}},
               "Filling/gradation = none.csv", "no such file"),
    compaction("layers", {"Filling": {"layers": 100}, "Container": {
        "diameter": 0.09, "height": 0.09}}, "Filling/layers = 100",
               "number of particles"),
    compaction("reports", {"Vibration": {"reports": "50 20"}},
               "Vibration/reports = 50 20", "ascending"),
    compaction("words", {"Vibration": {"reports": "soon"}},
               "Vibration/reports = soon", "numbers"),
    compaction("attracts", {"Wall": {"law": "dmt"}, "Plate": {
        "form": "elastic"}, "Coupling": {"exchange": "one_pass"}},
        "Wall/law = dmt", "must not attract"),
    lab("deep", {"Wall": {"law": "dmt"}, "Contact": {
        "wall_geometry": "surface"}}, "Contact/wall_geometry = surface",
        "must be sphere or radial with the law dmt"),
    compaction("mass", {"Plate": {"mass": 0}}, "Plate/mass = 0", "above 0"),
    compaction("frequency", {"Vibration": {"frequency": -1}},
               "Vibration/frequency = -1", "above 0"),
    compaction("step", {"Time": {"step": "fixed", "fixed_step": 1e-2}},
               "Time/fixed_step = ", "a twentieth of the period"),
    compaction("rule", {"Time": {"step": "error"}}, "Time/step = error",
               "stable"),
    compaction("section", {"Specimen": {"side": 1}}, "Specimen/side",
               "vibratory_compaction", "no section Specimen"),
    compaction("coupling", {"Container": {"form": "flexible"}},
               "Coupling/exchange = none", "Container/form = flexible",
               "every_step"),
]

CASES = (LABS + VALUES + SCENE + WORDS + FILES + GRADATIONS + SHAPES + PACKINGS
         + MESHES)
