"""Parameters are found again from what they have produced."""
import pathlib
import tempfile

import numpy as np

import spall
from samples import ROOT, InFolder, needs
from spall.evaluations import fitted_parameters

TRUTH = 4e9  # shear modulus [Pa]


def pressed_particle():
    """A limestone between platens, whose orientation is the seed's."""
    case = spall.Case.read(ROOT / "data" / "cases" / "single_particle.prm")
    case["Particle/order"] = 6
    case["Breakage/is_active"] = False
    case["Press/displacement"] = 5e-5
    case["Press/speed"] = 0.05
    return case


class Targets(InFolder):
    def run_with(self, text, name="cycles"):
        self.file("case.prm", "subsection Case\n  # [-] Allowed: one of a.\n"
                              "  set kind = a\nend\n")
        self.file(f"{name}.csv", text)
        self.file("summary.json", '{"peak_N": 3.5}')
        return spall.Run(self.folder)

    def test_curve(self):
        run = self.run_with("cycle_1,strain_1\n1,0.1\n3,0.3\n2,9\n4,0.5\n")
        curve = spall.Curve("cycle", "strain", {1: 0.2, 2: 0.25, 3.5: 0.4})
        np.testing.assert_allclose(curve.computed(run), [0.1, 0.2, 0.4])
        np.testing.assert_array_equal(curve.deviations(), [0.4] * 3)
        beyond = spall.Curve("cycle", "strain", {5: 0.2})
        with self.assertRaisesRegex(spall.InputError, "does not reach"):
            beyond.computed(run)

    def test_value(self):
        run = self.run_with("a\n1\n")
        self.assertEqual(spall.Value("peak", 3.0).computed(run).tolist(),
                         [3.5])
        self.assertEqual(spall.Value("peak", 3.0).deviations().tolist(),
                         [3.0])
        with self.assertRaisesRegex(spall.InputError, "above 0"):
            spall.Value("peak", 3.0, deviation=0).deviations()

    def test_values_that_are_no_numbers(self):
        for make, what in (
                (lambda: spall.Value("peak", "3"), "peak = '3': must be a fin"),
                (lambda: spall.Value("peak", float("nan")), "peak = nan"),
                (lambda: spall.Value("peak", 3.0, "a").deviations(),
                 "deviation = 'a': must be a number"),
                (lambda: spall.Curve("x", "y", [1, 2]), "must be a dictionary"),
                (lambda: spall.Curve("x", "y", {1: None}), "y at 1 = None"),
                (lambda: spall.Curve("x", "y", {1: 2}, deviation=[1, 2, 3])
                 .deviations(), "or 1 numbers")):
            with self.assertRaisesRegex(spall.InputError, what):
                make()

    def test_units_and_labels(self):
        run = self.run_with("cycle_1,strain_1,force_N\n1,0.1,2\n")
        curve = spall.Curve("cycle", "force", {1: 2.0})
        self.assertEqual((curve.labels(), curve.unit(run)),
                         (["force at cycle 1"], "N"))
        peak = spall.Value("peak", 3.0)
        self.assertEqual((peak.labels(), peak.unit(run)), (["peak"], "N"))


class Ranges(InFolder):
    def test_ranges(self):
        case = pressed_particle()
        one, two = fitted_parameters(case, {
            "Particle/friction": (0.2, 0.6),
            ("Particle/density", "Wall/friction"): (1, 1.5, 2)})
        self.assertEqual((one.lower, one.start, one.upper), (0.2, 0.4, 0.6))
        self.assertEqual(two.name, "Particle/density")
        self.assertEqual(two.keys, ("Particle/density", "Wall/friction"))
        self.assertEqual(one.value(0.25), 0.3)
        for ranges, what in (
                ({"Particle/friction": (-1, 1)}, "Particle/friction = -1"),
                ({"Particle/friction": (1, 0)}, "must be .lower, upper."),
                ({"Particle/frict": (0, 1)}, "did you mean friction"),
                ({"Particle/order": (1, 9)}, "only numbers"),
                ({"Particle/friction": 0.5}, "the range 0.5 must be"),
                ({"Particle/friction": ("a", "b")}, "must be a finite"),
                (["Particle/friction"], "must be a dictionary"),
                ({}, "no parameter")):
            with self.assertRaisesRegex(spall.InputError, what):
                fitted_parameters(case, ranges)


@needs("scipy")
class Fits(InFolder):
    """All in one folder, so that sets that several fits need run once."""

    NAME = "Particle/shear_modulus"

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.common = pathlib.Path(scratch.name)
        at = 0.99 * np.array([2e-5, 3.5e-5, 5e-5])
        curve = spall.Curve("displacement", "force", dict.fromkeys(at, 0.0),
                            table="history")
        case, found = pressed_particle(), []
        case[cls.NAME] = TRUTH
        for seed in (1, 2):
            case["Particle/seed"] = seed
            found.append(curve.computed(case.run(cls.common / f"t{seed}")))
        cls.target = spall.Curve("displacement", "force",
                                 dict(zip(at, np.mean(found, axis=0))),
                                 table="history")

    def fit(self, **options):
        options = {"seeds": (1, 2), "folder": self.common / "fit", **options}
        return spall.calibrate(pressed_particle(), self.target,
                               {self.NAME: (1e9, 8e9)}, **options)

    def times(self):
        return {path: path.stat().st_mtime_ns
                for path in self.common.glob("fit/set_*/*/summary.json")}

    def test_the_modulus_is_found_again(self):
        for method in ("least_squares", "nelder_mead"):
            with self.subTest(method=method):
                lines = []
                found = self.fit(method=method, progress=lines.append)
                # The tolerance is 2 % of the range, 3.5 % of the truth.
                self.assertAlmostEqual(found.values[self.NAME] / TRUTH, 1,
                                       delta=0.035)
                self.assertLess(found.residual, 0.03)
                self.assertEqual(found.case[self.NAME],
                                 found.values[self.NAME])
                self.assertEqual([run.case["Particle/seed"]
                                  for run in found.runs], [1, 2])
                self.assertEqual(len(lines), found.table.n_rows)
        before = self.times()
        self.assertEqual(self.fit(method=method).values, found.values)
        self.assertEqual(self.times(), before)

    def test_uncertainty(self):
        """Of two seeds: half of what their own optima differ by."""
        found = self.fit()
        own = found.per_seed[self.NAME]
        self.assertAlmostEqual(found.uncertainty[self.NAME],
                               abs(own[0] - own[1]) / 2, delta=1.0)
        alone = self.fit(seeds=(1,))
        self.assertTrue(np.isnan(alone.uncertainty[self.NAME]))
        # A linear estimate of what the fit of this seed finds.
        self.assertAlmostEqual(own[0] / alone.values[self.NAME], 1, delta=0.2)

    def test_budget_and_input(self):
        found = self.fit(max_sets=2)
        self.assertEqual(found.message, "stopped after 2 sets")
        self.assertIn("Pa", str(found))
        last = list(found.table)[-1]
        self.assertRegex(last, "^force at displacement 4.95e-05$")
        self.assertEqual([found.table.unit(name) for name in
                          (self.NAME, "residual", last)], ["Pa", "1", "N"])
        for options, what in (({"method": "guess"}, "must be one of least"),
                              ({"seeds": (1, 1)}, "must be different"),
                              ({"seeds": 3}, "seeds = 3: must be"),
                              ({"seeds": ("a",)}, "must be different"),
                              ({"jobs": 0}, "jobs = 0: must be a whole"),
                              ({"max_sets": 1.5}, "max_sets = 1.5"),
                              ({"step": "a"}, "step = 'a': must be a finite"),
                              ({"step": 0}, "step = 0")):
            with self.assertRaisesRegex(spall.InputError, what):
                self.fit(**options)
        for case, target, what in (
                ("case.prm", self.target, "must be a spall.Case"),
                (pressed_particle(), "force", "target 'f': must be"),
                (pressed_particle(), 3.0, "target 3.0: must be")):
            with self.assertRaisesRegex(spall.InputError, what):
                spall.calibrate(case, target, {self.NAME: (1e9, 8e9)})
