# blender --background --python blender_cloth.py -- FOLDER: a cloth of Blender falls over a ball; writes OBJ files at 50 frames
# per second.
import os
import sys

import bpy

folder = sys.argv[sys.argv.index("--") + 1]
os.makedirs(folder, exist_ok=True)
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = 50
scene.frame_start, scene.frame_end = 1, 60
scene.gravity = (0, 0, -9.81)

bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.3, location=(0, 0, 0.5))
ball = bpy.context.object
bpy.ops.mesh.primitive_plane_add(size=6)
ground = bpy.context.object
for thing in (ball, ground):
    thing.modifiers.new("collision", "COLLISION")
    thing.collision.thickness_outer = 0.01

bpy.ops.mesh.primitive_grid_add(x_subdivisions=20, y_subdivisions=20, size=1.6, location=(0, 0, 1.2))
cloth = bpy.context.object
settings = cloth.modifiers.new("cloth", "CLOTH").settings
settings.quality = 10
settings.air_damping = 0
# Gravity per step is a thousandth of the scene's per frame², which is right at √1000 frames per second.
settings.time_scale = 1000**0.5 / scene.render.fps
collision = cloth.modifiers["cloth"].collision_settings
collision.distance_min = 0.01
collision.use_self_collision = True
collision.self_distance_min = 0.01
cloth.modifiers["cloth"].point_cache.frame_end = 60


def write(mesh, place, name):
    with open(name, "w") as file:
        for vertex in mesh.vertices:
            file.write("v {:.9g} {:.9g} {:.9g}\n".format(*(place @ vertex.co)))
        for face in mesh.polygons:
            file.write("f {}\n".format(" ".join(str(v + 1) for v in face.vertices)))


for frame in range(60):
    scene.frame_set(frame + 1)
    now = cloth.evaluated_get(bpy.context.evaluated_depsgraph_get())
    write(now.to_mesh(), cloth.matrix_world, os.path.join(folder, "{:04d}.obj".format(frame)))
write(ball.data, ball.matrix_world, os.path.join(folder, "ball.obj"))
