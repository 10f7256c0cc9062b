"""What view.py of a run folder must be, and the picture that it makes where
there is a ParaView to ask."""
import ast
import pathlib
import re
import shutil
import subprocess

SCRIPT = (pathlib.Path(__file__).resolve().parents[2] / "data" / "paraview" /
          "view.py")


def array_faults(folder, script):
    """Fields that the script names and the frames do not have."""
    text = b"".join(path.read_bytes() for path in
                    (folder / "frames").glob("*_00000.vtu")).decode("latin-1")
    there = set(re.findall(r'Name="(\w+)"', text)) | {"thickness_m"}
    if not any((folder / "frames" / f"{body}_00000.vtu").exists()
               for body in ("membrane", "subgrade")):
        there.add("displacement_m")
    named = set(re.findall(r'"(\w+_(?:1|m|N|m_per_s))[":]', script))
    return [f"view.py reads {name}, which no frame has"
            for name in sorted(named - there)]


def cell_faults(folder):
    """deal.II writes points without cells where these are not named."""
    return [f"{path.name} has points and no cells"
            for path in sorted((folder / "frames").glob("*.vtu"))
            if re.search(rb'Name="(offsets|types)" format="binary">\s*<',
                         path.read_bytes())]


def picture_faults(folder):
    words = ["pvbatch", folder / "view.py", "--picture", folder / "view.png"]
    if shutil.which("xvfb-run"):
        words = ["xvfb-run", "-a", *words]
    made = subprocess.run(list(map(str, words)), capture_output=True,
                          text=True, timeout=200)
    if "No module named 'paraview'" in made.stderr:
        print("no picture: pvbatch has no Python package")
        return []
    picture = folder / "view.png"
    # 1600 x 1200 points of one colour take some 10 kB.
    if (not picture.exists() or picture.stat().st_size < 30_000 or
            "ERR|" in made.stderr):
        return [f"no picture by view.py: {made.stderr[-500:]}"]
    return []


def view_faults(folder):
    path = folder / "view.py"
    if not path.exists():
        return ["no view.py beside run.pvd"]
    script = path.read_text()
    if script != SCRIPT.read_text():
        return ["view.py is not that of the data"]
    ast.parse(script)
    found = array_faults(folder, script) + cell_faults(folder)
    if not shutil.which("pvbatch"):
        print("no picture: pvbatch is not here")
        return found
    return found + picture_faults(folder)
