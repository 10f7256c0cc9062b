"""Shows the frames of the run folder that this file is in with ParaView.

    paraview --script=view.py                          from within the folder
    pvbatch view.py [--picture FILE.png] [--frame N]   a picture, no window

Frames are counted from 0, -1 is the last one. Particles are drawn by their true
surfaces where every frame that is asked for has them, else as balls; forces
between them as tubes.
"""
import argparse
import math
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

import paraview.simple as pv

# What colours the particles, title of its bar with the unit, and how much of them
# stands before the forces.
LOSS = ("loss_1", "Share of volume lost [-]")
SPEED = ("velocity_m_per_s:Magnitude", "Speed [m/s]")
PLAIN = (None, None)
PARTICLES = {
    "dynamic_triaxial": (LOSS, 0.25),
    "vibratory_compaction": (LOSS, 0.25),
    "single_particle": (PLAIN, 0.6),
    "los_angeles": (SPEED, 1.0),
    "subgrade": (SPEED, 0.25),
}

# What colours a body of its own, title of its bar, opacity.
BODIES = {
    "membrane": ("displacement_m:Magnitude", "Membrane displacement [m]", 0.35),
    "subgrade": ("displacement_m:Z", "Ground, vertical displacement [m]", 1.0),
    "plate": (None, None, 0.5),
    "drum": (None, None, 0.15),
}

# Shades from the lowest value to the highest.
PARTICLE_SHADES = [[0.78, 0.75, 0.70], [0.80, 0.35, 0.15], [0.45, 0.0, 0.05]]
FORCE_SHADES = [[0.95, 0.90, 0.60], [0.90, 0.45, 0.10], [0.25, 0.0, 0.20]]
BODY_SHADES = [[0.45, 0.65, 0.85], [0.75, 0.85, 0.93], [0.98, 0.96, 0.88]]


def read_case(folder):
    """Keys of case.prm by section: {"Case": {"kind": "subgrade"}}."""
    case, sections = {}, []
    for line in (folder / "case.prm").read_text().splitlines():
        if found := re.match(r"\s*subsection (.+?)\s*$", line):
            sections.append(found[1])
        elif line.strip() == "end":
            sections.pop()
        elif found := re.match(r"\s*set (\S+)\s*= *(.*?)\s*$", line):
            value = found[2]
            if len(value) > 1 and value[0] == value[-1] == '"':
                value = value[1:-1].replace('""', '"')
            case.setdefault("/".join(sections), {})[found[1]] = value
    return case


class Frames:
    """run.pvd: which part of it holds what, and at which times."""

    def __init__(self, folder):
        self.reader = pv.PVDReader(FileName=str(folder / "run.pvd"))
        self.times = list(self.reader.TimestepValues)
        parts = {}
        self.holds = {}
        for entry in ElementTree.parse(folder / "run.pvd").iter("DataSet"):
            name = pathlib.Path(entry.get("file")).name.rsplit("_", 1)[0]
            parts[int(entry.get("part"))] = name
            self.holds.setdefault(name, set()).add(
                float(entry.get("timestep")))
        self.order = [parts[part] for part in sorted(parts)]

    def part(self, name):
        """As a source of its own."""
        block = self.order.index(name)
        return pv.MergeBlocks(Input=pv.ExtractBlock(
            Input=self.reader, Selectors=[f"/Root/Block{block}"]))

    def always_holds(self, name, times):
        return self.holds.get(name, set()) >= set(times)


class Bars:
    """Colours by fields, with bars side by side along the lower edge."""

    def __init__(self, view):
        self.view, self.n = view, 0

    def colour(self, display, association, field, title, shades):
        """From zero on, or about it where the field has both signs; without a
        field in the lowest shade."""
        if not field:
            pv.ColorBy(display, (association, None))
            display.DiffuseColor = shades[0]
            return
        pv.ColorBy(display, (association, *field.split(":")))
        display.RescaleTransferFunctionToDataRange()
        scale = pv.GetColorTransferFunction(field.split(":")[0])
        low, high = scale.RGBPoints[0], scale.RGBPoints[-4]
        low = low if low < -1e-6 * high else 0.
        high = max(high, 0., low + 1e-30)
        scale.ColorSpace = "RGB"
        scale.RGBPoints = [number for k, shade in enumerate(shades)
                           for number in (low + (high - low) * k /
                                          (len(shades) - 1), *shade)]
        bar = pv.GetScalarBar(scale, self.view)
        bar.Title, bar.ComponentTitle = title, ""
        bar.TitleColor = bar.LabelColor = [0, 0, 0]
        bar.TitleFontSize = bar.LabelFontSize = 14
        bar.AutomaticLabelFormat = 0
        bar.RangeLabelFormat = bar.LabelFormat = "%.2g"
        bar.Orientation, bar.WindowLocation = "Horizontal", "Any Location"
        bar.ScalarBarLength = 0.25
        bar.Position = [0.05 + 0.32 * self.n, 0.03]
        display.SetScalarBarVisibility(self.view, True)
        self.n += 1


def show_particles(frames, bars, kind, times):
    (field, title), opacity = PARTICLES[kind]
    has_surfaces = frames.always_holds("surfaces", times)
    if has_surfaces:
        particles = frames.part("surfaces")
        field, title = LOSS if field else PLAIN
    else:
        particles = pv.Glyph(Input=frames.part("particles"), GlyphType="Sphere",
                          ScaleArray=["POINTS", "radius_m"], ScaleFactor=2.0,
                          OrientationArray=["POINTS", "No orientation array"],
                          GlyphMode="All Points")
        particles.GlyphType.ThetaResolution = 24
        particles.GlyphType.PhiResolution = 16
    display = pv.Show(particles, bars.view)
    display.Opacity = opacity
    bars.colour(display, "CELLS" if has_surfaces else "POINTS", field, title,
                PARTICLE_SHADES)
    return particles


def show_forces(frames, bars, radius):
    """Lines from particle to particle or wall, as thick as the root of their force,
    the greatest with this radius."""
    lines = pv.ExtractSurface(Input=frames.part("contacts"))
    lines.UpdatePipeline()
    force = lines.PointData["normal_force_N"]
    if not force or force.GetRange()[1] <= 0.:
        return
    thick = pv.Calculator(
        Input=lines, ResultArrayName="thickness_m",
        Function=f"{radius}*sqrt(abs(normal_force_N)/{force.GetRange()[1]})")
    tubes = pv.Tube(Input=thick, Scalars=["POINTS", "thickness_m"], Radius=1.0,
                    VaryRadius="By Absolute Scalar", NumberofSides=10)
    bars.colour(pv.Show(tubes, bars.view), "POINTS", "normal_force_N",
                "Normal force [N]", FORCE_SHADES)


def show_bodies(frames, bars):
    for name, (field, title, opacity) in BODIES.items():
        if name not in frames.order:
            continue
        body = frames.part(name)
        if name == "subgrade":  # the half behind the middle
            body = pv.Clip(Input=body, ClipType="Plane", Invert=0)
            body.ClipType.Normal = [0, 1, 0]
        display = pv.Show(body, bars.view)
        display.Opacity = opacity
        bars.colour(display, "POINTS", field, title, BODY_SHADES)


def place_camera(view, kind, bounds):
    """Upright, from the front and a little from above, on the particles with
    what is round them."""
    wide = {"subgrade": 1.8, "los_angeles": 1.2}.get(kind, 0.9)
    centre = [0.5 * (bounds[c] + bounds[c + 1]) for c in (0, 2, 4)]
    if kind == "los_angeles":
        centre = [0.0, 0.0, 0.0]
    reach = wide * math.dist(bounds[::2], bounds[1::2])
    way = {"los_angeles": (0.3, -2.0, 0.2)}.get(kind, (0.6, -2.0, 0.7))
    view.CameraPosition = [middle + reach * part
                           for middle, part in zip(centre, way)]
    view.CameraFocalPoint = view.CenterOfRotation = centre
    view.CameraViewUp = [0, 0, 1]


def show(folder, times):
    case = read_case(folder)
    kind = case["Case"]["kind"]
    frames = Frames(folder)
    view = pv.GetActiveViewOrCreate("RenderView")
    view.ViewSize = [1600, 1200]
    view.UseColorPaletteForBackground = 0
    view.Background, view.OrientationAxesLabelColor = [1, 1, 1], [0, 0, 0]
    scene = pv.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = view.ViewTime = times(frames)[-1]
    bars = Bars(view)
    particles = show_particles(frames, bars, kind, times(frames))
    bounds = particles.GetDataInformation().GetBounds()
    if kind != "los_angeles":
        show_forces(frames, bars, 0.015 * (bounds[5] - bounds[4]))
    show_bodies(frames, bars)
    time = pv.AnnotateTimeFilter(Input=frames.reader,
                                 Format="t = {time:.4g} s")
    shown = pv.Show(time, view)
    shown.Color, shown.FontSize = [0, 0, 0], 14
    pv.Render(view)  # the first time it places the camera itself
    place_camera(view, kind, bounds)
    return view


def main():
    parser = argparse.ArgumentParser(prog="view.py")
    parser.add_argument("--picture", help="a file .png to write")
    parser.add_argument("--frame", type=int, default=-1, help="of the picture")
    options = parser.parse_args(sys.argv[1:])
    # A script that ParaView is started with does not know its own file.
    folder = pathlib.Path(globals().get("__file__", "view.py")).resolve().parent
    if not (folder / "run.pvd").exists():
        sys.exit(f"view.py: {folder} has no run.pvd: it is to be started in a "
                 "run folder with frames")

    def times(frames):
        n = len(frames.times)
        if not -n <= options.frame < n:
            sys.exit(f"view.py: --frame {options.frame}: must be a whole "
                     f"number from {-n} to {n - 1}")
        return [frames.times[options.frame]] if options.picture \
            else frames.times
    view = show(folder, times)
    pv.Render(view)
    if options.picture:
        pv.SaveScreenshot(options.picture, view)


main()
