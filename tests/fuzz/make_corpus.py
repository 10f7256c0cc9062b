#!/usr/bin/env python3
"""Writes the corpus of the fuzz targets: sound files of every format and kind,
and small broken ones. Inputs that once broke a reader have names that begin
with `fault_`; those are kept as they were found and not written here.

    make_corpus.py
"""
import gzip
import json
import pathlib
import struct
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "application"))

from bad_cases import GRADATION, PACKING, ROUND, merged, prm  # noqa: E402
from test_meshes import (binary_stl, block, box_sheet,  # noqa: E402
                         box_triangles, gmsh, stl)

KINDS = ("dynamic_triaxial", "single_particle", "los_angeles",
         "vibratory_compaction", "subgrade")


def put(target, name, content):
    folder = HERE / "corpus" / target
    folder.mkdir(parents=True, exist_ok=True)
    data = content if isinstance(content, bytes) else content.encode()
    (folder / name).write_bytes(data)


def write_stl():
    box = box_triangles()
    put("stl", "text.stl", stl(box))
    put("stl", "cut_off.stl", stl(box)[:500])
    put("stl", "comma.stl", stl(box).replace("vertex 1 ", "vertex 0,5 "))
    put("stl", "binary.stl", binary_stl(box, 12))
    put("stl", "promises_more.stl", binary_stl(box, 0x7fffffff))


def write_obj():
    corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    put("obj", "pyramid.obj", corners + "v 0.5 0.5 3\nf 1 4 3 2\nf 1 2 5\n"
        "f 2 3 5\nf 3 4 5\nf 4 1 5\n")
    put("obj", "back.obj", corners + "vt 0 0\nf -4/1 -1//1 -2/1/1 \\\n-3\n")
    put("obj", "bad_index.obj", corners + "f 4 1 5 1000008\n")
    rim = ((2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 0))
    put("obj", "polygon.obj", "".join(
        f"v {x} {y} 0\n" for x, y in rim) + "f 1 2 3 4 5 6\n")


def write_ply():
    start = "element vertex 4\nproperty float x\nproperty float y\n" \
        "property float z\nelement face 4\n" \
        "property list uchar int vertex_indices\nend_header\n"
    faces = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
    put("ply", "text.ply", "ply\nformat ascii 1.0\n" + start +
        "0 0 0\n1 0 0\n0 1 0\n0 0 1\n" +
        "".join("3 %d %d %d\n" % face for face in faces))
    for name, sign in (("little", "<"), ("big", ">")):
        data = f"ply\nformat binary_{name}_endian 1.0\n{start}".encode()
        for point in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)):
            data += struct.pack(sign + "3f", *point)
        for face in faces:
            data += struct.pack(sign + "B3i", 3, *face)
        put("ply", name + ".ply", data)
    put("ply", "fault_header_without_end.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
        "property float x\nend_header")


def write_gmsh():
    put("gmsh", "ground.msh", gmsh(*block([0., 1.], [0., 1., 2.], [-1., 0.])))
    put("gmsh", "sheet.msh", box_sheet([0., 1.], [0., 1.]))
    start = "$MeshFormat\n%s 0 8\n$EndMeshFormat\n"
    put("gmsh", "format_4_1.msh", start % "4.1" + (
        "$Entities\n1 0 1 0\n1 0 0 0 0\n1 0 0 0 1 1 1 1 7 2 1 -2\n"
        "$EndEntities\n$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n"
        "$Elements\n1 1 1 1\n2 1 3 1\n1 1 2 3 4\n$EndElements\n"))
    put("gmsh", "format_4_0.msh", start % "4" + (
        "$Entities\n0 0 1 0\n1 0 0 0 1 1 1 1 7 0\n$EndEntities\n"
        "$Nodes\n1 4\n1 2 0 4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
        "$EndNodes\n$Elements\n1 1\n1 2 3 1\n1 1 2 3 4\n$EndElements\n"))
    put("gmsh", "format_1.msh", "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n"
        "4 0 1 0\n$ENDNOD\n$ELM\n1\n1 3 1 1 4 1 2 3 4\n$ENDELM\n")
    put("gmsh", "many_nodes.msh", start % "2.2" + "$Nodes\n900000000\n1 0 0 0\n")
    put("gmsh", "second_order.msh", start % "2.2" + (
        "$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n"
        "1 16 2 1 1 1 1 1 1 1 1 1 1\n$EndElements\n"))


def write_cases():
    for kind in KINDS:
        sections = {"Case": {"kind": kind},
                    "Particle": {"density": 2650, "friction": 0.5},
                    "Time": {"step": "stable", "safety": 0.5}}
        put("prm", kind + ".prm", prm(sections))
        put("json", kind + ".json", json.dumps(sections))
    put("prm", "sound.prm", prm(merged({})))
    put("prm", "comment.prm", "# a case\nsubsection Particle # its particles\n"
        "  set density = 2650 # kg/m^3\nend\n")
    put("prm", "marked.prm", b"\xef\xbb\xbf" + prm(merged({})).encode())
    put("json", "sound.json", json.dumps(merged({})))
    put("json", "twice.json", '{"Particle": {"friction": 1, "friction": 2}}')


def write_tables():
    put("gradation", "two_rows.csv", GRADATION)
    put("gradation", "comma.csv", "diameter_m,passing_1\n0,008;0\n0,016;1\n")
    put("tables", "load.csv", "time_s,force_N\n0,0\n0.1,5e3\n0.2,0\n")
    put("tables", "share.csv", "distance_m,share_1\n0,0.4\n0.6,0.3\n1.2,0\n")
    put("load_path", "ramp.csv", "name,axial_stress_Pa,duration_s\n"
        "ramp,6e4,0.1\nrest,6e4,0.1\n")
    put("load_path", "waves.csv",
        "wave,amplitude_Pa,frequency_Hz,cycles_1,rest_s,lateral_rule\n"
        "haversine,1e4,10,5,0.1,\nsquare,1e4,5,2,,constant_p\n")
    put("load_path", "driven.csv",
        "axial_strain_1,axial_strain_rate_1_per_s,until_stress_ratio_1\n"
        "0.05,0.1,1.2\n")
    put("load_path", "own_table.csv",
        "wave,wave_file,amplitude_Pa,frequency_Hz,cycles_1\n"
        "table,path.csv,1,1,1\n")
    put("packing", "plain.csv", "# box 1 1 1\n" + PACKING)
    put("packing", "turned.csv", "x,y,z,radius,qw,qx,qy,qz\n"
        "0.5,0.5,0.5,0.1,1,0,0,0\n")
    put("packing", "packed.csv.gz", gzip.compress(PACKING.encode(), mtime=0))
    put("packing", "cut_off.csv.gz",
        gzip.compress(PACKING.encode(), mtime=0)[:-6])
    put("shape", "round.json", json.dumps(ROUND))
    put("shape", "order_1.json", json.dumps(
        {**ROUND, "order": 1, "unit": "mm",
         "coefficients": [35.4, 0., 1e-3, 0.]}))


def write_states():
    """The first byte chooses (tests/fuzz/targets/state_file.h)."""
    for target in ("checkpoint", "preparation"):
        put(target, "empty", b"\0")
        put(target, "sound", b"\1")
        put(target, "damaged", b"\1\x40\0\xff")
        put(target, "cut_off", b"\1\x40\0\xff\0")
        put(target, "digested", b"\2\x40\0\xff\x10\0\1")


def main():
    for write in (write_stl, write_obj, write_ply, write_gmsh, write_cases,
                  write_tables, write_states):
        write()


if __name__ == "__main__":
    main()
