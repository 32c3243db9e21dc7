"""Opens the series of a run as ParaView does, prints what is in it, and draws its last moment.

    render_paraview.py OUTPUT/paraview.pvd [PICTURE.png]

Runs with ParaView's libraries or, lighter, with VTK's alone (python3-vtk9), whose readers and
painters ParaView uses. A picture needs a display; xvfb-run lends one. Exit code 77: no VTK here.
"""

import json
import pathlib
import sys
import xml.etree.ElementTree
import zlib

try:
    import numpy
    import vtkmodules.vtkRenderingOpenGL2  # noqa: makes the classes below able to draw
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkVersion
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataObject
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkFiltersCore import vtkThreshold
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    from vtkmodules.vtkRenderingCore import (vtkActor, vtkDataSetMapper, vtkPointGaussianMapper,
                                             vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)
except ImportError as error:
    print(f"{error}; install python3-vtk9 or python3-paraview", file=sys.stderr)
    sys.exit(77)
try:
    from paraview.modules.vtkPVVTKExtensionsIOCore import vtkPVDReader
except ImportError:
    vtkPVDReader = None

# Components of every array.
POINT_ARRAYS = {
    "discs": {"id": 1, "radius_m": 1, "material": 1, "stratum": 1, "start_depth_m": 1,
              "rotation_rad": 1, "coordination": 1, "bonds": 1, "velocity_m_per_s": 3,
              "stress_pa": 3},
    "contacts": {},
    "base": {},
}
CELL_ARRAYS = {
    "discs": {},
    "contacts": {"bonded": 1, "normal_force_n": 1, "shear_force_n": 1},
    "base": {"surface": 1},
}
OPTIONAL = {"window_strain", "total_strain", "window_tectonic_strain", "total_tectonic_strain", "porosity"}  # there if the effect is on
PICTURE_WIDTH = 1400  # pixels


def check(holds, *words):
    if not holds:
        sys.exit(" ".join(map(str, words)))


def read_with_paraview(path):
    """Yields time and parts by name of every moment, from ParaView's own reader."""
    reader = vtkPVDReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    information = reader.GetOutputInformation(0)
    for time in information.Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()):
        reader.UpdateTimeStep(time)
        blocks = reader.GetOutputDataObject(0)
        yield time, {blocks.GetMetaData(k).Get(vtkCompositeDataSet.NAME()):
                     blocks.GetBlock(k).GetBlock(0) for k in range(blocks.GetNumberOfBlocks())}


def read_with_vtk(path):
    """The same by the rules of ParaView's reader: moments by timestep, parts by name."""
    moments = {}
    for entry in xml.etree.ElementTree.parse(path).iter("DataSet"):
        moments.setdefault(float(entry.get("timestep")), {})[entry.get("name")] = entry.get("file")
    for time, files in sorted(moments.items()):
        parts = {}
        for name, file in files.items():
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(str(pathlib.Path(path).parent / file))
            reader.Update()
            check(reader.GetErrorCode() == 0, file, "cannot be read")
            parts[name] = reader.GetOutput()
        yield time, parts


def arrays(data, expected, where):
    """The arrays of a part by name, after a check of names, components, length and finiteness."""
    found = {data.GetArrayName(k): data.GetArray(k) for k in range(data.GetNumberOfArrays())}
    check(found.keys() - OPTIONAL == expected.keys(), where, "has", sorted(found), "instead of",
          sorted(expected))
    for name, array in found.items():
        components = expected.get(name, 1)
        check(array.GetNumberOfComponents() == components, where, name, "has components:",
              array.GetNumberOfComponents())
        check(numpy.isfinite(vtk_to_numpy(array)).all(), where, name, "is not finite")
    return found


def look_at(time, parts):
    """What a moment holds."""
    check(list(parts) == list(POINT_ARRAYS), "parts at", time, "Ma:", list(parts))
    check(all(parts.values()), "a part at", time, "Ma cannot be read")
    values = {}
    for name, part in parts.items():
        where = f"{name} at {time} Ma:"
        for data, expected, count in (
                (part.GetPointData(), POINT_ARRAYS[name], part.GetNumberOfPoints()),
                (part.GetCellData(), CELL_ARRAYS[name], part.GetNumberOfCells())):
            for array_name, array in arrays(data, expected, where).items():
                check(array.GetNumberOfTuples() == count, where, array_name, "has rows:",
                      array.GetNumberOfTuples(), "instead of", count)
                values[array_name] = vtk_to_numpy(array)
                if array_name == "stress_pa":
                    components = [array.GetComponentName(k) for k in range(3)]
                    check(components == ["XX", "YY", "XY"], where, "stress of", components)
    discs, contacts, base = parts.values()
    check(discs.GetNumberOfPoints() > 0, "no discs at", time, "Ma")
    values["place_m"] = vtk_to_numpy(discs.GetPoints().GetData())
    check(discs.GetNumberOfVerts() == discs.GetNumberOfPoints(), "discs are not vertices")
    check(contacts.GetNumberOfLines() == contacts.GetNumberOfCells(), "contacts are not lines")
    check(base.GetNumberOfLines() == base.GetNumberOfCells(), "the base is not of lines")
    return {
        "time_ma": time,
        "discs": discs.GetNumberOfPoints(),
        "contacts": contacts.GetNumberOfLines(),
        "bonded": int(values["bonded"].sum()),
        "surfaces": base.GetNumberOfLines(),
        "contact_forces_n": float(numpy.hypot(values["normal_force_n"].astype(float),
                                              values["shear_force_n"]).sum()),
        "right_wall_x_m": base.GetCell(base.GetNumberOfCells() - 1).GetBounds()[0],
        "sums": {name: values[name].sum(axis=0, dtype=float).tolist() for name in values},
        "checksums": {name: zlib.crc32(values[name].tobytes()) for name in values},
        "highest": {name: values[name].max(axis=0).tolist() for name in values},
    }


def colours(discs):
    """Pre-rift discs in bands of 1 km of depth, sediment in a colour per stratum."""
    stratum = vtk_to_numpy(discs.GetPointData().GetArray("stratum"))
    band = (vtk_to_numpy(discs.GetPointData().GetArray("start_depth_m")) // 1000).astype(int)
    rock = numpy.array([[196, 178, 150], [150, 130, 105]], numpy.uint8)
    sediment = numpy.array([[244, 200, 66], [226, 132, 48], [120, 170, 80], [70, 130, 180]],
                           numpy.uint8)
    return numpy.where(stratum[:, None] > 0, sediment[stratum % 4], rock[band % 2])


def disc_actor(discs):
    """ParaView's Point Gaussian as a plain circle of the disc's own radius."""
    rgb = numpy_to_vtk(colours(discs), deep=True)
    rgb.SetName("colour")
    discs.GetPointData().SetScalars(rgb)
    mapper = vtkPointGaussianMapper()
    mapper.SetInputData(discs)
    mapper.SetScaleArray("radius_m")
    mapper.SetScaleFactor(1.0)
    mapper.EmissiveOff()
    mapper.SetSplatShaderCode("//VTK::Color::Impl\n"
                              "if (dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy) > 1.0) discard;\n")
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def line_actor(lines, colour, width):
    mapper = vtkDataSetMapper()
    mapper.SetInputData(lines)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(colour)
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().LightingOff()
    return actor


def draw(parts, picture):
    """Draws discs, then bonds, then walls; says where and how many pixels each has changed."""
    left, right, bottom, top = parts["base"].GetBounds()[:4]
    pixel = 1.02 * (right - left) / PICTURE_WIDTH
    height = round(1.02 * (top - bottom) / pixel) + 20
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(0.5 * height * pixel)
    x, y = 0.5 * (left + right), 0.5 * (bottom + top)
    camera.SetFocalPoint(x, y, 0.0)
    camera.SetPosition(x, y, 1000.0)
    camera.SetClippingRange(1.0, 2000.0)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(PICTURE_WIDTH, height)
    window.AddRenderer(renderer)

    bonds = vtkThreshold()
    bonds.SetInputData(parts["contacts"])
    bonds.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "bonded")
    bonds.SetLowerThreshold(1.0)
    bonds.Update()
    before = None
    changed = {}
    for height_above, (name, actor) in enumerate((
            ("discs", disc_actor(parts["discs"])),
            ("bonds", line_actor(bonds.GetOutput(), (0.25, 0.2, 0.15), 1.0)),
            ("base", line_actor(parts["base"], (0.8, 0.0, 0.0), 2.0)))):
        actor.SetPosition(0.0, 0.0, height_above)
        renderer.AddActor(actor)
        window.Render()
        image = vtkWindowToImageFilter()
        image.SetInput(window)
        image.ReadFrontBufferOff()
        image.Update()
        rgb = vtk_to_numpy(image.GetOutput().GetPointData().GetScalars())
        changed[name] = int((rgb != (255 if before is None else before)).any(axis=1).sum())
        before = rgb
    writer = vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputData(image.GetOutput())
    writer.Write()
    return {"width": PICTURE_WIDTH, "height": height, "metres_per_pixel": pixel,
            "left_m": x - 0.5 * PICTURE_WIDTH * pixel, "bottom_m": y - 0.5 * height * pixel,
            "pixels": changed}


def main(path, picture=None):
    origin = " of ParaView" if vtkPVDReader else ""
    result = {"reader": f"VTK {vtkVersion.GetVTKVersion()}{origin}", "moments": []}
    for time, parts in (read_with_paraview if vtkPVDReader else read_with_vtk)(path):
        result["moments"].append(look_at(time, parts))
    check(result["moments"], path, "holds nothing")
    if picture:
        result["picture"] = draw(parts, picture)
    print(json.dumps(result, indent=1))


main(*sys.argv[1:])
