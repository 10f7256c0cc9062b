#!/usr/bin/env python3
"""Keeps the include table of the architecture and the layers of dem.

    include_rules.py ROOT     checks dem, fem, coupling and apps below ROOT
    include_rules.py --self   checks that broken includes are caught

Every include line is put into a group (std, eigen, vtk, dem, ...). Each room
lists the groups that it may use; a header that fits no group is an error too,
so that a new package enters here before it enters the code.

The folders of dem are layers (docs/developer/architecture.md): a file includes
its own layer and those before it in LAYERS, nothing after it. Headers directly
below dem/include/dem are the first layer, but for the engine.
"""
import pathlib
import re
import sys
import tempfile

ROOMS = ("dem", "fem", "coupling", "apps")

# The first pattern that fits names the group.
GROUPS = [
    ("dem", r"dem/"),
    ("fem", r"fem/"),
    ("coupling", r"coupling/"),
    ("apps", r"apps/"),
    ("dealii", r"deal\.II/"),
    ("trilinos", r"(Epetra|Teuchos|Amesos|AztecOO|Ifpack|ml_|Belos|Tpetra)"),
    ("vtk", r"vtk"),
    ("hdf5", r"hdf5\.h$"),
    ("eigen", r"Eigen/"),
    ("openmp", r"omp\.h$"),
    ("mpi", r"(mpi\.h$|zoltan)"),
    ("json", r"nlohmann/"),
    ("zlib", r"zlib\.h$"),
    ("window", r"(EGL/|GL/)"),
    ("python", r"pybind11/"),
    ("system", r"(dlfcn|unistd|fcntl|sched|spawn|sys/[a-z]+)(\.h)?$"),
    ("std", r"(experimental/simd|[a-z_0-9]+)$"),
]

ALLOWED = {
    "dem": {"std", "eigen", "openmp", "dem"},
    "fem": {"std", "eigen", "openmp", "mpi", "dealii", "trilinos", "vtk",
            "fem"},
    "coupling": {"std", "eigen", "openmp", "mpi", "dealii", "trilinos", "vtk",
                 "dem", "fem", "coupling"},
    "apps": {"std", "eigen", "openmp", "mpi", "dealii", "trilinos", "dem",
             "fem", "coupling", "json", "zlib", "system", "python"},
}
# What single folders of a room may use besides.
EXTRA = {"dem": {"io": {"vtk", "hdf5"}, "mpi": {"mpi"}},
         "apps": {"rendering": {"vtk", "window"}}}
# Compiling these costs seconds and binds every user: sources only.
NOT_IN_PUBLIC_HEADERS = {"dealii", "trilinos", "vtk", "hdf5", "mpi"}

# The folders of dem from the first layer to the last.
LAYERS = ("base", "parameters", "shape", "particles", "contact",
          "neighbor", "boundary", "breakage", "integrate", "parallel",
          "engine", "measure", "control", "packing", "io")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def group_of(header):
    for name, pattern in GROUPS:
        if re.match(pattern, header):
            return name
    return None


def allowed_in(relative):
    """Groups that the file at this path below the root may include."""
    parts = relative.parts
    groups = set(ALLOWED[parts[0]])
    for folder, extra in EXTRA.get(parts[0], {}).items():
        if folder in parts[:-1]:
            groups |= extra
    if "include" in parts and parts[0] in ("dem", "fem", "coupling"):
        groups -= NOT_IN_PUBLIC_HEADERS
    return groups


def layer_of(parts):
    """Layer of a file of dem, from its path below include/dem or src."""
    if len(parts) > 1:
        return parts[0]
    return "engine" if parts[0].startswith("engine") else "base"


def parts_in_dem(relative):
    """Path below dem/include/dem or dem/src, or None for other files."""
    for home in ("dem/include/dem", "dem/src"):
        if relative.is_relative_to(home):
            return relative.relative_to(home).parts
    return None


def layer_fault(root, path, kind, header):
    """An include of dem that goes up the list of layers, or None."""
    parts = parts_in_dem(path.relative_to(root))
    if parts is None:
        return None
    if kind == "<":
        if not header.startswith("dem/"):
            return None
        target = pathlib.PurePath(header).parts[1:]
    else:
        beside = (path.parent / header).resolve()
        if not beside.exists():
            beside = (root / "dem/src" / header).resolve()
        target = parts_in_dem(beside.relative_to(root))
    layer, other = layer_of(parts), layer_of(target or ("",))
    for name in (layer, other):
        if name not in LAYERS:
            return f"dem/{name} is in no list of layers"
    if LAYERS.index(other) > LAYERS.index(layer):
        return f"{header}: {layer} may not include {other}"
    return None


def fault_of(root, path, kind, header):
    """What is wrong with this include line, or None."""
    relative = path.relative_to(root)
    if kind == '"':
        home = (root / relative.parts[0]).resolve()
        if not (path.parent / header).resolve().is_relative_to(home):
            return f'"{header}" leaves {relative.parts[0]}/'
        bases = (path.parent, home, home / "src")
        if not any((base / header).exists() for base in bases):
            return f'"{header}" is not in {relative.parts[0]}/'
        return layer_fault(root, path, kind, header)
    group = group_of(header)
    if group is None:
        return f"<{header}> is in no group of the include table"
    if group not in allowed_in(relative):
        return f"<{header}> is {group}, not allowed here"
    return layer_fault(root, path, kind, header)


def faults(root):
    found = []
    for room in ROOMS:
        for path in sorted((root / room).rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            for number, line in enumerate(path.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                fault = match and fault_of(root, path, *match.groups())
                if fault:
                    name = path.relative_to(root)
                    found.append(f"{name}:{number}: {fault}")
    return found


BROKEN = {
    "dem/src/a.cc": "#include <deal.II/base/point.h>",
    "dem/src/b.cc": "#include <fem/membrane.h>",
    "dem/src/shape/c.cc": "#include <vtkPolyData.h>",
    "dem/src/d.cc": "#include <mpi.h>",
    "dem/src/measure/m.cc": "#include <hdf5.h>",
    "dem/src/e.cc": "#include <nlohmann/json.hpp>",
    "dem/src/f.cc": '#include "../../fem/src/x.h"',
    "dem/include/dem/io/g.h": "#include <vtkPolyData.h>",
    "dem/include/dem/contact/h.h": "#include <dem/boundary/plane.h>",
    "dem/include/dem/vector.h": "#include <dem/shape/fit.h>",
    "dem/src/boundary/i.cc": "#include <dem/engine.h>",
    "dem/src/odd/j.cc": "#include <dem/vector.h>",
    "dem/src/parallel/k.cc": "#include <mpi.h>",
    "dem/include/dem/parallel/l.h": "#include <dem/engine.h>",
    "fem/src/a.cc": "#include <dem/vector.h>",
    "fem/src/b.cc": "#include <coupling/gain.h>",
    "fem/include/fem/c.h": "#  include <deal.II/base/point.h>",
    "coupling/src/a.cc": '#include "../../apps/case.h"',
    "coupling/src/b.cc": "#include <apps/case.h>",
    "apps/a.cc": "#include <boost/any.hpp>",
    "apps/b.cc": '#include "missing.h"',
    "apps/report/c.cc": "#include <vtkPolyData.h>",
    "apps/report/d.cc": "#include <EGL/egl.h>",
}
SOUND = {
    "dem/src/a.cc": "#include <Eigen/Dense>\n#include <dem/vector.h>",
    "dem/src/engine_lists.cc": "#include <dem/boundary/plane.h>",
    "dem/src/packing/d.cc": "#include <dem/engine.h>",
    "dem/src/io/b.cc": "#include <vtkPolyData.h>\n#include <hdf5.h>",
    "dem/src/parallel/mpi/c.cc": "#include <mpi.h>\n#include <zoltan.h>",
    "fem/src/a.cc": "#include <deal.II/base/point.h>\n#include <vector>",
    "coupling/src/a.cc": "#include <dem/x.h>\n#include <fem/y.h>",
    "apps/a.cc": '#include "a.h"\n#include <nlohmann/json.hpp>',
    "apps/a.h": "#include <string>",
    "apps/rendering/b.cc": "#include <vtkPolyData.h>\n#include <EGL/egl.h>",
}


def faults_of_tree(files):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text + "\n")
        return faults(root)


def self_test():
    if faults_of_tree(SOUND):
        return ["a sound tree is refused: " + ", ".join(faults_of_tree(SOUND))]
    return [f"{name}: {text}: not caught" for name, text in BROKEN.items()
            if len(faults_of_tree({name: text})) != 1]


def main():
    found = (self_test() if sys.argv[1] == "--self"
             else faults(pathlib.Path(sys.argv[1]).resolve()))
    for line in found:
        print(line)
    print(f"include rules: {len(found)} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
