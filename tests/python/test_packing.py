"""Packings of other programs."""
import numpy as np

import spall
from samples import InFolder

DUMP = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS ff ff ff
0 1
0 1
0 1
ITEM: ATOMS id type x y z radius
1 1 0.5 0.5 0.5 0.1
ITEM: TIMESTEP
100
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp ff
-0.1 0.1
-0.1 0.1
0 0.4
ITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz radius quatw quati quatj quatk
2 1 0.01 0 0.2 0 0 -1 0 0 3 0.02 0.70711 0 0 0.70711
1 1 0 0.05 0.1 1 0 0 0 2 0 0.01 1 0 0 0
"""
YADE = "#format x_y_z_r\n0.1\t0.2\t0.3\t0.01\n\n1e-1 0 0 0.02 7\n"


class Dumps(InFolder):
    def test_last_time_step(self):
        packing = spall.read_packing(self.file("dump.liggghts", DUMP))
        self.assertEqual(len(packing), 2)
        # In the order of their ids.
        np.testing.assert_array_equal(packing.radius, [0.01, 0.02])
        np.testing.assert_array_equal(packing.position[1], [0.01, 0, 0.2])
        np.testing.assert_array_equal(packing.velocity[0], [1, 0, 0])
        np.testing.assert_array_equal(packing.spin[1], [0, 0, 3])
        np.testing.assert_array_equal(packing.box,
                                      [[-0.1, -0.1, 0], [0.1, 0.1, 0.4]])
        # Five digits of the file, made a unit quaternion.
        np.testing.assert_allclose(packing.orientation[1],
                                   [0.5**0.5, 0, 0, 0.5**0.5], rtol=1e-15)

    def test_chosen_time_step(self):
        path = self.file("dump", DUMP)
        self.assertEqual(len(spall.read_packing(path, step=0)), 1)
        with self.assertRaisesRegex(spall.InputError, "no time step 5, it "
                                    "has 0 to 100"):
            spall.read_packing(path, step=5)

    def test_shares_of_the_box_and_diameters(self):
        text = DUMP[DUMP.index("100") - len("ITEM: TIMESTEP\n"):]
        text = text[:text.index("ITEM: ATOMS")] + \
            "ITEM: ATOMS xs ys zs diameter\n0.25 0.5 0.5 0.03\n"
        packing = spall.read_packing(self.file("dump", text))
        np.testing.assert_allclose(packing.position, [[-0.05, 0, 0.2]],
                                   atol=1e-15)
        np.testing.assert_array_equal(packing.radius, [0.015])
        self.assertIsNone(packing.velocity)

    def test_units_of_length(self):
        packing = spall.read_packing(self.file("dump", DUMP), scale=1e-3)
        np.testing.assert_allclose(packing.radius, [1e-5, 2e-5])
        np.testing.assert_allclose(packing.velocity[0], [1e-3, 0, 0])
        np.testing.assert_allclose(packing.box[1], [1e-4, 1e-4, 4e-4])
        np.testing.assert_allclose(packing.spin[1], [0, 0, 3])

    def test_faults(self):
        for text, what in (
                (DUMP.replace("radius", "mass"), "must have radius"),
                (DUMP.replace("0.05 0.1 1", "0.05 a 1"), "dump:21: .*'a'"),
                (DUMP.replace("0.01 1 0 0 0\n", "0.01 1\n"), "dump:21: has "),
                (DUMP.replace("0 0.01 1 0 0 0", "0 -1 1 0 0 0"),
                 "particle 2 has radius -1"),
                (DUMP.replace("BOUNDS pp", "BOUNDS xy xz yz pp"), "tilted"),
                ("", "has no particles"), ("ITEM: TIMESTEP\n", "TIMESTEP")):
            with self.assertRaisesRegex(spall.InputError, what):
                spall.read_packing(self.file("dump", text))


class Texts(InFolder):
    def test_yade(self):
        packing = spall.read_packing(self.file("yade.txt", YADE))
        np.testing.assert_array_equal(packing.radius, [0.01, 0.02])
        np.testing.assert_array_equal(packing.position,
                                      [[0.1, 0.2, 0.3], [0.1, 0, 0]])
        with self.assertRaisesRegex(spall.InputError, "yade.txt:2: has 3"):
            spall.read_packing(self.file("yade.txt", "#\n1 2 3\n"))

    def test_written_and_read_again(self):
        packing = spall.read_packing(self.file("dump", DUMP)).moved(
            [0.1, 0.1, 0])
        packing.shape, packing.material = ["sphere", "a"], ["particle"] * 2
        packing.write_packing(self.folder / "p.csv")
        again = spall.read_packing(self.folder / "p.csv")
        for name in ("position", "radius", "orientation", "velocity", "spin",
                     "box", "shape", "material"):
            np.testing.assert_array_equal(getattr(again, name),
                                          getattr(packing, name), name)

    def test_csv_without_an_end_of_its_last_line(self):
        text = "x,y,z,radius\n0,0,0,0.01\n1,0,0,0.02"
        for name, before in (("a.csv", ""), ("b.csv", "\ufeff")):
            packing = spall.read_packing(self.file(name, before + text))
            np.testing.assert_array_equal(packing.radius, [0.01, 0.02])

    def test_yade_with_a_byte_order_mark(self):
        packing = spall.read_packing(self.file("yade.txt", "\ufeff" + YADE))
        self.assertEqual(len(packing), 2)

    def test_bounds(self):
        packing = spall.read_packing(self.file("yade.txt", YADE))
        np.testing.assert_allclose(packing.bounds(),
                                   [[0.08, -0.02, -0.02], [0.12, 0.21, 0.31]])


class InTheProgram(InFolder):
    def test_scene_takes_a_packing(self):
        packing = spall.read_packing(self.file("dump", DUMP))
        packing.write_packing(self.folder / "p.csv")
        case = spall.Case("scene")
        case["Scene/particles"] = str(self.folder / "p.csv")
        case["Scene/gravity"] = (0, 0, 0)
        case["Scene/duration"] = 0.01
        run = case.run(self.folder / "run")
        first = run.packing(0)
        # Frames are in single precision.
        np.testing.assert_allclose(first.position, packing.position, rtol=1e-7)
        np.testing.assert_allclose(first.orientation, packing.orientation,
                                   rtol=1e-7, atol=1e-7)
        np.testing.assert_allclose(first.velocity, packing.velocity)
        np.testing.assert_allclose(first.spin, packing.spin)
        np.testing.assert_allclose(
            run.packing().position,
            packing.position + run.frames[-1].time * packing.velocity,
            rtol=1e-6, atol=1e-8)
        last = spall.read_packing(run.folder / "particles.csv")
        np.testing.assert_allclose(last.position, run.packing().position,
                                   rtol=1e-6, atol=1e-8)
