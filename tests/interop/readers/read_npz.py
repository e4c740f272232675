"""read_npz.py FILE: prints the motion of an archive as numpy reads it. For how, see interop_test.cpp."""
import sys

import numpy

motion = numpy.load(sys.argv[1])  # without pickle: plain arrays only
frames, vertices = motion["positions"].shape[:2]
assert motion["velocities"].shape == (frames, vertices, 3)
assert motion["energies"].shape == motion["frames"].shape == (frames,)
assert motion["uvs"].shape == (len(motion["faces"]), 3, 2)
assert motion["rest"].shape == (vertices, 3)
assert motion["fps"] == 20
energies = motion["energies"]
total = energies["kinetic"] + energies["gravity"] + energies["elastic"]
assert numpy.allclose(energies["total"], total, rtol=1e-14, atol=0)
for face in motion["faces"]:
    print("f", *face)
for k in range(frames):
    print("t", repr(float(motion["times"][k])))
    for x in motion["positions"][k]:
        print("v", *map(repr, map(float, x)))
    for sphere in motion["spheres"][k]:
        print("s", *map(repr, map(float, sphere)))
