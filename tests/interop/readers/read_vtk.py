"""read_vtk.py FILE.pvd: prints the motion of a collection as VTK reads its files. For how, see interop_test.cpp."""
import os
import sys
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def read(name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(os.path.dirname(sys.argv[1]), name))
    reader.Update()
    assert reader.GetErrorCode() == 0, name
    return reader.GetOutput()


parts = {0: [], 1: []}
for entry in ElementTree.parse(sys.argv[1]).getroot().iter("DataSet"):
    parts[int(entry.get("part"))].append((float(entry.get("timestep")), read(entry.get("file"))))

for k, (time, cloth) in enumerate(parts[0]):
    if k == 0:
        for i in range(cloth.GetNumberOfCells()):
            cell = cloth.GetCell(i)
            print("f", *(cell.GetPointId(corner) for corner in range(cell.GetNumberOfPoints())))
    print("t", repr(time))
    assert cloth.GetFieldData().GetArray("TimeValue").GetValue(0) == time
    for i in range(cloth.GetNumberOfPoints()):
        print("v", *map(repr, cloth.GetPoint(i)))
    data = cloth.GetPointData()
    assert data.GetVectors().GetName() == "velocity" and data.GetScalars().GetName() == "stretch"
    assert data.GetTCoords().GetNumberOfTuples() == cloth.GetNumberOfPoints()
    if k == 0:  # the cloth starts at rest
        assert abs(data.GetScalars().GetRange()[0] - 1) < 1e-12 and abs(data.GetScalars().GetRange()[1] - 1) < 1e-12
    # The ball is the surface without its last four points, which are the ground's.
    surface = parts[1][k][1]
    points = [surface.GetPoint(i) for i in range(surface.GetNumberOfPoints() - 4)]
    low, high = [min(axis) for axis in zip(*points)], [max(axis) for axis in zip(*points)]
    print("s", *((a + b) / 2 for a, b in zip(low, high)), (high[2] - low[2]) / 2)
