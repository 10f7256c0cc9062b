#!/usr/bin/env python3
"""The Python module of the engine: views, closed forms, restart, and the bits of
the program.

    engine_module.py FOLDER_OF_THE_MODULE SPALL

77: the module or numpy is missing
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path[:0] = [sys.argv[1],
                str(pathlib.Path(__file__).resolve().parents[2] / "apps/python")]
try:
    import numpy as np
    from spall import engine as dem
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

SPALL = sys.argv[2]
DATA = pathlib.Path(__file__).resolve().parents[2] / "data"


def parameters():
    """Elastic spheres on stiff planes."""
    p = dem.Parameters()
    p.particle.shear_modulus = 5e7
    p.particle.friction = 0.4
    p.particle.normal_damping = p.particle.shear_damping = 0.
    p.wall.normal_stiffness = 1e5
    p.wall.normal_damping = p.wall.shear_damping = 0.
    p.gravity = [0., 0., -9.81]
    return p


class EngineModule(unittest.TestCase):
    def test_flight_is_a_parabola(self):
        engine = dem.Engine(parameters())
        engine.add_sphere(0.01, [0., 0., 1.], velocity=[1., 0., 2.])
        engine.advance(1e-4, 1000)
        t = engine.time
        self.assertAlmostEqual(t, 0.1, delta=1e-12)
        self.assertAlmostEqual(engine.position[0, 0], t, delta=1e-12)
        self.assertAlmostEqual(engine.position[0, 2],
                               1. + 2. * t - 0.5 * 9.81 * t * t, delta=1e-12)

    def test_elastic_collision_exchanges_velocities(self):
        p = parameters()
        p.gravity = [0., 0., 0.]
        engine = dem.Engine(p)
        engine.add_sphere(0.01, [0., 0., 0.], velocity=[1., 0., 0.])
        engine.add_sphere(0.01, [0.021, 0., 0.])
        engine.advance(0.02 * engine.stable_step(), 20000)
        self.assertAlmostEqual(engine.velocity[0, 0], 0., delta=1e-4)
        self.assertAlmostEqual(engine.velocity[1, 0], 1., delta=1e-4)

    def test_weight_is_on_the_plane(self):
        p = parameters()
        p.wall.normal_damping = 0.5
        engine = dem.Engine(p)
        plane = engine.add_plane([0., 0., 0.], [0., 0., 2.])
        engine.add_sphere(0.01, [0., 0., 0.01])
        engine.advance(1e-5, 50000)
        weight = engine.mass[0] * 9.81
        self.assertAlmostEqual(plane.force[2], -weight, delta=1e-6 * weight)
        self.assertEqual(list(plane.normal), [0., 0., 1.])

    def test_mesh_wall_acts_as_the_plane(self):
        def settled(add_floor):
            p = parameters()
            p.wall.normal_damping = p.surface.normal_damping = 0.5
            p.surface.normal_stiffness = 1e5
            engine = dem.Engine(p)
            floor = add_floor(engine)
            engine.add_sphere(0.01, [0.001, 0.002, 0.01])
            engine.advance(1e-5, 20000)
            return floor.force[2], engine.position[0, 2]
        corners = [[x, y, 0.] for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        plane = settled(lambda e: e.add_plane([0, 0, 0], [0, 0, 1]))
        wall = settled(lambda e: e.add_mesh_wall("floor", corners,
                                                 [[0, 2, 1], [0, 3, 2]]))
        np.testing.assert_allclose(wall, plane, rtol=1e-6)

    def test_periodic_cell(self):
        p = parameters()
        p.gravity = [0., 0., 0.]
        engine = dem.Engine(p)
        engine.set_periodic_cell([0., 0., 0.], [0.1, 0.1, 0.])
        engine.add_sphere(0.01, [-0.045, 0., 0.])
        engine.add_sphere(0.01, [0.0352, 0., 0.])
        engine.advance(1e-9)
        # 19.8 mm apart across the face.
        self.assertEqual(len(engine.contacts()["a"]), 1)
        self.assertGreater(engine.force[0, 0], 0.)

    def test_columns_are_views(self):
        engine = dem.Engine(parameters())
        for k in range(5):
            engine.add_sphere(0.01, [0.05 * k, 0., 0.])
        engine.velocity[:] = [[k, 0., 0.] for k in range(5)]
        engine.position[3] = [0., 1., 0.]
        self.assertEqual(engine.velocity[4, 0], 4.)
        self.assertEqual(list(engine.position[3]), [0., 1., 0.])
        self.assertFalse(engine.position.flags.owndata)
        self.assertTrue(np.shares_memory(engine.position, engine.position))
        with self.assertRaises(ValueError):
            engine.mass[0] = 1.
        before = engine.position
        engine.advance(1e-5)
        self.assertAlmostEqual(before[4, 0], 0.2 + 4e-5, delta=1e-12)
        self.assertEqual(len(engine), 5)

    def test_callback_is_called(self):
        engine = dem.Engine(parameters())
        engine.add_sphere(0.01, [0., 0., 0.])
        times = []
        engine.advance(1e-4, 10, callback=lambda: times.append(engine.time),
                       interval=5)
        np.testing.assert_allclose(times, [5e-4, 1e-3], rtol=1e-12)

        def fail():
            raise KeyError("mine")
        with self.assertRaises(KeyError):
            engine.advance(1e-4, 10, callback=fail)

    def test_contacts_and_energy(self):
        p = parameters()
        p.gravity = [0., 0., 0.]
        engine = dem.Engine(p)
        engine.add_sphere(0.01, [0., 0., 0.])
        engine.add_sphere(0.01, [0.0199, 0., 0.])
        engine.advance(1e-9)
        found = engine.contacts()
        self.assertEqual(list(found["a"]), [0])
        self.assertEqual(list(found["b"]), [1])
        # Hertz: F = 4/3 E* sqrt(R*) delta^(3/2).
        modulus = p.particle.shear_modulus / (1. - p.particle.poisson_ratio)
        force = 4. / 3. * modulus * math.sqrt(0.005) * 1e-4**1.5
        self.assertAlmostEqual(found["force"][0, 0], -force, delta=1e-4 * force)
        self.assertAlmostEqual(engine.energy()["elastic"],
                               0.4 * force * 1e-4, delta=1e-4 * force * 1e-4)

    def test_shapes_break_and_restart(self):
        file = next((DATA / "shapes/limestone_blocky").glob("*.json"))
        shape = dem.read_shape(file).resized(0.01)
        self.assertAlmostEqual(shape.radius, 0.01, delta=1e-12)

        def scene():
            p = parameters()
            p.geometry.geometry = dem.ContactGeometry.radial
            engine = dem.Engine(p)
            engine.add_plane([0., 0., -0.012], [0., 0., 1.])
            for k in range(4):
                engine.add_particle(shape, [0.001 * k, 0., 0.025 * k],
                                    orientation=[1., 0.3 * k, 0.1, 0.])
            return engine
        whole, other = scene(), scene()
        whole.advance(2e-6, 3000)
        with tempfile.TemporaryDirectory() as folder:
            whole.save(f"{folder}/state")
            other.restore(f"{folder}/state")
        for engine in (whole, other):
            engine.advance(2e-6, 3000)
        np.testing.assert_array_equal(whole.position, other.position)
        np.testing.assert_array_equal(whole.orientation, other.orientation)

    def test_bad_input(self):
        engine = dem.Engine(parameters())
        with self.assertRaisesRegex(ValueError, "^radius = -1: must be"):
            engine.add_sphere(-1., [0., 0., 0.])
        with self.assertRaisesRegex(ValueError, "time_step: must be above 0"):
            engine.advance(0.)
        with self.assertRaisesRegex(ValueError, "normal: must not be 0"):
            engine.add_plane([0., 0., 0.], [0., 0., 0.])
        with self.assertRaisesRegex(RuntimeError, "cannot be read"):
            engine.restore("/nowhere/state")

    def test_stable_step_needs_particles(self):
        with self.assertRaisesRegex(ValueError, "^no particles: "):
            dem.Engine(dem.Parameters()).stable_step()

    def test_name_of_a_law_sets_its_defaults(self):
        p = parameters()
        self.assertEqual(
            dem.law_parameters("linear"),
            [("normal_stiffness", "N/m", 1e6),
             ("shear_stiffness", "N/m", 0.85e6)])
        self.assertEqual(dem.law_parameters("hertz"), [])
        for material in (p.particle, p.wall, p.surface):
            material.law = "dmt"
            self.assertEqual(
                list(material.law_values)[:2],
                [value for _, _, value in dem.law_parameters("dmt")])
            with self.assertRaisesRegex(ValueError, "contact law spring: must "
                                        "be one of hertz, linear, dmt"):
                material.law = "spring"
            self.assertEqual(material.law, "dmt")
        with self.assertRaisesRegex(ValueError, "must be one of hertz"):
            dem.law_parameters("spring")

        p = parameters()
        p.gravity = [0., 0., 0.]
        p.particle.law = "linear"
        engine = dem.Engine(p)
        for x in (0., 0.0199):
            engine.add_sphere(0.01, [x, 0., 0.])
        engine.advance(1e-9)
        # 0.1 mm of overlap on a spring of 1e6 N/m.
        self.assertAlmostEqual(engine.force[1, 0], 100., delta=1e-3)

    def test_parameters_out_of_range_are_refused(self):
        nan, inf = math.nan, math.inf
        for name, value, what in (
                ("particle.density", 0., "above 0 and at most 30000 kg/m"),
                ("particle.density", -2750., "= -2750: must be a finite"),
                ("particle.density", nan, "= nan: must be"),
                ("particle.shear_modulus", 0., "of at least 1 and at most"),
                ("particle.shear_modulus", inf, "= inf: must be"),
                ("particle.poisson_ratio", 0.5, "at least 0 and below 0.5"),
                ("particle.friction", -0.1, "at least 0"),
                ("particle.rolling_friction", nan, "must be"),
                ("particle.normal_damping", -1., "at least 0"),
                ("particle.shear_damping", inf, "at least 0"),
                ("wall.normal_stiffness", 0., "above 0"),
                ("wall.shear_stiffness", -1., "at least 0"),
                ("surface.friction", -1., "at least 0"),
                ("breakage.fracture_energy", 0., "above 0"),
                ("geometry.skin", -1., "at least 0"),
                ("geometry.usual_skin", 0., "above 0"),
                ("local_damping", 1., "at least 0 and below 1"),
                ("density_scaling_diameter", -1., "at least 0 m"),
                ("gravity", [0., nan, 0.], "= 0, nan, 0: must be three")):
            p = parameters()
            *sections, key = name.split(".")
            part = p
            for section in sections:
                part = getattr(part, section)
            setattr(part, key, value)
            with self.subTest(name=name, value=value), \
                    self.assertRaisesRegex(ValueError, f"^{name} .*{what}"):
                dem.Engine(p)
        p = parameters()
        p.particle.law = "linear"
        p.particle.law_values = [0., 0., 0., 0.]
        with self.assertRaisesRegex(ValueError, "normal_stiffness of the law "
                                    "linear = 0: must be"):
            dem.Engine(p)

    def test_geometry_must_be_finite(self):
        engine, origin, up = dem.Engine(parameters()), [0., 0., 0.], [0, 0, 1]
        corners = [origin, [1., 0., 0.], [0., 1., 0.]]
        plane = engine.add_plane(origin, up)
        shape = dem.Shape.sphere(0.01)
        for bad in (math.nan, math.inf):
            vector = [0., bad, 0.]
            for name, call in (
                    ("position", lambda v: engine.add_sphere(0.01, v)),
                    ("position", lambda v: engine.add_particle(shape, v)),
                    ("spin", lambda v: engine.add_sphere(0.01, origin,
                                                         spin=v)),
                    ("point", lambda v: engine.add_plane(v, up)),
                    ("normal", lambda v: engine.add_plane(origin, v)),
                    ("point", lambda v: setattr(plane, "point", v)),
                    ("velocity", lambda v: setattr(plane, "velocity", v)),
                    ("centre", lambda v: engine.set_periodic_cell(v, origin)),
                    ("rate", engine.set_cell_rate),
                    (r"vertices\[2\]", lambda v: engine.add_mesh_wall(
                        "a", corners[:2] + [v], [[0, 1, 2]]))):
                with self.subTest(name=name, bad=bad), \
                        self.assertRaisesRegex(ValueError, f"^{name} = 0, "):
                    call(vector)
        for bad in (0., -1., math.nan, math.inf):
            for make in (dem.Shape.sphere, shape.resized,
                         lambda radius: engine.add_sphere(radius, origin)):
                with self.assertRaisesRegex(ValueError, "^radius = .*above 0"):
                    make(bad)
            with self.assertRaisesRegex(ValueError, "^coefficients"):
                dem.Shape([bad, 0., 0., 0.])
        with self.assertRaisesRegex(ValueError, "in every direction"):
            dem.Shape([0.01, 0., 0., 0.1])
        self.assertEqual(len(engine), 0)

    def test_same_bits_as_the_program(self):
        step, n_steps = 4e-6, 50000
        positions = [(0.021 * (k % 3), 0.021 * (k // 3), 0.02 + 0.03 * k)
                     for k in range(9)]
        case = {
            "Case": {"kind": "scene"},
            "Scene": {"particles": "particles.csv", "frames": 0,
                      "duration": step * n_steps},
            "Box": {"x": "rigid", "y": "rigid", "z": "rigid",
                    "lower": [-0.011, -0.011, 0.],
                    "upper": [0.053, 0.053, 0.5]},
            "Particle": {"shear_modulus": 5e7, "friction": 0.4,
                         "rolling_friction": 0.1, "density": 2750},
            "Wall": {"law": "linear", "normal_stiffness": 1e5},
            "Breakage": {"is_active": False},
            "Contact": {"geometry": "sphere"},
            "Time": {"step": "fixed", "fixed_step": step},
        }
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "case.json").write_text(json.dumps(case))
            (folder / "particles.csv").write_text("x,y,z,radius\n" + "".join(
                f"{x!r},{y!r},{z!r},0.01\n" for x, y, z in positions))
            subprocess.run([SPALL, "run", folder / "case.json", "--out",
                            folder / "run", "--threads", "1"], check=True,
                           stdout=subprocess.DEVNULL)
            with open(folder / "run/particles.csv", encoding="utf-8") as file:
                lines = [line for line in file if not line.startswith("#")]
        rows = list(csv.DictReader(lines))

        p = dem.Parameters()
        p.particle.shear_modulus, p.particle.friction = 5e7, 0.4
        p.particle.rolling_friction = 0.1
        p.wall.normal_stiffness = 1e5
        p.geometry.geometry = dem.ContactGeometry.sphere
        p.geometry.usual_skin = 0.25 * 0.01
        p.gravity = [0., 0., -9.81]
        engine = dem.Engine(p)
        for position in positions:
            engine.add_sphere(0.01, position)
        for axis in range(3):
            normal = np.eye(3)[axis]
            engine.add_plane(case["Box"]["lower"], normal)
            engine.add_plane(case["Box"]["upper"], -normal)
        engine.set_breaking(False)
        engine.advance(step, n_steps)
        row_of = {id_: row for row, id_ in enumerate(engine.id)}
        for k, row in enumerate(rows):
            found = engine.position[row_of[k]]
            self.assertEqual([float(row[f"{axis}"]) for axis in "xyz"],
                             list(found))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
