"""blender --python read_blender.py -- FILE.pc2 FRAMES MESH…: prints the motion as Blender shows it, where FILE.obj has FILE.pc2
as its Mesh Cache, and then each mesh, .ply or .obj, as a moment of its own. For how, see interop_test.cpp."""
import sys

import bpy


def import_obj(file):
    bpy.ops.wm.obj_import(filepath=file, forward_axis="Y", up_axis="Z")
    objects = bpy.context.selected_objects  # includes colliders
    return next((one for one in objects if one.name.startswith("cloth")), objects[0])


cache, frames, *meshes = sys.argv[sys.argv.index("--") + 1:]
cloth = import_obj(cache.replace(".pc2", ".obj"))
modifier = cloth.modifiers.new("motion", "MESH_CACHE")
modifier.cache_format = "PC2"
modifier.filepath = cache
modifier.frame_start = 0


def show(mesh, matrix):
    for vertex in mesh.vertices:
        print("v", *map(repr, matrix @ vertex.co))


for polygon in cloth.data.polygons:
    print("f", *polygon.vertices)
for frame in range(int(frames)):
    bpy.context.scene.frame_set(frame)
    seen = cloth.evaluated_get(bpy.context.evaluated_depsgraph_get())
    print("t", frame)
    show(seen.data, seen.matrix_world)
for frame, mesh in enumerate(meshes):
    if mesh.endswith(".obj"):
        seen = import_obj(mesh)
    else:
        bpy.ops.import_mesh.ply(filepath=mesh)
        seen = bpy.context.object
    print("t", frame)
    show(seen.data, seen.matrix_world)
