#!/usr/bin/env python3
"""Libraries of Spall, and one step of the engine, into docs/pictures.

    python3 scripts/figures/architecture.py
"""
from svg import BLUE, Drawing, GREY, INK, PALE

DEM, FEM, BOTH, TOP = "#dbe7f3", "#f3e3d3", "#e2efdf", "#eceaf4"


def box(d, x, y, width, height, title, lines=(), fill=PALE):
    d.rect(x, y, width, height, fill=fill)
    d.text(x + width / 2, y + 20, title, is_bold=True)
    for k, line in enumerate(lines):
        d.text(x + width / 2, y + 39 + 17 * k, line, size=12)


def libraries():
    d = Drawing(720, 450, "The program and its libraries: apps above coupling, "
                "coupling above dem and fem")
    box(d, 20, 16, 680, 82, "apps: the program spall", (
        "reads a case, builds particles, boundaries and meshes, runs the "
        "steps, writes files and reports;",
        "one registry of kinds: triaxial, compaction, single particle, "
        "Los Angeles, subgrade, scene"), TOP)
    box(d, 190, 136, 340, 82, "coupling", (
        "exchange of motion and load in windows,",
        "relaxation, exchange gain, ledger, cycle jump"), BOTH)
    box(d, 20, 256, 400, 132, "dem", (
        "parameters · shape · particles",
        "contact · neighbor · boundary · breakage",
        "integrate · parallel · engine",
        "measure · control · packing · io"), DEM)
    box(d, 470, 256, 230, 132, "fem", (
        "membrane · solid · condensed solid",
        "plate · drives · meshes",
        "Drucker-Prager, neo-Hookean"), FEM)
    d.text(220, 378, "a folder includes those to its left and above it only",
           size=11, colour=GREY)
    d.text(220, 410, "Eigen · OpenMP · MPI and Zoltan in parallel · VTK in io",
           size=12, colour=BLUE)
    d.text(585, 410, "deal.II · Trilinos · MPI", size=12, colour=BLUE)
    for x1, y1, x2, y2 in ((360, 98, 360, 134), (270, 218, 270, 254),
                           (505, 218, 505, 254), (90, 98, 90, 254),
                           (640, 98, 640, 254)):
        d.arrow(x1, y1, x2, y2)
    d.text(360, 438, "An arrow means: includes. dem and fem do not know each "
           "other.", size=12, colour=GREY)
    d.save("architecture_libraries")


STEP = (("boundaries move", "planes, drum, facets, servo walls",
         "Boundary::move"),
        ("half kick and drift", "pending half kick, first half kick, positions",
         "kick_and_drift"),
        ("states of ghosts", "on many ranks only", "Halo::send_states"),
        ("lists, when due", "grid, pairs, contact points, walls",
         "NeighborSchedule"),
        ("contacts", "kinematics, law, damage; loads in exact sums",
         "run_contacts"),
        ("loads on boundaries", "sums over ranks, work of the step",
         "Boundary::apply_loads"),
        ("breakage, if a contact asks", "events in the order of ids, new shape",
         "break_corners"),
        ("second half kick", "pending, until someone reads velocities",
         "synchronize"))


def step():
    d = Drawing(720, 506, "One step of the engine from the motion of the "
                "boundaries to the second half kick")
    d.text(44, 30, "Engine::advance", anchor="start", is_bold=True, size=15)
    top, height, pitch = 48, 42, 54
    for k, (title, words, code) in enumerate(STEP):
        y = top + pitch * k
        is_optional = k in (2, 3, 6)
        d.rect(130, y, 380, height, fill="#ffffff" if is_optional else DEM,
               dash="5 3" if is_optional else "")
        d.text(320, y + 18, title, is_bold=True)
        d.text(320, y + 34, words, size=12)
        d.text(526, y + 26, code, anchor="start", colour=BLUE, size=12)
        if k:
            d.arrow(320, y - pitch + height, 320, y - 1)
    last = top + pitch * (len(STEP) - 1) + height / 2
    d.line((130, last), (90, last), (90, top + height / 2), width=1.6,
           stroke=INK)
    d.arrow(90, top + height / 2, 128, top + height / 2)
    d.text(78, (top + last) / 2, "next step", turned=-90)
    d.text(320, 490, "Dashed: only where it is due. Blue: where in the code.",
           size=12, colour=GREY)
    d.save("engine_step")


if __name__ == "__main__":
    libraries()
    step()
