"""Opens the run in whose folder it lies, in ParaView 5.11 or newer: the last moment from the side,
discs at their size, coloured by layer.

    paraview --script=paraview.py                   in ParaView's window
    pvpython paraview.py [PICTURE.png [ARRAY]]      a window, or a picture, by layer or by an array
"""
import os
import sys


def own_folder():
    """Where this file lies. ParaView does not tell a script that; its call does, on Linux."""
    if "__file__" in globals():
        return os.path.dirname(os.path.abspath(__file__))
    words = []
    if os.path.exists("/proc/self/cmdline"):
        with open("/proc/self/cmdline", encoding="utf-8", errors="replace") as file:
            words = [word.split("=")[-1] for word in file.read().split("\0")]
    found = [word for word in words if os.path.basename(word) == "paraview.py"]
    return os.path.dirname(os.path.abspath(found[0] if found else "paraview.py"))


# Python, started in this folder, takes this file for ParaView's modules: here is the way past it.
FOLDER = own_folder()
sys.path = [path for path in sys.path if os.path.abspath(path) != FOLDER]
if __name__ == "paraview":
    del sys.modules["paraview"]
import paraview.simple as pv

LOOK = {}   # the program writes the colours of its figures here


def opened(name):
    """The series of that name beside this file, at its last moment; None if there is none."""
    path = os.path.join(FOLDER, name)
    if not os.path.exists(path):
        return None
    series = pv.PVDReader(registrationName=name, FileName=path)
    series.UpdatePipeline(max(series.TimestepValues))
    return series


def part(series, name):
    block = pv.ExtractBlock(registrationName=name, Input=series, Selectors=[f"/Root/{name}"])
    block.UpdatePipeline(max(series.TimestepValues))
    return block


def layer_colour(k, strata):
    """Colour of band or stratum k, as in the figures: every second stratum slightly lighter."""
    if k < 0:
        return rgb(LOOK["pre_rift"]["colours"][(-k - 1) % 2][1:])
    place = int(255 * (k - 1) / max(strata - 1, 1) + 0.5) if k > 0 else 0
    colour = rgb(LOOK["rows"][6 * place:6 * place + 6])
    lighter = LOOK["strata"]["lighter"] if strata >= LOOK["strata"]["lighter_from"] and k % 2 == 0 else 0
    return [part + lighter * (1 - part) for part in colour]


def rgb(digits):
    return [part / 255 for part in bytes.fromhex(digits)]


def layer_formula():
    """A disc's stratum or band of rock, for ParaView's calculator; discs above the surface are in the first band."""
    return f"if(stratum > 0, stratum, -1 - floor(max(start_depth_m, 0) / {LOOK['pre_rift']['layer_m']}))"


def colour_by_layer(display, layers):
    """A colour for every band of rock (..., -2, -1) and every stratum (1, 2, ...)."""
    low, high = (int(end) for end in layers.PointData["layer"].GetRange())
    high = max(high, low + 1)   # ParaView needs two colours
    colours = pv.GetColorTransferFunction("layer")
    colours.AutomaticRescaleRangeMode = "Never"
    colours.NumberOfTableValues = high - low + 1
    colours.RGBPoints = [number for k in range(low, high + 1) for number in (k, *layer_colour(k, high))]
    pv.ColorBy(display, ("POINTS", "layer"))


def show_discs(series, view, array):
    """Discs; the sole and the walls; unbroken bonds, which are hidden."""
    discs = pv.Calculator(registrationName="layers", Input=part(series, "discs"),
                          ResultArrayName="layer", Function=layer_formula())
    discs.UpdatePipeline(max(series.TimestepValues))
    display = pv.Show(discs, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Plain circle"
    display.GaussianRadius = 1.0
    display.ScaleByArray = 1
    display.SetScaleArray = ["POINTS", "radius_m"]
    display.UseScaleFunction = 0
    colour_by_layer(display, discs)
    if array:
        if array not in discs.PointData.keys():
            sys.exit(f"no array {array}; there are {', '.join(discs.PointData.keys())}")
        pv.ColorBy(display, ("POINTS", array))
        display.RescaleTransferFunctionToDataRange(False)
        display.SetScalarBarVisibility(view, True)
    bonds = pv.Threshold(registrationName="bonds", Input=part(series, "contacts"),
                         Scalars=["CELLS", "bonded"], LowerThreshold=1, UpperThreshold=1)
    lines(bonds, view, (0.25, 0.2, 0.15), 1.0)
    pv.Hide(bonds, view)
    lines(part(series, "base"), view, (0.8, 0.0, 0.0), 2.0)
    return discs


def lines(source, view, colour, width):
    display = pv.Show(source, view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = colour
    display.LineWidth = width


def show_footwall(series, view, in_colour):
    """The elastic footwall where it has moved to, with its vertical displacement."""
    moved = pv.WarpByVector(registrationName="footwall", Input=series,
                            Vectors=["POINTS", "displacement_m"])
    moved.UpdatePipeline(max(series.TimestepValues))
    display = pv.Show(moved, view)
    if in_colour:
        pv.ColorBy(display, ("POINTS", "displacement_m", "Y"))
        display.RescaleTransferFunctionToDataRange(False)
        display.SetScalarBarVisibility(view, True)
    else:
        display.ColorArrayName = ["POINTS", ""]
        display.AmbientColor = display.DiffuseColor = (0.9, 0.9, 0.88)
    display.Position = (0.0, 0.0, -100.0)   # behind the discs
    return moved


def time_format(moments):
    """Text of the time and its factor for moments in Myr, as in the figures: years where the last is before 10,000
    years, and decimals that tell moments apart."""
    unit, years, decimals = ("Myr", 1e6, 2) if max(moments) >= 0.01 else ("a", 1.0, 0)
    gap = 1e6 * min((b - a for a, b in zip(moments, moments[1:])), default=1.0)
    while years * 10.0 ** -decimals > 1.01 * gap and decimals < 9:
        decimals += 1
    return "{time:.%df} %s" % (decimals, unit), 1e6 / years


def main():
    run, footwall = opened("paraview.pvd"), opened("footwall.pvd")
    if not run and not footwall:
        sys.exit(f"{FOLDER}: neither paraview.pvd nor footwall.pvd; "
                 "start ParaView in the folder of the run")
    pv._DisableFirstRenderCameraReset()   # as ParaView's own traces begin
    view = pv.GetActiveViewOrCreate("RenderView")
    view.InteractionMode = "2D"
    view.OrientationAxesVisibility = 0
    pv.LoadPalette("WhiteBackground")
    pv.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    pv.GetAnimationScene().GoToLast()
    if footwall:
        subject = show_footwall(footwall, view, not run)
    if run:
        subject = show_discs(run, view, sys.argv[2] if len(sys.argv) > 2 else "")
        text, factor = time_format(list(run.TimestepValues))
        time = pv.AnnotateTimeFilter(registrationName="time", Input=run, Format=text, Scale=factor)
        pv.Show(time, view)
    left, right, bottom, top = subject.GetDataInformation().DataInformation.GetBounds()[:4]
    view.ViewSize = (1400, max(300, int(1400 * (top - bottom) / (right - left)) + 60))
    view.CameraParallelProjection = 1
    view.CameraViewUp = (0.0, 1.0, 0.0)
    view.CameraFocalPoint = ((left + right) / 2, (bottom + top) / 2, 0.0)
    view.CameraPosition = ((left + right) / 2, (bottom + top) / 2, right - left)
    view.CameraParallelScale = 0.51 * (right - left) * view.ViewSize[1] / view.ViewSize[0]
    pv.SetActiveSource(subject)
    pv.Render(view)
    if len(sys.argv) > 1:
        pv.SaveScreenshot(sys.argv[1], view)
    elif sys.argv[0]:   # not ParaView's own window, where it is empty
        pv.Interact(view)


if __name__ == "__main__":
    main()
