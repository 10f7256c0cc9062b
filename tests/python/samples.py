"""Small cases, and a folder for each test."""
import importlib.util
import pathlib
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "tests" / "application" / "data"

# Two spheres that fly at each other, without gravity.
TWO = "x,y,z,radius,vx,vy,vz\n0,0,0,0.01,0.5,0,0\n0.03,0,0,0.01,-0.3,0,0\n"


def has(module):
    return importlib.util.find_spec(module) is not None


def needs(module):
    """Skips a test where a package is missing, and says which."""
    return unittest.skipUnless(has(module), f"{module} is not installed")


class InFolder(unittest.TestCase):
    """Each test has an empty folder, self.folder."""

    def setUp(self):
        self._scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self._scratch.cleanup)
        self.folder = pathlib.Path(self._scratch.name)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path


def two_particles(spall, folder):
    """The case of the two spheres, some milliseconds of processor time."""
    (folder / "two.csv").write_text(TWO, encoding="utf-8")
    case = spall.Case("scene")
    case["Scene/particles"] = str(folder / "two.csv")
    case["Scene/gravity"] = (0, 0, 0)
    case["Scene/duration"] = 0.1
    return case
