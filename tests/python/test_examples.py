"""The first example of the package runs and prints what its page shows."""
import os
import re
import subprocess
import sys

from samples import ROOT, InFolder

EXAMPLES = ROOT / "apps" / "python" / "examples"
PAGE = ROOT / "docs" / "user" / "python.md"


class Examples(InFolder):
    def test_first_run(self):
        environment = {**os.environ,
                       "PYTHONPATH": str(EXAMPLES.parent)}
        ended = subprocess.run(
            [sys.executable, "-B", str(EXAMPLES / "first_run.py"),
             str(self.folder / "runs")], env=environment, capture_output=True,
            text=True, check=False)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        # Digits differ from compiler to compiler, words do not.
        printed = [re.sub(r"\d+\.\d+ %", "N %", line)
                   for line in ended.stdout.splitlines()
                   if not line.startswith(("cycle", "preparation"))]
        shown = re.sub(r"\d+\.\d+ %", "N %", PAGE.read_text())
        for line in printed:
            self.assertIn(line, shown)
        mesh = self.folder / "runs" / "specimen.stl"
        self.assertEqual(mesh.stat().st_size, 84 + 90 * 1280 * 50)
