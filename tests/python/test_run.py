"""Runs are started, followed, read and compared."""
import os
import shutil
import subprocess
import unittest
from unittest import mock

import numpy as np

import spall
from samples import DATA, InFolder, needs, two_particles
from spall.mesh import signed_volume
from spall.program import follow

MPIRUN = shutil.which("mpirun")
# Prints lines of progress until it is asked to stop.
SLOW = """#!/bin/sh
trap 'echo stopped > "$FOLDER/stopped"; exit 0' TERM
echo "2 particles, time step 2e-06 s"
echo "preparation     0.0 %         0 steps/s"
echo "loading        50.0 %       100 steps/s  0:07 left  cycle 1"
while :; do sleep 0.1; done
"""
FAILING = """#!/bin/sh
echo "spall: a.prm:3: deprecated key Stone/x: use Particle/x" >&2
echo "spall: membrane: at 0.1 s: folded" >&2
echo "mpirun detected that a process ended" >&2
exit %d
"""


def small_triaxial():
    """A hundred particles between rigid sides, two short cycles: a second."""
    case = spall.Case.read(DATA / "small_membrane.prm")
    case["Boundary/lateral"] = "rigid"
    case["Loading/frequency"] = 200
    case["Output/surfaces"] = "all"
    case["Output/frames_per_cycle"] = 1
    return case


class Shared(InFolder):
    """Runs that several tests read are made once."""

    @classmethod
    def setUpClass(cls):
        import tempfile
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        root = __import__("pathlib").Path(cls.scratch.name)
        cls.case = small_triaxial()
        cls.run_ = cls.case.run(root / "first")
        other = cls.case.copy()
        other["Particle/friction"] = 0.1
        cls.other = other.run(root / "other")
        cls.two = two_particles(spall, root).run(root / "two")


class Reading(Shared):
    def test_case(self):
        case = self.run_.case
        self.assertEqual(case["Loading"]["frequency"], 200.0)
        self.assertEqual(case.unit("Loading/frequency"), "Hz")
        self.assertEqual(self.run_.kind, "dynamic_triaxial")
        written = spall.Case.read(self.run_.folder / "case.prm")
        for name in ("Loading/frequency", "Particle/friction"):
            self.assertEqual(written[name], self.case[name])

    def test_tables(self):
        run = self.run_
        self.assertTrue(run.is_complete)
        self.assertEqual(run.history.unit("axial_stress"), "Pa")
        self.assertEqual(run.cycles["cycle"].tolist(), [1.0, 2.0])
        self.assertLess(run.loading.n_rows, run.history.n_rows)
        self.assertAlmostEqual(run.summary["permanent_axial_strain"],
                               run.cycles["permanent_axial_strain"][-1])
        self.assertEqual(run.summary.unit("peak_axial_stress"), "Pa")
        self.assertEqual(run.events.unit("released_energy"), "J")
        self.assertEqual(run.events.n_rows, run.summary["n_events"])
        self.assertIn("boundary_profile_end", run.table_names)
        self.assertGreater(run.table("boundary_profile_end").n_rows, 1)
        self.assertIn("particles, time step", run.log)
        self.assertIsInstance(run.warnings, list)

    def test_missing_tables_and_folders(self):
        with self.assertRaisesRegex(spall.InputError, "has no cycles.csv; this"
                                    " run of kind scene has .*history"):
            _ = self.two.cycles
        with self.assertRaisesRegex(spall.InputError, "is no run folder"):
            spall.Run(self.folder)
        with self.assertRaisesRegex(spall.InputError, "loops need a run of"):
            self.two.plot.loops()

    def test_frames(self):
        run = self.run_
        self.assertEqual(len(run.frames), 3)
        self.assertEqual(sorted(run.frames[0].files),
                         ["contacts", "particles", "surfaces"])
        times = [frame.time for frame in run.frames]
        self.assertEqual(times, sorted(times))
        particles = run.particles()
        self.assertEqual(particles["id"].tolist(),
                         list(range(run.summary["n_particles"])))
        self.assertEqual(particles["position"].shape, (particles.n_rows, 3))
        self.assertEqual(particles.unit("velocity"), "m/s")
        np.testing.assert_allclose(
            np.linalg.norm(particles["orientation"], axis=1), 1, rtol=1e-6)
        contacts = run.contacts()
        length = np.linalg.norm(contacts["to"] - contacts["from"], axis=1)
        self.assertTrue(np.all((length > 0) & (length < 0.05)))
        # A dashpot may cancel a spring but for its last digits.
        force = contacts["normal_force"]
        self.assertTrue(np.all(force >= -1e-6 * force.max()))
        with self.assertRaisesRegex(spall.InputError, "no membrane, it has"):
            run.frame().read("membrane")
        with self.assertRaisesRegex(spall.InputError, "Output/surfaces"):
            self.two.write_mesh(0, self.folder / "a.stl")

    @needs("vtkmodules")
    def test_frames_are_as_vtk_reads_them(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        frame = self.run_.frame()
        for part in frame.files:
            grid, vtk = frame.read(part), frame.vtk(part)
            np.testing.assert_array_equal(
                grid.points, vtk_to_numpy(vtk.GetPoints().GetData()))
            cells = vtk.GetCells()
            np.testing.assert_array_equal(
                grid.connectivity,
                vtk_to_numpy(cells.GetConnectivityArray()))
            for data, of in ((grid.point_data, vtk.GetPointData()),
                             (grid.cell_data, vtk.GetCellData())):
                self.assertEqual(len(data), of.GetNumberOfArrays())
                for name, values in data.items():
                    np.testing.assert_array_equal(
                        values, vtk_to_numpy(of.GetArray(name)))

    def test_meshes_have_the_volume_of_the_particles(self):
        run = self.run_
        volume = run.particles()["volume"].sum()
        run.write_mesh(-1, self.folder / "specimen.stl", scale=1000)
        data = (self.folder / "specimen.stl").read_bytes()
        rows = np.frombuffer(data, [("normal", "<f4", 3),
                                    ("corners", "<f4", (3, 3)),
                                    ("none", "<u2")], offset=84)
        points = rows["corners"].reshape(-1, 3)
        found = signed_volume(points, np.arange(len(points)).reshape(-1, 3))
        # The corners of 1280 facets are on the surface, the facets inside.
        self.assertLess(0.98 * volume, 1e-9 * found)
        self.assertLess(1e-9 * found, volume)
        run.write_mesh(-1, self.folder / "specimen.ply")
        self.assertGreater((self.folder / "specimen.ply").stat().st_size,
                           1e5)

    @needs("matplotlib")
    def test_charts(self):
        run = self.run_
        axes = run.plot.loops()
        self.assertEqual(axes.get_ylabel(), "Deviator stress (kPa)")
        self.assertEqual(len(axes.lines[0].get_xdata()), run.loading.n_rows)
        self.assertEqual(len(run.plot.loops(cycles=[1, 2]).lines), 2)
        self.assertEqual(len(run.plot.loops(cycles=2).lines), 1)
        axes = run.plot.history("axial_stress", "lateral_stress")
        self.assertEqual(axes.get_xlabel(), "Time (s)")
        axes = run.plot.permanent_strain()
        np.testing.assert_allclose(
            axes.lines[0].get_ydata(),
            100 * run.cycles["permanent_axial_strain"])
        with self.assertRaisesRegex(spall.InputError, "different units"):
            run.plot.history("axial_stress", "axial_strain")
        with self.assertRaisesRegex(spall.InputError, "no cycle 7"):
            run.plot.loops(cycles=[7])

    def test_folder_that_is_run_again(self):
        folder = self.folder / "run"
        shutil.copytree(self.two.folder, folder)
        (folder / "summary.json").unlink()
        run = spall.Run(folder)
        history = folder / "history.csv"
        text = history.read_text().splitlines(keepends=True)
        history.write_text("".join(text[:3]))
        short = run.history.n_rows
        history.write_text("".join(text))
        self.assertEqual(run.history.n_rows, short)  # until it is asked to
        run.refresh()
        self.assertGreater(run.history.n_rows, short)
        for name in ("case.prm", "summary.json"):
            history.write_text("".join(text[:3]))
            run.refresh()
            self.assertEqual(run.history.n_rows, short)
            history.write_text("".join(text))
            shutil.copy(self.two.folder / name, folder / name)
            os.utime(folder / name, ns=(1, 1))
            self.assertGreater(run.history.n_rows, short, name)
        before = run.history
        shutil.rmtree(folder)
        self.assertIs(run.history, before)

    def test_folder_is_absolute(self):
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.two.folder.parent)
        run = spall.Run(self.two.folder.name)
        os.chdir(here)
        self.assertGreater(run.history.n_rows, 0)
        self.assertTrue(run.folder.is_absolute())

    def test_missing_packages_are_named(self):
        with mock.patch.dict("sys.modules", {"matplotlib": None,
                                             "matplotlib.pyplot": None}), \
                self.assertRaisesRegex(spall.MissingPackage,
                                       "apt install python3-matplotlib"):
            self.run_.plot.loops()

    def test_comparison(self):
        compared = spall.compare([self.run_, self.other.folder])
        self.assertEqual(compared.differences,
                         {"Particle/friction": [
                             self.case["Particle/friction"], 0.1]})
        table = compared.table
        self.assertEqual(table["run"].tolist(), ["first", "other"])
        self.assertEqual(
            table["permanent_axial_strain"].tolist(),
            [one.summary["permanent_axial_strain"]
             for one in (self.run_, self.other)])
        self.assertEqual(table.unit("peak_axial_stress"), "Pa")
        self.assertEqual(table.unit("Particle/friction"), "1")

    def test_units_of_compared_keys(self):
        other = self.folder / "other"
        shutil.copytree(self.two.folder, other)
        case = other / "case.prm"
        case.write_text(case.read_text().replace("set duration = 0.1",
                                                 "set duration = 0.2"))
        table = spall.compare([self.two, other]).table
        self.assertEqual(table["Scene/duration"].tolist(), [0.1, 0.2])
        self.assertEqual(table.unit("Scene/duration"), "s")
        self.assertEqual(table.rows([0]).unit("Scene/duration"), "s")


class Running(InFolder):
    def test_two_particles(self):
        run = two_particles(spall, self.folder).run(self.folder / "run")
        velocity = run.particles()["velocity"]
        # Of equal mass: momentum is conserved, the contact has ended.
        self.assertAlmostEqual(velocity[:, 0].sum(), 0.2, places=5)
        self.assertLess(velocity[0, 0], velocity[1, 0])

    def test_input_errors(self):
        case = two_particles(spall, self.folder)
        (self.folder / "full").mkdir()
        (self.folder / "full" / "a.txt").touch()
        with self.assertRaisesRegex(spall.InputError, "files that are not a run"):
            case.run(self.folder / "full")
        with self.assertRaisesRegex(spall.InputError, "ranks = 0"):
            case.run(self.folder / "run", ranks=0)

    def test_folder_of_relative_path(self):
        case = two_particles(spall, self.folder)
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.folder)
        with mock.patch("spall.case.follow", side_effect=lambda *words: (
                os.chdir(here), follow(*words))):
            run = case.run("run")
        self.assertEqual(run.folder, self.folder / "run")

    def test_notes_on_unusual_values(self):
        case = two_particles(spall, self.folder)
        case["Particle/density"] = 20
        with self.assertWarnsRegex(UserWarning, "^Particle/density = 20: "
                                   "unusual") as caught:
            case.run(self.folder / "run")
        self.assertEqual(len(caught.warnings), 1)
        self.assertEqual(caught.filename, __file__)
        with self.assertWarnsRegex(UserWarning, "^Particle/density = 20: "
                                   "unusual"):
            case.validate()

    def test_run_errors(self):
        case = small_triaxial()
        case["Preparation/max_time"] = 1e-4
        with self.assertRaisesRegex(spall.RunError, "rest") as caught:
            case.run(self.folder / "run")
        self.assertEqual(caught.exception.status, 2)

    def test_resumed(self):
        case = small_triaxial()
        case["Loading/cycles"] = 1
        case["Output/surfaces"] = "none"
        first = case.run(self.folder / "run")
        self.assertEqual(first.cycles.n_rows, 1)
        case["Loading/cycles"] = 2
        again = case.run(self.folder / "run", resume=True)
        self.assertEqual(again.cycles["cycle"].tolist(), [1.0, 2.0])
        # The folder has another summary than when it was read.
        self.assertEqual(first.cycles.n_rows, 2)

    @unittest.skipUnless(MPIRUN, "mpirun is not installed")
    def test_on_two_ranks(self):
        launched = {"OMPI_ALLOW_RUN_AS_ROOT": "1",
                    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        case = two_particles(spall, self.folder)
        with mock.patch.dict(os.environ, launched):
            both = case.run(self.folder / "both", ranks=2, mpirun="mpirun "
                            "--oversubscribe --bind-to none")
        one = case.run(self.folder / "one")
        self.assertEqual(both.summary["ranks"], 2)
        for name in one.history:
            np.testing.assert_array_equal(both.history[name],
                                          one.history[name])

    def test_study(self):
        two_particles(spall, self.folder).write(self.folder / "two.prm")
        study = self.file("sweep.prm", f"""subsection Study
  set case = {self.folder / "two.prm"}
  set outcomes = energy_residual_ratio_1
end
subsection Sweep
  set Particle/friction = 0.2, 0.4
end
""")
        subprocess.run([os.environ["SPALL"], "study", str(study), "--jobs",
                        "1", "--out", str(self.folder / "study")], check=True,
                       stdout=subprocess.DEVNULL)
        read = spall.Study(self.folder / "study")
        self.assertEqual(read.keys, ["Particle/friction"])
        self.assertEqual(read.outcomes, ["energy_residual_ratio"])
        self.assertEqual(sorted(set(read.table["Particle/friction"])),
                         [0.2, 0.4])
        for run, friction in zip(read, read.table["Particle/friction"]):
            self.assertEqual(run.case["Particle/friction"], friction)
        means = read.mean("energy_residual_ratio", "Particle/friction")
        self.assertEqual(means["n_cases"].sum(), len(read))
        self.check_units()
        with self.assertRaisesRegex(spall.InputError, "no folder of a study"):
            spall.Study(self.folder)


    def check_units(self):
        """Of a swept key, and of an outcome by its full name."""
        table = self.folder / "study" / "study.csv"
        table.write_text(table.read_text().replace(
            "Particle/friction", "Particle/density").replace(
            "energy_residual_ratio_1", "first_force_N"))
        read = spall.Study(self.folder / "study")
        self.assertEqual(read.table.unit("Particle/density"), "kg/m^3")
        self.assertEqual(read.unit("Particle/density"), "kg/m^3")
        for outcome in ("first_force_N", "first_force"):
            means = read.mean(outcome, by="Particle/density")
            for name, unit in (("Particle/density", "kg/m^3"),
                               ("first_force", "N"),
                               ("first_force_deviation", "N")):
                self.assertEqual(means.unit(name), unit)


class Following(InFolder):
    """With programs that stand for spall."""

    def program(self, text):
        path = self.file("program", text)
        path.chmod(0o755)
        return str(path)

    def follow(self, text, progress=None):
        from spall.program import follow
        with mock.patch.dict(os.environ, {"FOLDER": str(self.folder)}):
            follow([self.program(text)], progress)

    def test_stopped_by_the_callback(self):
        seen = []

        def progress(step):
            seen.append((step.phase, step.share, step.seconds_left))
            if step.share > 0.4:
                raise ValueError("enough")

        with self.assertRaisesRegex(ValueError, "enough"):
            self.follow(SLOW, progress)
        self.assertEqual(seen, [("preparation", 0.0, None),
                                ("loading", 0.5, 7.0)])
        # It was asked, and had the time to write its checkpoint.
        self.assertTrue((self.folder / "stopped").exists())

    def test_the_line_of_the_program(self):
        for status, error in ((1, spall.InputError), (2, spall.RunError)):
            with self.assertWarnsRegex(FutureWarning, "use Particle/x"), \
                    self.assertRaisesRegex(error, "^membrane: at 0.1 s: "
                                           "folded$"):
                self.follow(FAILING % status)
        with self.assertRaisesRegex(spall.RunError, "signal 9: no message"):
            self.follow("#!/bin/sh\nkill -9 $$\n")
