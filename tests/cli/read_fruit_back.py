"""Reads a run of a fruit with VTK's own readers: the three kinds of mesh files agree, arrays and ranges are those of run.json."""
import json
import sys
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

COMPONENTS = {"organ_id": 1, "kernel_id": 1, "sharpness": 1, "diffuse": 3, "water": 1, "moisture_wb": 1, "normal": 3,
              "uv": 2}


def check(condition, text):
    if not condition:
        sys.exit("read_fruit_back.py: " + text)


def read(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def numbers(array):
    return vtk_to_numpy(array).astype("f8")


def main(folder):
    folder = Path(folder)
    run = json.loads((folder / "run.json").read_text())
    found = {}
    for frame in run["frames"]:
        name = frame["files"]["fruit"]
        vtp = read(vtkXMLPolyDataReader(), folder / name)
        check(vtp.GetNumberOfPoints() == frame["numbers"]["vertices"], name + ": number of points")
        check(vtp.GetNumberOfPolys() == frame["numbers"]["triangles"], name + ": number of triangles")
        field = vtp.GetFieldData()
        check(field.GetAbstractArray("length_unit").GetValue(0) == "mm", name + ": length_unit")
        check(abs(field.GetArray("TimeValue").GetValue(0) - frame["time_days"]) < 1e-9, name + ": TimeValue")
        check(abs(field.GetArray("wd").GetValue(0) - frame["wd"]) < 1e-9, name + ": wd")
        points, data = numbers(vtp.GetPoints().GetData()), vtp.GetPointData()
        corners = vtk_to_numpy(vtp.GetPolys().GetConnectivityArray())
        for array, components in COMPONENTS.items():
            values = data.GetArray(array)
            check(values is not None, f"{name}: no array {array}")
            check(values.GetNumberOfComponents() == components, f"{name}: components of {array}")
            got = numbers(values)
            lo, hi = got.min(), got.max()
            check(numpy.allclose((lo, hi), frame["ranges"][array], rtol=1e-3, atol=1e-6), f"{name}: range of {array}")
            had = found.setdefault(array, [lo, hi])
            found[array] = [min(had[0], lo), max(had[1], hi)]
        kernels = numpy.unique(numbers(data.GetArray("kernel_id")))
        check(list(kernels) == list(range(-1, run["kernels"])), name + ": kernel_id")
        for other, reader in (("obj", vtkOBJReader()), ("ply", vtkPLYReader())):
            mesh = read(reader, folder / frame["files"][other])
            check((numbers(mesh.GetPoints().GetData()) == points).all(), f"{name}: positions of the .{other}")
            check((vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()) == corners).all(), f"{name}: faces of the .{other}")
    for array, (lo, hi) in found.items():
        check(numpy.allclose((lo, hi), run["value_ranges"][array], rtol=1e-3, atol=1e-6), "range of the run: " + array)


main(sys.argv[1])
