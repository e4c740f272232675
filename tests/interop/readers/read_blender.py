"""blender --python read_blender.py -- FILE.pc2 FRAME.ply…: prints the motion as Blender shows it, where FILE.obj has FILE.pc2
as its Mesh Cache, and then each mesh as a moment of its own. For how, see interop_test.cpp."""
import sys

import bpy

cache, *meshes = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.obj_import(filepath=cache.replace(".pc2", ".obj"), forward_axis="Y", up_axis="Z")
cloth = bpy.context.selected_objects[0]
modifier = cloth.modifiers.new("motion", "MESH_CACHE")
modifier.cache_format = "PC2"
modifier.filepath = cache
modifier.frame_start = 0


def show(mesh, matrix):
    for vertex in mesh.vertices:
        print("v", *map(repr, matrix @ vertex.co))


for polygon in cloth.data.polygons:
    print("f", *polygon.vertices)
for frame in range(len(meshes)):
    bpy.context.scene.frame_set(frame)
    seen = cloth.evaluated_get(bpy.context.evaluated_depsgraph_get())
    print("t", frame)
    show(seen.data, seen.matrix_world)
for frame, mesh in enumerate(meshes):
    bpy.ops.import_mesh.ply(filepath=mesh)
    print("t", frame)
    show(bpy.context.object.data, bpy.context.object.matrix_world)
