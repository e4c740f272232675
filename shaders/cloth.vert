#version 330 core
#ifdef OCCLUSION
#include "spheres.glsl"
#endif

uniform mat4 view_projection;
uniform vec3 eye;            // position of the camera [m]
uniform vec3 key_direction;  // unit vector towards the key light

layout(location = 0) in vec3 position;  // [m]
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec3 barycentric;
layout(location = 4) in vec3 line_scale;
#ifdef VERTEX_COLORS
layout(location = 5) in vec3 own_color;  // linear light
#endif
#ifdef OCCLUSION
layout(location = 6) in vec2 open_sides;  // fraction of ambient light that the cloth leaves to the front and to the back
#endif

out vec3 world_position;
out vec3 world_normal;
// Towards the camera, and halfway from there to the key light. Both change so little within a triangle that they are
// unit vectors at its vertices and almost so between.
out vec3 to_eye;
out vec3 halfway;
#if defined(TEXTURE) || defined(WEAVE)
out vec2 texture_position;
#endif
#ifdef VERTEX_COLORS
out vec3 vertex_color;
#endif
#ifdef OCCLUSION
out vec2 openness;
#endif
#ifdef MESH_LINES
out vec3 corner_weights;
flat out vec3 edge_line_scale;
#endif

void main() {
  world_position = position;
  world_normal = normal;
  to_eye = normalize(eye - position);
  halfway = normalize(to_eye + key_direction);
#if defined(TEXTURE) || defined(WEAVE)
  texture_position = uv;
#endif
#ifdef VERTEX_COLORS
  vertex_color = own_color;
#endif
#ifdef OCCLUSION
  openness = open_sides * vec2(free_sky(position, normal), free_sky(position, -normal));
#endif
#ifdef MESH_LINES
  corner_weights = barycentric;
  edge_line_scale = line_scale;
#endif
  gl_Position = view_projection * vec4(position, 1.0);
}
