#!/usr/bin/env python3
"""The installed package finds the program beside it.

    installed.py SPALL CMAKE INSTALL_SCRIPT
"""
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile

# Prints where the program is, and the kinds of errors and of a case.
USE = """import spall
print(spall.find_program())
print(spall.version())
print(spall.Case.from_template("scene").kind)
"""


def main():
    if not importlib.util.find_spec("numpy"):
        print("no numpy for this Python: skipped (apt install python3-numpy)")
        return 77
    spall, cmake, script = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        prefix = pathlib.Path(name)
        subprocess.run([cmake, f"-DCMAKE_INSTALL_PREFIX={prefix}", "-P",
                        script], check=True, stdout=subprocess.DEVNULL)
        packages = prefix / "lib" / "python3" / "dist-packages"
        files = {path.relative_to(packages).as_posix()
                 for path in packages.rglob("*") if path.is_file()
                 and not path.name.startswith("spall_engine.")}
        (prefix / "bin").mkdir()
        (prefix / "bin" / "spall").symlink_to(pathlib.Path(spall).resolve())
        environment = {key: value for key, value in os.environ.items()
                       if key != "SPALL"}
        environment["PYTHONPATH"] = str(packages)
        ended = subprocess.run([sys.executable, "-B", "-c", USE], cwd=name,
                               env=environment, capture_output=True, text=True,
                               check=False)
        program = str((prefix / "bin" / "spall").absolute())
    source = pathlib.Path(__file__).resolve().parents[2] / "apps" / "python"
    expected = {path.relative_to(source).as_posix()
                for path in (source / "spall").iterdir() if path.is_file()}
    faults = [f"installed: {one}" for one in sorted(files ^ expected)]
    if ended.stdout.split("\n")[:1] != [program] or \
            not ended.stdout.endswith("\nscene\n"):
        faults.append(f"printed {ended.stdout}{ended.stderr}")
    print("\n".join(faults) or "passed")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
