#!/usr/bin/python3
"""Lines of a section for programs of the trade, by GDAL.

Usage: gis.py LINES FILE

LINES is the GeoJSON that the program writes; FILE ends in .gpkg (OGC GeoPackage, properties as columns) or .dxf
(AutoCAD, a line's name is its layer).  Coordinates are metres, x from the breakaway and height above the original
surface, in an engineering reference system: a section is no map.  FILE is written under a temporary name and then
renamed.  On bad input: one line on stderr, exit status 2.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from script import InputError, library, run

library("osgeo")
from osgeo import gdal, ogr, osr

ENGINEERING = ('ENGCRS["Section: x from the breakaway, height above the original surface",'
               'EDATUM["original surface at the breakaway"],CS[Cartesian,2],'
               'AXIS["x",east],AXIS["height",north],LENGTHUNIT["metre",1]]')
DRIVERS = {".gpkg": "GPKG", ".dxf": "DXF"}


def column_type(values: list) -> int:
    """Of a property's values: text where one is."""
    return ogr.OFTString if any(isinstance(value, (str, list)) for value in values) else ogr.OFTReal


def write_columns(layer, lines: list) -> None:
    """GeoPackage: lines with all their properties; lists as text."""
    definition = lines[0].GetDefnRef() if lines else ogr.FeatureDefn()  # a moment may have none
    names = [definition.GetFieldDefn(k).GetName() for k in range(definition.GetFieldCount())]
    for name in names:
        layer.CreateField(ogr.FieldDefn(name, column_type([line.GetField(name) for line in lines])))
    for line in lines:
        feature = ogr.Feature(layer.GetLayerDefn())
        for name in names:
            value = line.GetField(name)
            if value is not None:
                feature.SetField(name, " ".join(map(str, value)) if isinstance(value, list) else value)
        feature.SetGeometry(line.GetGeometryRef())
        layer.CreateFeature(feature)


def write_layers(layer, lines: list) -> None:
    """DXF: the name of a line is its layer."""
    for line in lines:
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetField("Layer", str(line.GetField(0)))
        feature.SetGeometry(line.GetGeometryRef())
        layer.CreateFeature(feature)


def main(path: str, target: str) -> None:
    gdal.UseExceptions()
    ogr.UseExceptions()
    stem, ending = os.path.splitext(target)
    if ending not in DRIVERS:
        raise InputError(f"{target}: needs {' or '.join(DRIVERS)}")
    source = ogr.Open(path)  # lives as long as its features
    lines = list(source.GetLayer(0))
    section = osr.SpatialReference()
    section.ImportFromWkt(ENGINEERING)
    temporary = f"{stem}.{os.getpid()}.part{ending}"
    try:
        made = ogr.GetDriverByName(DRIVERS[ending]).CreateDataSource(temporary)
        layer = made.CreateLayer(os.path.basename(stem), section, ogr.wkbUnknown)
        (write_columns if ending == ".gpkg" else write_layers)(layer, lines)
        del layer, made  # closes the file
        os.replace(temporary, target)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)


if __name__ == "__main__":
    run(main, "gis.py LINES FILE")
