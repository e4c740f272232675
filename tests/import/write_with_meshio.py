# Writes a motion of two frames with meshio and numpy, in their formats.
import os
import sys

import meshio
import numpy as np

os.chdir(sys.argv[1])
x = np.array([[[0, 0, 0], [1, 0, 0.125], [0, 1, 0], [1, 1, 0.5]], [[0, 0, -1], [1, 0, -0.5], [0, 1, -1], [1, 1, -0.25]]], float)
faces = np.array([[0, 1, 2], [1, 3, 2]])
forms = [("vtk51", "vtk", {}), ("vtk42", "vtk", {}), ("vtk", "vtk", {"binary": False}), ("vtu", "vtu", {"compression": "zlib"}),
         ("vtu", "vtu", {"binary": False}), ("ply", "ply", {"binary": True}), ("ply", "ply", {"binary": False}), ("obj", "obj", {})]
for form, ending, options in forms:
    folder = form + ("-ascii" if options.get("binary") is False else "")
    os.makedirs(folder, exist_ok=True)
    for k in range(2):
        meshio.write(f"{folder}/{k}.{ending}", meshio.Mesh(x[k], [("triangle", faces)]), file_format=form, **options)
    print(folder + "/{frame}." + ending)
np.savez_compressed("single.npz", positions=x.astype("f4"), faces=faces.astype("i8"))
np.savez("big.npz", verts=x.astype(">f8"), triangles=faces.astype("u4"))
print("single.npz\nbig.npz")
