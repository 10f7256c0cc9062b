"""Frames that each rank writes a piece of, against those of one rank."""
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import spall
from samples import MPIRUN, run_membrane


def run_case(folder, *options, ranks=1):
    """One short cycle: a second."""
    return run_membrane(
        spall, folder,
        ("Loading/frequency=200", "Loading/cycles=1",
         "Output/frames_per_cycle=2", "Output/surfaces=all",
         "Output/pieces_above=20"), *options, ranks=ranks)


def names_in(run):
    return sorted(path.name for path in (run.folder / "frames").iterdir())


@unittest.skipUnless(MPIRUN, "mpirun is not installed")
class Pieces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.root = pathlib.Path(scratch.name)
        cls.whole = run_case(cls.root / "whole")
        cls.pieces = run_case(cls.root / "pieces", ranks=2)

    def pairs(self):
        """The frames of one rank, and of two."""
        self.assertEqual(len(self.whole.frames), len(self.pieces.frames))
        return zip(self.whole.frames, self.pieces.frames)

    def test_every_rank_has_a_file(self):
        names = names_in(self.pieces)
        for part in ("particles", "contacts", "surfaces"):
            self.assertEqual(
                [name for name in names if name.startswith(f"{part}_00000")],
                [f"{part}_00000.pvtu", f"{part}_00000_0000.vtu",
                 f"{part}_00000_0001.vtu"])
        self.assertIn("membrane_00000.vtu", names)

    def test_particles_are_the_same(self):
        for one, other in self.pairs():
            self.assertEqual(one.time, other.time)
            of_one, of_other = one.particles(), other.particles()
            for name in of_one:
                np.testing.assert_array_equal(of_one[name], of_other[name])

    def test_contacts_are_the_same(self):
        for one, other in self.pairs():
            of_one, of_other = (
                sorted(map(tuple, np.column_stack(
                    [table[name].reshape(len(table["kind"]), -1)
                     for name in table])))
                for table in (one.contacts(), other.contacts()))
            self.assertEqual(of_one, of_other)
            self.assertGreater(len(of_one), 0)

    def test_surfaces_are_the_same(self):
        for one, other in self.pairs():
            of_one, of_other = (
                sorted(map(tuple, grid.points[grid.cells(3)].reshape(-1, 9)))
                for grid in (one.read("surfaces"), other.read("surfaces")))
            self.assertEqual(of_one, of_other)

    def test_report_finds_them(self):
        page = self.root / "report.html"
        subprocess.run([str(spall.find_program()), "report",
                        str(self.pieces.folder), "--out", str(page)],
                       check=True, capture_output=True)
        self.assertNotIn("there is no frames", page.read_text())

    def test_they_go_with_the_run(self):
        folder = self.root / "again"
        run_case(folder, ranks=2)
        again = run_case(folder, "--overwrite")
        self.assertEqual(names_in(again), names_in(self.whole))


if __name__ == "__main__":
    unittest.main()
