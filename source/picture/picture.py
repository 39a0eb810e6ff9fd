"""Picture of a finished or running experiment, made by ParaView without a screen: `./seedflow picture FOLDER`.

Reads what every run writes for ParaView: seeds.pvd (spheres, coloured by their speed), walls.vtp and moving_walls.pvd
(translucent), air.pvd (speed of the air on one plane). What is missing is left out; without seeds and air there is no
picture and the exit status is 2. Up is against gravity, which is read from used.prm.
"""

import argparse
import itertools
import math
import os
import re
import sys

from paraview import simple as pv


def fail(message):
    print(message, file=sys.stderr)
    sys.stderr.flush()
    os._exit(2)  # pvbatch answers sys.exit() with status 0


def numbers(count):
    def parse(text):
        try:
            values = [float(part) for part in text.split(",")]
        except ValueError:
            values = []
        if len(values) != count or not all(math.isfinite(v) for v in values):
            raise argparse.ArgumentTypeError(f"'{text}' are not {count} numbers separated by commas")
        return values

    return parse


def positive(text):
    value = numbers(1)(text)[0]
    if value <= 0:
        raise argparse.ArgumentTypeError(f"'{text}' is not above 0")
    return value


def pixels(text):
    values = numbers(2)(text)
    if not all(10 <= v <= 20000 for v in values):
        raise argparse.ArgumentTypeError(f"'{text}' are not two numbers from 10 to 20000")
    return values


class Arguments(argparse.ArgumentParser):
    def error(self, message):
        fail(f"./seedflow picture: {message}\n{self.format_usage().strip()}")


def read_arguments():
    parser = Arguments(prog="./seedflow picture", allow_abbrev=False,
                       description="Picture of a run, by ParaView without a screen.")
    parser.add_argument("folder", help="output folder of the run")
    parser.add_argument("--time", type=float, help="simulated time [s]; the nearest written one is taken (default: the last)")
    parser.add_argument("--plane", help="where the air is shown, as in z=-0.0005 [m] (default: through the middle of the seeds)")
    parser.add_argument("--speed", type=positive, help="speed of the air at the end of its colours [m/s] (default: the largest)")
    parser.add_argument("--from", dest="view", type=numbers(3), metavar="X,Y,Z", help="direction from which it is seen, as in --from=0.3,0.2,-1")
    parser.add_argument("--zoom", type=positive, default=1, help="1: everything is seen (default)")
    parser.add_argument("--size", type=pixels, default=[1600, 1200], metavar="W,H", help="in pixels")
    parser.add_argument("--file", help="PNG to write (default: picture.png in the folder)")
    return parser.parse_args()


def up_direction(folder):
    """Against gravity; z without one."""
    try:
        with open(os.path.join(folder, "used.prm"), encoding="utf-8") as used:
            found = re.search(r"^\s*set Gravity\s*=\s*([^#\n]+)", used.read(), re.MULTILINE)
        g = [float(part) for part in found.group(1).split(",")]
        g += [0.0] * (3 - len(g))
        size = math.sqrt(dot(g, g))
        return [-c / size for c in g]
    except (OSError, AttributeError, ValueError, ZeroDivisionError):
        return [0, 0, 1]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    size = math.sqrt(dot(v, v))
    return [c / size for c in v]


class Scene:
    def __init__(self, arguments):
        self.folder = arguments.folder
        self.view = pv.CreateView("RenderView")
        self.view.ViewSize = [int(c) for c in arguments.size]
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [1, 1, 1]
        self.view.OrientationAxesVisibility = 0
        self.view.EnableRayTracing = 0
        self.time = arguments.time
        self.bounds = None  #: of what must be seen: the air, or seeds and walls without it
        self.has_air = False
        self.seeds = None  #: bounds of the seeds

    def open(self, name):
        path = os.path.join(self.folder, name)
        if not os.path.exists(path):
            return None
        source = pv.OpenDataFile(path)
        times = list(getattr(source, "TimestepValues", []) or [])
        if times:
            time = times[-1] if self.time is None else min(times, key=lambda t: abs(t - self.time))
            pv.UpdatePipeline(time, source)
            self.view.ViewTime = time
        else:
            source.UpdatePipeline()
        if source.GetDataInformation().GetNumberOfPoints() == 0:
            return None
        return source

    def include(self, source):
        b = source.GetDataInformation().GetBounds()
        if self.bounds is None:
            self.bounds = list(b)
        for axis in range(3):
            self.bounds[2 * axis] = min(self.bounds[2 * axis], b[2 * axis])
            self.bounds[2 * axis + 1] = max(self.bounds[2 * axis + 1], b[2 * axis + 1])

    def colour(self, display, name, title, preset, largest, position):
        pv.ColorBy(display, ("POINTS", name, "Magnitude"))
        table = pv.GetColorTransferFunction(name + title, display, separate=False)
        display.LookupTable = table
        table.ApplyPreset(preset, True)
        if preset == "Blues":
            table.InvertTransferFunction()
        table.RescaleTransferFunction(0, largest)
        table.VectorMode = "Magnitude"
        bar = pv.GetScalarBar(table, self.view)
        bar.Title, bar.ComponentTitle = title, ""
        bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
        bar.TitleFontSize = bar.LabelFontSize = 14
        bar.WindowLocation = "Any Location"
        bar.Position, bar.ScalarBarLength = position, 0.3
        bar.LabelFormat = bar.RangeLabelFormat = "%-#6.3g"
        bar.Visibility = 1
        display.SetScalarBarVisibility(self.view, True)

    def show_walls(self, name, opacity):
        walls = self.open(name)
        if walls is None:
            return
        if not self.has_air:
            self.include(walls)
        display = pv.Show(walls, self.view)
        display.Representation = "Surface"
        display.ColorArrayName = [None, ""]  # one colour
        display.DiffuseColor = [0.75, 0.79, 0.84]
        display.Opacity = opacity

    def show_seeds(self):
        seeds = self.open("seeds.pvd")
        if seeds is None:
            return False
        self.include(seeds)
        self.seeds = seeds.GetDataInformation().GetBounds()
        balls = pv.Glyph(seeds, GlyphType="Sphere")
        balls.GlyphType.Radius = 1
        balls.GlyphType.ThetaResolution = balls.GlyphType.PhiResolution = 16
        balls.ScaleArray = ["POINTS", "radius"]
        balls.ScaleFactor = 1
        balls.GlyphMode = "All Points"
        balls.OrientationArray = ["POINTS", "No orientation array"]
        display = pv.Show(balls, self.view)
        largest = largest_speed(seeds)
        self.colour(display, "velocity", "seeds [m/s]", "Plasma (matplotlib)", largest, [0.89, 0.6])
        return True

    def show_air(self, plane, largest, front):
        air = self.open("air.pvd")
        if air is None:
            return False
        b = air.GetDataInformation().GetBounds()
        self.bounds, self.has_air = None, True
        self.include(air)
        slice_ = pv.Slice(air, SliceType="Plane")
        # Without a wish: through the middle of the seeds, facing who looks from the front.
        axis, place = "xyz"[[abs(c) for c in front].index(1)], None
        if plane:
            found = re.fullmatch(r"\s*([xyz])\s*=\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*", plane)
            if not found:
                fail(f"./seedflow picture: --plane '{plane}' is not like z=-0.0005.")
            axis, place = found.group(1), float(found.group(2))
        k = "xyz".index(axis)
        if place is None:
            middle = self.seeds or b
            place = min(max(0.5 * (middle[2 * k] + middle[2 * k + 1]), b[2 * k]), b[2 * k + 1])
        if not b[2 * k] <= place <= b[2 * k + 1]:
            fail(f"./seedflow picture: --plane {axis}={place:g} lies outside the air, {axis} from {b[2 * k]:g} to {b[2 * k + 1]:g} m.")
        slice_.SliceType.Normal = [float(i == k) for i in range(3)]
        slice_.SliceType.Origin = [place if i == k else 0.5 * (b[2 * i] + b[2 * i + 1]) for i in range(3)]
        display = pv.Show(slice_, self.view)
        slice_.UpdatePipeline(self.view.ViewTime)
        self.colour(display, "velocity", "air [m/s]", "Blues", largest or largest_speed(slice_), [0.89, 0.15])
        display.Ambient, display.Diffuse, display.Opacity = 0.6, 0.4, 0.85
        return True

    def look(self, direction, up, zoom):
        """Everything is seen, with room for the scales on the right."""
        b = self.bounds
        centre = [0.5 * (b[2 * i] + b[2 * i + 1]) for i in range(3)]
        direction = unit(direction)
        right = unit(cross(up, direction))
        top = cross(direction, right)
        camera = self.view.GetActiveCamera()
        width, height = self.view.ViewSize
        limit_y = 0.95 * math.tan(math.radians(0.5 * camera.GetViewAngle()))
        limit_x = 0.8 * limit_y * width / height
        distance = 0
        for corner in itertools.product((0, 1), repeat=3):
            x = [b[2 * i + corner[i]] - centre[i] for i in range(3)]
            across = max(abs(dot(x, right)) / limit_x, abs(dot(x, top)) / limit_y)
            distance = max(distance, dot(x, direction) + across)
        camera.SetFocalPoint(*centre)
        camera.SetPosition(*[c + distance / zoom * d for c, d in zip(centre, direction)])
        camera.SetViewUp(*up)
        self.view.CameraParallelProjection = 0
        camera_range = 10 * distance
        camera.SetClippingRange(1e-3 * camera_range, camera_range)


def largest_speed(source):
    information = source.GetPointDataInformation().GetArray("velocity")
    return max(1e-9, information.GetRange(-1)[1]) if information else 1


def front_direction(up):
    return [0, 0, -1] if abs(up[2]) < 0.5 else [0, -1, 0]


def default_view(up):
    """From the front, a little from the side and from above."""
    front = front_direction(up)
    side = cross(front, up)
    return [f + 0.25 * s + 0.2 * u for f, s, u in zip(front, side, up)]


def main():
    arguments = read_arguments()
    if not os.path.isdir(arguments.folder):
        fail(f"./seedflow picture: there is no folder '{arguments.folder}'. Give the output folder of a run.")
    if not any(os.path.exists(os.path.join(arguments.folder, name)) for name in ("seeds.pvd", "air.pvd")):
        fail(f"./seedflow picture: '{arguments.folder}' has neither seeds.pvd nor air.pvd. "
             "Give the output folder of a run that wrote them (Run/Field interval above 0).")
    pv._DisableFirstRenderCameraReset()
    scene = Scene(arguments)
    seeds = scene.show_seeds()
    up = up_direction(arguments.folder)
    air = scene.show_air(arguments.plane, arguments.speed, front_direction(up))
    if not seeds and not air:
        fail(f"./seedflow picture: there are neither seeds nor air in '{arguments.folder}'.")
    view = arguments.view or default_view(up)
    if dot(cross(up, view), cross(up, view)) < 1e-12 * dot(view, view) or not any(view):
        fail("./seedflow picture: --from must not be along gravity; add a little of another direction, as in --from=0,-0.1,1.")
    scene.show_walls("walls.vtp", 0.25)
    scene.show_walls("moving_walls.pvd", 0.35)
    scene.look(view, up, arguments.zoom)
    file = arguments.file or os.path.join(arguments.folder, "picture.png")
    folder = os.path.dirname(os.path.abspath(file))
    if not os.access(folder, os.W_OK):
        fail(f"./seedflow picture: nothing can be written into '{folder}'. Give another --file.")
    pv.SaveScreenshot(file, scene.view, TransparentBackground=0)
    print(f"picture: {file} (t = {scene.view.ViewTime:g} s)")


main()
