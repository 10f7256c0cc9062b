#!/usr/bin/env python3
"""Spall is configured without each part that can be left out.

    switches.py CMAKE SOURCE

Configures with every switch off while CMake refuses to look for the packages
of these parts, and looks for traces of them in what would be built. It
compiles nothing.
"""
import pathlib
import subprocess
import sys
import tempfile

from triaxial_runs import report_faults

# The packages of a part, and words that only a build with it has.
PARTS = {
    "SPALL_PYTHON": (("pybind11",), ("pybind11", "spall_engine")),
    "SPALL_RENDERING": (("OpenGL", "GLEW", "Freetype"),
                        ("vtkRendering", "libEGL", "rendering/draw.cc")),
    "SPALL_HDF5": ((), ("-DSPALL_HDF5", "table_file_test.cc")),
}


def faults(cmake, source):
    words = [f"-D{switch}=OFF" for switch in PARTS]
    words += [f"-DCMAKE_DISABLE_FIND_PACKAGE_{package}=ON"
              for packages, _ in PARTS.values() for package in packages]
    with tempfile.TemporaryDirectory() as name:
        build = pathlib.Path(name)
        ended = subprocess.run([cmake, "-G", "Ninja", "-S", source, "-B",
                                build, *words], check=False, text=True,
                               capture_output=True)
        if ended.returncode != 0:
            return [ended.stderr[-3000:]]
        rules = (build / "build.ninja").read_text()
        config = (build / "SpallConfig.cmake").read_text()
        tests = "".join(path.read_text() for path in
                        build.rglob("CTestTestfile.cmake"))
    found = [f"{switch} = OFF: {word} would be built"
             for switch, (_, traces) in PARTS.items() for word in traces
             if word in rules]
    found += [f"SpallConfig.cmake would ask for {switch}"
              for switch in ("SPALL_RENDERING", "SPALL_HDF5")
              if f"set({switch} OFF)" not in config]
    if "python_engine" in tests or "python_case" in tests:
        found.append("tests of the Python package are left")
    return found


if __name__ == "__main__":
    sys.exit(report_faults(faults(*sys.argv[1:3])))
