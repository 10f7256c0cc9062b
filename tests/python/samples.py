"""Small cases, and a folder for each test."""
import importlib.util
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "tests" / "application" / "data"
MPIRUN = shutil.which("mpirun")

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


def run_membrane(spall, folder, settings, *options, ranks=1):
    """A run of the case of a hundred particles in a membrane."""
    words = [str(spall.find_program()), "run",
             str(DATA / "small_membrane.prm"), "--out", str(folder),
             "--threads", "1"]
    for setting in settings:
        words += ["--set", setting]
    if ranks > 1:
        words = [MPIRUN, "--allow-run-as-root", "--oversubscribe",
                 "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1",
                 "-n", str(ranks)] + words
    subprocess.run([*words, *options], check=True, capture_output=True)
    return spall.Run(folder)


def two_particles(spall, folder):
    """The case of the two spheres, some milliseconds of processor time."""
    (folder / "two.csv").write_text(TWO, encoding="utf-8")
    case = spall.Case("scene")
    case["Scene/particles"] = str(folder / "two.csv")
    case["Scene/gravity"] = (0, 0, 0)
    case["Scene/duration"] = 0.1
    return case
