"""Reads files of a folder with VTK's Python module and compares them with expected.json, written from the grid itself."""
import json
import math
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader


def check(condition, text):
    if not condition:
        sys.exit("read_back.py: " + text)


def close(a, b, tolerance):
    return math.isclose(a, b, rel_tol=tolerance, abs_tol=tolerance)


def main(folder):
    with open(folder + "/expected.json") as f:
        expected = json.load(f)
    for name, want in expected.items():
        reader = vtkXMLImageDataReader() if name.endswith(".vti") else vtkXMLPolyDataReader()
        reader.SetFileName(folder + "/" + name)
        reader.Update()
        check(reader.GetErrorCode() == 0, name + ": error code %d" % reader.GetErrorCode())
        data = reader.GetOutput()
        check(data.GetNumberOfPoints() == want["points"], name + ": number of points")
        fields = data.GetFieldData()
        check(fields.GetArray("TimeValue").GetValue(0) == want["days"], name + ": TimeValue")
        check(fields.GetArray("wd").GetValue(0) == want["wd"], name + ": wd")
        check(fields.GetAbstractArray("length_unit").GetValue(0) == "mm", name + ": length_unit")
        if "extent" in want:
            check(list(data.GetExtent()) == want["extent"], name + ": extent")
            for got, value in zip(data.GetOrigin() + data.GetSpacing(), want["origin"] + want["spacing"]):
                check(close(got, value, 1e-9), name + ": origin or spacing")
        names = [data.GetPointData().GetArrayName(i) for i in range(data.GetPointData().GetNumberOfArrays())]
        check(sorted(names) == sorted(want["arrays"]), name + ": arrays are " + str(names))
        density = vtk_to_numpy(data.GetPointData().GetArray("density"))
        for array_name, w in want["arrays"].items():
            array = data.GetPointData().GetArray(array_name)
            check(array.GetNumberOfComponents() == w["components"], array_name + ": components")
            filled = vtk_to_numpy(array)[density > 0].astype("f8")
            check(len(filled) == want["filled"], array_name + ": filled voxels")
            check(close(filled.sum(), w["sum"], 1e-3 * max(1.0, w["magnitude"])), "%s: sum %r, not %r" % (array_name, filled.sum(), w["sum"]))
            check(close(abs(filled).sum(), w["magnitude"], 1e-3 * max(1.0, w["magnitude"])), array_name + ": magnitude")


main(sys.argv[1])
