#!/usr/bin/env python3
"""What is installed works at another folder, and examples build on it.

    installed.py BUILD_FOLDER engine|own_law|own_test|program

The prefix is moved after the installation: nothing of it knows its place.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ENVIRONMENT = {**os.environ, "OMP_WAIT_POLICY": "passive"}


def go(*words, **keys):
    ended = subprocess.run([str(word) for word in words], check=False,
                           capture_output=True, text=True, timeout=1500,
                           env=ENVIRONMENT, **keys)
    if ended.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, words))}: status "
                         f"{ended.returncode}\n{ended.stdout}\n{ended.stderr}")
    return ended.stdout


def install(build, scratch, components):
    for component in components:
        go("cmake", "--install", build, "--prefix", scratch / "first",
           "--component", component)
    shutil.move(scratch / "first", scratch / "moved")
    return scratch / "moved"


def build_example(prefix, scratch, name):
    """Copies it, so that no path leads into the source tree."""
    source = scratch / "source"
    shutil.copytree(prefix / "share/spall/data/examples" / name, source)
    go("cmake", "-S", source, "-B", scratch / "build",
       f"-DCMAKE_PREFIX_PATH={prefix}")
    go("cmake", "--build", scratch / "build")
    return source, scratch / "build"


def check_program(prefix, scratch):
    spall = prefix / "bin/spall"
    if not go(spall, "--version").startswith("spall "):
        raise SystemExit("no version")
    for file in ("share/man/man1/spall.1",
                 "share/bash-completion/completions/spall",
                 "share/zsh/site-functions/_spall", "share/doc/spall/LICENSE"):
        if not (prefix / file).exists():
            raise SystemExit(f"{file} is missing")
    # Its material, gradation and shapes are found beside the program.
    case = scratch / "case.prm"
    case.write_text("subsection Case\n  set kind = single_particle\nend\n"
                    "subsection Material\n"
                    "  set file = materials/graded_aggregate.prm\nend\n")
    traced = subprocess.run(
        ["strace", "-f", "-e", "trace=openat", spall, "check", case],
        capture_output=True, text=True, check=False, env=ENVIRONMENT) \
        if shutil.which("strace") else None
    go(spall, "check", case)
    if traced and str(prefix / "share/spall/data") not in traced.stderr:
        raise SystemExit("the data beside the program were not read")


def check_own_law(prefix, scratch):
    source, build = build_example(prefix, scratch, "own_law")
    go(build / "own_law", "run", source / "triaxial.prm", "--out",
       scratch / "run", "--threads", "1")
    summary = json.loads((scratch / "run/summary.json").read_text())
    if not summary["is_complete"] or summary["n_particles"] < 50:
        raise SystemExit(f"own_law: {summary}")
    if summary["energy_residual_ratio_1"] > 1e-3:
        raise SystemExit("own_law: energy residual "
                         f"{summary['energy_residual_ratio_1']}")
    if "cone" not in (scratch / "run/case.prm").read_text():
        raise SystemExit("own_law: the law is not in the case")


def check_own_test(prefix, scratch):
    source, build = build_example(prefix, scratch, "own_test")
    go(build / "own_test", "run", source / "incline.prm", "--out",
       scratch / "run", "--threads", "1")
    path = json.loads((scratch / "run/summary.json").read_text())["path_m"]
    expected = 0.1333
    if abs(path - expected) > 5e-3 * expected:
        raise SystemExit(f"own_test: path {path} m, expected {expected}")
    go(build / "own_test", "report", scratch / "run")


def check_engine(prefix, scratch):
    _, build = build_example(prefix, scratch, "engine")
    print(go(build / "settle"))
    libraries = go("ldd", build / "settle")
    for name in ("deal", "vtk", "trilinos", "mpi"):
        if name in libraries.lower():
            raise SystemExit(f"engine: it is linked to {name}")


def main():
    build, what = pathlib.Path(sys.argv[1]), sys.argv[2]
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        prefix = install(build, scratch, ("program", "development"))
        {"program": check_program, "engine": check_engine,
         "own_law": check_own_law, "own_test": check_own_test}[what](
             prefix, scratch)


if __name__ == "__main__":
    main()
