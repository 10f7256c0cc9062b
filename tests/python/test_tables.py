"""Columns, records, units and case files; no program is needed."""
import numpy as np

import spall
from samples import InFolder, needs
from spall.errors import UnknownKey
from spall.prm import prm_text, quoted, read_resolved, unquoted
from spall.program import parse_progress
from spall.units import label, split_unit

RESOLVED = '''# Every parameter as run. Case: a.prm

# What the particles are.
subsection Particle
  # Density of the solid. [kg/m^3] Allowed: a number of at least 1 and at most
  # 1e5.
  set density = 2650
  # Shapes [see there]. [-]
  set shapes = "lot#2/""a"""
  # Whether it is on. [-] Allowed: true or false.
  set is_active = true
  # Count. [-] Allowed: a whole number of at least 1.
  set count = 7
  # Title. [-]
  set title = 12
end

subsection Walls
  subsection lid
    # Velocity. [m/s] Allowed: three numbers x, y, z.
    set velocity = 0, 0.5, -1e-3
  end
end
'''


class Units(InFolder):
    def test_endings(self):
        for full, expected in {
                "axial_stress_Pa": ("axial_stress", "Pa"),
                "density_kg_per_m3": ("density", "kg/m^3"),
                "axial_strain_rate_1_per_s": ("axial_strain_rate", "1/s"),
                "plate_mobility_m_per_sN": ("plate_mobility", "m/(s N)"),
                "laa_percent": ("laa", "%"),
                "impulse_given_Ns": ("impulse_given", "N s"),
                "volume_m3": ("volume", "m^3"),
                "seed": ("seed", "1"),
                "orientation_wxyz": ("orientation_wxyz", "1"),
                "n_1": ("n", "1")}.items():
            self.assertEqual(split_unit(full), expected)

    def test_labels(self):
        self.assertEqual(label("axial_stress", "Pa"), "Axial stress (Pa)")
        self.assertEqual(label("cycle", "1"), "Cycle")


class Tables(InFolder):
    def table(self):
        return spall.Table.read(self.file(
            "a.csv", "# made by hand\ntime_s,force_N,force_J,n,name\n"
                     "0,1,10,1,one\n0.5,2,,2,two\n1,3,"))

    def test_columns_have_units(self):
        table = self.table()
        self.assertEqual(list(table), ["time", "force_N", "force_J", "n",
                                       "name"])
        self.assertEqual(table.unit("time"), "s")
        self.assertEqual(table.unit("force_J"), "J")
        self.assertIs(table["time"], table["time_s"])
        self.assertEqual(table.full_name("time"), "time_s")
        self.assertEqual(table["n"].dtype, np.int64)
        self.assertEqual(list(table["name"]), ["one", "two"])
        self.assertTrue(np.isnan(table["force_J"][1]))

    def test_row_that_is_being_written_is_left_out(self):
        self.assertEqual(self.table().n_rows, 2)

    def test_last_line_of_a_complete_file(self):
        path = self.file("a.csv", "time_s,n\n0,1\n1,2")
        self.assertEqual(spall.Table.read(path).n_rows, 1)
        self.assertEqual(spall.Table.read(path, is_complete=True).n_rows, 2)

    def test_units_that_names_do_not_have(self):
        table = spall.Table({"Loading/frequency": np.ones(2),
                             "force_N": np.ones(2)},
                            units={"Loading/frequency": "Hz"})
        for one in (table, table.rows([0]),
                    spall.Table({"Loading/frequency": [1]}).with_units(
                        {"Loading/frequency": "Hz"})):
            self.assertEqual(one.unit("Loading/frequency"), "Hz")
        self.assertEqual(table.unit("force"), "N")
        self.assertEqual(table.label("Loading/frequency"),
                         "Loading/frequency (Hz)")

    def test_names_where_none_is_near(self):
        with self.assertRaisesRegex(UnknownKey, "no column zzz; there are "
                                    "time, force_N, force_J, n, name$"):
            self.table()["zzz"]
        with self.assertRaisesRegex(UnknownKey, "no value zzz; there is a$"):
            spall.Record({"a": 1})["zzz"]
        many = spall.Table({f"c{k}": [0] for k in range(30)})
        with self.assertRaisesRegex(UnknownKey, "no column zzz$"):
            many["zzz"]

    def test_unknown_column_is_refused(self):
        with self.assertRaisesRegex(UnknownKey,
                                    "no column tine, did you mean time"):
            self.table()["tine"]

    def test_rows_and_files(self):
        late = self.table().rows(self.table()["time"] > 0.1)
        self.assertEqual(late.n_rows, 1)
        late.write_csv(self.folder / "b.csv")
        again = spall.Table.read(self.folder / "b.csv")
        self.assertEqual(list(again), list(late))
        self.assertEqual(again["force_N"][0], 2.0)

    def test_faulty_files_are_refused(self):
        for text, what in (("", "no header"), ("a,b\n1\n", "row 1 has 1")):
            with self.assertRaisesRegex(spall.InputError, what):
                spall.Table.read(self.file("c.csv", text))

    @needs("pandas")
    def test_data_frame(self):
        table = spall.Table({"time_s": np.arange(2.0),
                             "velocity_m_per_s": np.ones((2, 3))})
        frame = table.to_pandas()
        self.assertEqual(list(frame), ["time_s", "velocity_x_m_per_s",
                                       "velocity_y_m_per_s",
                                       "velocity_z_m_per_s"])
        self.assertEqual(frame.attrs["units"]["velocity_y_m_per_s"], "m/s")


class Records(InFolder):
    def test_nested_values(self):
        record = spall.Record({"peak_N": 2.0, "walls": {"lid_force_z_N": 3.0}})
        self.assertEqual(record["peak"], 2.0)
        self.assertEqual(record["walls/lid_force_z"], 3.0)
        self.assertEqual(record["walls"]["lid_force_z_N"], 3.0)
        self.assertEqual(record.unit("walls/lid_force_z"), "N")
        self.assertEqual(list(record.flat()),
                         [("peak", 2.0, "N"), ("walls/lid_force_z", 3.0,
                                               "N")])
        self.assertEqual(record.as_dict()["walls"], {"lid_force_z": 3.0})
        self.assertNotIn("walls/lid", record)
        clock = spall.Record({"wall_clock_s": {"total": 1.5, "share_1": 2}})
        self.assertEqual(clock.unit("wall_clock/total"), "s")
        self.assertEqual(clock["wall_clock/total_s"], 1.5)
        with self.assertRaisesRegex(KeyError, "did you mean peak"):
            record["peek"]


class CaseFiles(InFolder):
    def test_resolved_case(self):
        case = read_resolved(self.file("case.prm", RESOLVED))
        self.assertEqual(case["Particle"]["density"], 2650.0)
        self.assertEqual(case.unit("Particle/density"), "kg/m^3")
        self.assertEqual(case["Particle/shapes"], 'lot#2/"a"')
        self.assertIs(case["Particle/is_active"], True)
        self.assertEqual(case["Particle/count"], 7)
        self.assertEqual(case["Particle/title"], "12")
        self.assertEqual(case["Walls/lid/velocity"], (0.0, 0.5, -1e-3))
        self.assertEqual(case.unit("Walls/lid/velocity"), "m/s")

    def test_quotes(self):
        for value in ("plain", "lot#2", '"a"', "b ", "", "c \\"):
            self.assertEqual(unquoted(quoted(value)), value)

    def test_text_of_a_case(self):
        text = prm_text("head", {"Case/kind": "scene", "Walls/a/mesh": "a.stl",
                                 "Walls/a/velocity": (0.0, 1.0, 0.1),
                                 "Case/threads": 2, "Breakage/is_on": False})
        self.assertEqual(text, "# head\n\nsubsection Case\n"
                         "  set kind = scene\n  set threads = 2\nend\n\n"
                         "subsection Walls\n  subsection a\n"
                         "    set mesh = a.stl\n"
                         "    set velocity = 0, 1, 0.1\n  end\nend\n\n"
                         "subsection Breakage\n  set is_on = false\nend\n")


class ProgressLines(InFolder):
    def test_lines(self):
        step = parse_progress("loading        12.5 %      1234 steps/s  "
                              "3:05 left  cycle 2, strain 0.1 %")
        self.assertEqual((step.phase, step.share, step.steps_per_s,
                          step.seconds_left, step.numbers),
                         ("loading", 0.125, 1234.0, 185.0,
                          "cycle 2, strain 0.1 %"))
        first = parse_progress("at rest         0.0 %         0 steps/s")
        self.assertIsNone(first.seconds_left)
        self.assertEqual(first.numbers, "")
        self.assertIsNone(parse_progress("346 particles, time step 2e-06 s"))
