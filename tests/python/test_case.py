"""Cases are checked by the lists of the program, written and read again."""
import copy
import os
import pathlib
import tempfile

import numpy as np

import spall
from samples import DATA, ROOT, InFolder

# A membrane needs one, which has no default.
EXCHANGE = "subsection Coupling\n  set exchange = every_step\nend\n"
KINDS = ("dynamic_triaxial", "single_particle", "los_angeles",
         "vibratory_compaction", "subgrade", "scene")


class Templates(InFolder):
    def test_every_kind(self):
        for kind in KINDS:
            with self.subTest(kind=kind):
                case = spall.Case.from_template(kind)
                self.assertEqual(case["Case/kind"], kind)
                self.assertEqual(set(case.changed()) - set(case), set())
                self.assertTrue(all(case.parameter(name).sentence
                                    for name in case))

    def test_unknown_kind(self):
        with self.assertRaisesRegex(spall.InputError, "kind must be one of "
                                    "dynamic_triaxial"):
            spall.Case.from_template("triaxial")

    def test_preset(self):
        plain = spall.Case.from_template("dynamic_triaxial")
        fast = spall.Case.from_template("dynamic_triaxial", preset="fast")
        self.assertNotEqual(plain.changed(), fast.changed())
        with self.assertRaisesRegex(spall.InputError, "preset=quick.*fast"):
            plain.apply_preset("quick")


class Values(InFolder):
    def setUp(self):
        super().setUp()
        self.case = spall.Case("dynamic_triaxial")

    def test_set_and_unset(self):
        usual = self.case["Loading/frequency"]
        self.case["Loading/frequency"] = 20
        self.case["Specimen/seed"] = 2
        self.case["Breakage/is_active"] = False
        self.assertEqual(self.case["Loading/frequency"], 20.0)
        self.assertIsInstance(self.case["Loading/frequency"], float)
        self.assertIs(self.case["Breakage/is_active"], False)
        self.assertEqual(self.case.unit("Loading/frequency"), "Hz")
        other = self.case.copy()
        del self.case["Loading/frequency"]
        self.assertEqual(self.case["Loading/frequency"], usual)
        self.assertEqual(other["Loading/frequency"], 20.0)
        self.assertEqual(self.case.get("Loading/none", 7), 7)

    def test_what_is_not_allowed(self):
        for name, value, what in (
                ("Loading/frequency", -1, "Loading/frequency = -1: must be a "
                                          "number above 0"),
                ("Loading/frequency", "fast", "must be a number above 0"),
                ("Loading/frequency", float("nan"), "must be a number"),
                ("Loading/cycles", 2.5, "must be a whole number"),
                ("Loading/cycles", True, "must be a whole number"),
                ("Breakage/is_active", 1, "must be true or false"),
                ("Boundary/lateral", "elastic", "one of membrane, rigid"),
                ("Case/title", "two\nlines", "must be one line"),
                ("Case/kind", "scene", "from_template"),
                ("Loading/frequncy", 1, "did you mean frequency"),
                ("Loadin/frequency", 1, "did you mean Loading"),
                ("frequency", 1, "must be Section/key"),
                (3, 1, "^3: must be Section/key"),
                (None, 1, "must be Section/key"),
                ("Case/title", None, "Case/title = None: must be one line"),
                ("Case/title", ["a"], "must be one line"),
                ("Specimen/gradation", np.ones(2), "must be one line"),
                ("Loading/frequency", np.True_, "must be a number above 0"),
                ("Loading/cycles", "1_0", "must be a whole number"),
                ("Loading/zzz", 1, "; there are .*frequency"),
                ("Zzz/frequency", 1, "; there are .*Loading"),
                ("Scene/duration", 1, "has no section Scene")):
            with self.subTest(name=name, value=value), \
                    self.assertRaisesRegex(spall.InputError, what):
                self.case[name] = value
        self.assertEqual(self.case.changed(), {})

    def test_relations_are_checked_by_the_program(self):
        with self.assertRaisesRegex(spall.InputError, "Coupling/exchange"):
            self.case.validate()
        self.case["Coupling/exchange"] = "every_step"
        self.case.validate()
        self.case["Specimen/gradation"] = "no_such_file.csv"
        with self.assertRaisesRegex(spall.InputError, "no_such_file.csv"):
            self.case.validate()

    def test_material_file(self):
        text = ("subsection Particle\n  set density = 3000\n"
                "  set friction = 0.75\nend\n")
        self.case["Particle/friction"] = 0.25
        self.case["Material/file"] = self.file("basalt.prm", text)
        self.assertEqual(self.case["Particle/density"], 3000.0)
        self.assertEqual(self.case["Particle/friction"], 0.25)
        self.assertEqual(self.case["Material/file"], "")

    def test_walls(self):
        case = spall.Case("scene")
        case["Walls/lid/velocity"] = (0, 0, -0.1)
        case["Wall/friction"] = 0.125
        self.assertEqual(case.walls, ["lid"])
        self.assertEqual(case["Walls/lid/friction"], 0.125)
        self.assertIn("Walls/lid/mesh", list(case))
        with self.assertRaisesRegex(spall.InputError, "letters, digits"):
            case["Walls/a lid/mass"] = 1
        case.remove_wall("lid")
        self.assertEqual(case.changed(), {"Wall/friction": 0.125})


    def test_all_back_to_the_defaults(self):
        case = spall.Case("scene")
        case["Walls/lid/velocity"] = (0, 0, -0.1)
        case["Scene/duration"] = 2
        case.clear()
        self.assertEqual((case.changed(), case.walls, case.kind),
                         ({}, [], "scene"))
        with self.assertRaisesRegex(TypeError, "always has all keys"):
            case.popitem()

    def test_copies_are_independent(self):
        self.case["Loading/cycles"] = 3
        for function in (copy.copy, copy.deepcopy, spall.Case.copy):
            other = function(self.case)
            other["Loading/cycles"] = 5
            self.assertEqual(self.case["Loading/cycles"], 3)
            self.assertEqual(other["Loading/cycles"], 5)

    def test_files_that_are_missing(self):
        case = spall.Case("scene")
        case["Scene/particles"] = "no_such_file.csv"
        for verb in (case.check, lambda: case.run(self.folder / "run")):
            with self.assertRaisesRegex(
                    spall.InputError, "^Scene/particles = no_such_file.csv: "
                    "no such file or folder, looked in the current folder, "
                    "/") as caught:
                verb()
            self.assertNotIn(tempfile.gettempdir() + "/tmp",
                             str(caught.exception))
        case["Scene/particles"] = "~/p.csv"
        self.assertEqual(case["Scene/particles"],
                         os.path.expanduser("~/p.csv"))


class Files(InFolder):
    def test_every_case_of_the_data(self):
        files = sorted((ROOT / "data" / "cases").glob("*.prm"))
        self.assertGreater(len(files), 10)
        for k, path in enumerate([*files, DATA / "small_membrane.prm"]):
            with self.subTest(case=path.name):
                case = spall.Case.read(path)
                again = self.folder / ("copy.prm", "copy.json")[k % 2]
                case.write(again)
                self.assertEqual(dict(spall.Case.read(again)), dict(case))

    def test_paths_are_those_of_the_file(self):
        self.file("g.csv", "diameter_m,passing_1\n0.01,0\n0.02,1\n")
        path = self.file("a.prm", "subsection Specimen\n"
                                  "  set gradation = g.csv\nend\n" +
                         EXCHANGE)
        case = spall.Case.read(path)
        self.assertEqual(case["Specimen/gradation"],
                         str((self.folder / "g.csv").resolve()))
        # Of the data folder: stays as it is.
        case["Specimen/gradation"] = "gradations/quick_7_22mm.csv"
        (self.folder / "b").mkdir()
        case.write(self.folder / "b" / "b.prm")
        self.assertEqual(
            spall.Case.read(self.folder / "b" / "b.prm")["Specimen/gradation"],
            "gradations/quick_7_22mm.csv")

    def test_deprecated_names(self):
        path = self.file("a.prm", "subsection Stone\n"  # deprecated
                                  "  set friction = 0.3\nend\n" +
                         EXCHANGE)
        with self.assertWarnsRegex(FutureWarning, "use Particle/friction"):
            case = spall.Case.read(path)
        self.assertEqual(case["Particle/friction"], 0.3)

    def test_faults(self):
        case = spall.Case("scene")
        with self.assertRaisesRegex(spall.InputError, "ends in .prm or"):
            case.write(self.folder / "a.txt")
        with self.assertRaisesRegex(spall.InputError, "a.prm:1"):
            spall.Case.read(self.file("a.prm", "nothing\n"))


class Program(InFolder):
    def test_program_that_is_none(self):
        import os
        from unittest import mock
        with mock.patch.dict(os.environ, {"SPALL": str(self.folder)}), \
                self.assertRaisesRegex(spall.InputError, "is no program"):
            spall.find_program()

    def test_version(self):
        self.assertRegex(spall.version(), r"^\d+\.\d+(\.\d+)?$")
        self.assertTrue(pathlib.Path(spall.find_program()).is_file())
