"""Reads a.obj, a.ply and a.vtp of a folder with VTK's own readers and compares them with expected.json."""
import json
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def check(condition, text):
    if not condition:
        sys.exit("read_mesh_back.py: " + text)


def srgb(linear):
    return numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def main(folder):
    with open(folder + "/expected.json") as f:
        want = json.load(f)
    positions = numpy.array(want["positions"], "f4").reshape(-1, 3)
    normals = numpy.array(want["normals"]).reshape(-1, 3)
    uv = numpy.array(want["uv"]).reshape(-1, 2)
    for reader, name in ((vtkOBJReader(), "a.obj"), (vtkPLYReader(), "a.ply"), (vtkXMLPolyDataReader(), "a.vtp")):
        reader.SetFileName(folder + "/" + name)
        reader.Update()
        data = reader.GetOutput()
        check((vtk_to_numpy(data.GetPoints().GetData()) == positions).all(), name + ": positions")
        corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray())
        check(list(corners) == want["triangles"], name + ": triangles")
        points = data.GetPointData()
        check(abs(vtk_to_numpy(points.GetNormals()) - normals).max() < 1e-3, name + ": normals")
        check(abs(vtk_to_numpy(points.GetTCoords()) - uv).max() < 1e-6, name + ": texture coordinates")
        if name == "a.ply":
            colours = numpy.rint(255 * srgb(numpy.array(want["fields"]["diffuse"]))).reshape(-1, 3)
            check((vtk_to_numpy(points.GetScalars())[:, :3] == colours).all(), name + ": colours")
        if name == "a.vtp":
            for field, values in want["fields"].items():
                array = points.GetArray(field) or data.GetCellData().GetArray(field)
                got = vtk_to_numpy(array).astype("f8").ravel()
                check(numpy.allclose(got, values, rtol=2.0 ** -11, atol=0), name + ": " + field)
            check(data.GetFieldData().GetAbstractArray("length_unit").GetValue(0) == "mm", name + ": length_unit")


main(sys.argv[1])
