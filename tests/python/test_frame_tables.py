"""Frames as HDF5 tables: against the ParaView files, the history of the run,
other numbers of ranks, and a run that was stopped and resumed."""
import pathlib
import shutil
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

import spall
from samples import MPIRUN, InFolder, needs, run_membrane, two_particles

HDF5 = "Output/frame_tables=hdf5"


def run_case(folder, *options, ranks=1):
    """Between rigid sides, two short cycles: a second."""
    return run_membrane(
        spall, folder,
        (HDF5, "Boundary/lateral=rigid", "Loading/frequency=200",
         "Output/frames_per_cycle=2", "Output/surfaces=none"), *options,
        ranks=ranks)


class Written(InFolder):
    """One run that all tests read."""

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.root = pathlib.Path(scratch.name)
        cls.run_ = run_case(cls.root / "whole")

    def bytes_of(self, run):
        return {frame.number: frame.path("tables").read_bytes()
                for frame in run.frames}


@needs("h5py")
class Values(Written):
    def test_particles_are_those_of_the_vtu(self):
        for frame in self.run_.frames:
            tables, vtu = frame.tables().particles, frame.particles()
            self.assertEqual(tables["id"].tolist(), vtu["id"].tolist())
            for name in vtu:
                np.testing.assert_array_equal(
                    tables[name].astype(vtu[name].dtype), vtu[name], name)
                self.assertEqual(tables.unit(name), vtu.unit(name))

    def test_contacts_are_those_of_the_vtu(self):
        for frame in self.run_.frames:
            tables, vtu = frame.tables().contacts, frame.contacts()
            np.testing.assert_array_equal(
                np.sort(tables["overlap"].astype("f4")),
                np.sort(vtu["overlap"]))
            self.assertEqual((tables["kind"] == 0).sum(),
                             (vtu["kind"] == 0).sum())
            np.testing.assert_allclose(
                np.linalg.norm(tables["normal"], axis=1), 1, rtol=1e-14)
            self.assertEqual(tables.unit("shear_force"), "N")
            self.assertTrue(np.all(
                (tables["b_id"] == -1) == (tables["boundary"] >= 0)))

    def test_boundaries_have_the_forces_of_the_history(self):
        tables = self.run_.tables()
        contacts, names = tables.contacts, tables.boundaries["name"].tolist()
        self.assertEqual(tables.time, self.run_.history["time"][-1])
        force = contacts["shear_force"] - \
            contacts["normal_force"][:, None] * contacts["normal"]
        checked = 0
        for row, name in enumerate(names):
            on_it = contacts["boundary"] == row
            for axis, total in zip("xyz", -force[on_it].sum(axis=0)):
                column = f"{name}_force_{axis}"
                if column in self.run_.history:
                    asked = self.run_.history[column][-1]
                    self.assertAlmostEqual(
                        total, asked, delta=1e-9 * np.abs(force).sum())
                    checked += on_it.any()
        self.assertGreater(checked, 3)

    def test_removed_volume_is_the_abrasion(self):
        particles = self.run_.tables().particles
        removed, left = (particles[name].sum()
                         for name in ("removed_volume", "volume"))
        self.assertGreater(removed, 0)
        self.assertAlmostEqual(100 * removed / (removed + left),
                               self.run_.summary["laa_percent"], delta=1e-9)
        broken = particles["loss"] > 0
        self.assertTrue(np.all(particles["shape"][broken] == -2))
        self.assertTrue(np.all(particles["shape"][~broken] >= 0))

    def test_stress_is_that_of_the_rows(self):
        """Mean stress over the specimen by the contacts, on both ways."""
        tables = self.run_.tables()
        particles, contacts = tables.particles, tables.contacts
        moment = np.zeros((particles.n_rows, 3, 3))
        force = contacts["shear_force"] - \
            contacts["normal_force"][:, None] * contacts["normal"]
        for k in range(contacts.n_rows):
            for side, sign in (("a_id", 1), ("b_id", -1)):
                i = contacts[side][k]
                if i >= 0:
                    lever = contacts["point"][k] - particles["position"][i]
                    moment[i] -= sign * np.outer(force[k], lever)
        moment = 0.5 * (moment + moment.transpose(0, 2, 1))
        asked = moment / particles["volume"][:, None, None]
        rows, columns = (0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)
        np.testing.assert_allclose(
            particles["stress"], asked[:, rows, columns],
            atol=1e-5 * np.abs(asked).max())

    def test_description(self):
        tables = self.run_.tables(0)
        self.assertEqual(tables.frame, 0)
        self.assertEqual(tables.kind, "dynamic_triaxial")
        self.assertEqual(tables.title, "Small dynamic triaxial test")
        self.assertEqual(tables.program, self.run_.summary["version"])
        self.assertEqual(len(tables.shapes), len(set(tables.shapes)))
        self.assertIn("FrameTables(tables_00000.h5",
                      repr(tables))

    def test_every_kind_has_them(self):
        case = two_particles(spall, self.folder)
        case["Output/frame_tables"] = "hdf5"
        run = case.run(self.folder / "two")
        self.assertEqual(
            run.tables(0).particles["position"].tolist(),
            [[0, 0, 0], [0.03, 0, 0]])
        self.assertEqual(run.tables(0).contacts.n_rows, 0)
        for kind in ("subgrade", "los_angeles", "single_particle",
                     "vibratory_compaction"):
            self.assertEqual(spall.Case(kind)["Output/frame_tables"], "none")


class Resuming(Written):
    def test_a_resumed_run_has_the_same_bytes(self):
        folder = self.root / "resumed"
        run_case(folder, "--until", "1")
        resumed = run_case(folder, "--resume")
        self.assertEqual(self.bytes_of(resumed), self.bytes_of(self.run_))

    @unittest.skipUnless(MPIRUN, "no mpirun")
    def test_two_ranks_have_the_same_bytes(self):
        spread = run_case(self.root / "ranks", ranks=2)
        self.assertEqual(self.bytes_of(spread), self.bytes_of(self.run_))

    def test_tables_of_frames_that_are_written_again_do_not_stay(self):
        folder = self.root / "without"
        shutil.copytree(self.run_.folder, folder)
        shutil.rmtree(folder / "checkpoint")
        (folder / "summary.json").unlink()
        run = run_case(folder, "--set", "Output/frame_tables=none",
                       "--overwrite")
        self.assertEqual(list(folder.glob("frames/*.h5")), [])
        with self.assertRaisesRegex(spall.InputError,
                                    "no tables, it has .*Output/frame_tables"):
            run.tables()


class Refused(Written):
    def faulty(self, name, data):
        path = self.folder / name
        path.write_bytes(data)
        with self.assertRaises(spall.InputError) as caught:
            spall.read_frame_tables(path)
        self.assertNotIn("\n", str(caught.exception))
        self.assertTrue(str(caught.exception).startswith(f"{path}: "))
        return str(caught.exception)

    @needs("h5py")
    def test_files_that_are_not_whole(self):
        whole = self.run_.frame().path("tables").read_bytes()
        for size in (0, 100, len(whole) // 2, len(whole) - 1):
            self.assertIn("is no whole file",
                          self.faulty("cut.h5", whole[:size]))
        self.assertIn("is no whole file", self.faulty("a.h5", b"a,b\n1,2\n"))
        with self.assertRaisesRegex(spall.InputError, "no such file"):
            spall.read_frame_tables(self.folder / "none.h5")

    @needs("h5py")
    def test_other_schemas(self):
        import h5py
        path = self.folder / "other.h5"
        shutil.copy(self.run_.frame().path("tables"), path)
        with h5py.File(path, "r+") as file:
            file.attrs["schema_version"] = 2
        self.assertIn("schema_version = 2: must be 1",
                      self.faulty(path.name, path.read_bytes()))
        with h5py.File(path, "r+") as file:
            file.attrs["schema"] = "other"
        self.assertIn("schema = other: must be spall_frame_tables",
                      self.faulty(path.name, path.read_bytes()))
        with h5py.File(path, "r+") as file:
            file.attrs["schema"] = "spall_frame_tables"
            file.attrs["schema_version"] = 1
            del file["contacts"]
        self.assertIn("contacts", self.faulty(path.name, path.read_bytes()))

    @needs("h5py")
    def test_tables_of_another_instant(self):
        folder = self.folder / "run"
        shutil.copytree(self.run_.folder, folder)
        run = spall.Run(folder)
        shutil.copy(run.frame(0).path("tables"), run.frame(1).path("tables"))
        with self.assertRaisesRegex(spall.InputError, "tables_00001.h5: is of"):
            run.tables(1)

    def test_without_h5py(self):
        with mock.patch.dict(sys.modules, {"h5py": None}), \
                self.assertRaisesRegex(spall.MissingPackage,
                                       "reading tables_.* needs h5py: apt "
                                       "install python3-h5py"):
            self.run_.tables()
