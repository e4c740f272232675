#version 330 core
#extension GL_ARB_texture_gather : require
#include "lighting.glsl"
#include "shadow.glsl"

#ifdef TEXTURE
uniform sampler2D cloth_texture;
in vec2 texture_position;
#elif defined(VERTEX_COLORS)
in vec3 vertex_color;
#else
uniform vec3 cloth_color;
#endif
#ifdef TRANSLUCENCY
uniform float translucency;  // part of the key light that shines through
#endif
#ifdef OCCLUSION
in vec2 openness;  // of the front and the back: what cloth and spheres leave of the light from all around
#endif
#ifdef MESH_LINES
uniform vec3 line_color;
uniform float line_width;  // [pixels]
in vec3 corner_weights;
flat in vec3 edge_line_scale;
#endif

in vec3 world_position;
in vec3 world_normal;

out vec4 color;  // premultiplied

#ifdef MESH_LINES
// How much of the pixel the lines along the triangle's edges cover. Where the triangle is so small that lines would fill
// it, they fade.
float line_coverage() {
  vec3 across = dFdx(corner_weights), along = dFdy(corner_weights);
  vec3 slope = sqrt(across * across + along * along);  // [1/pixel]
  vec3 distance_to_edge = corner_weights / slope;
  vec3 height = 1.0 / slope;  // of the triangle above each edge
  vec3 half_width = 0.5 * line_width * edge_line_scale;
  vec3 coverage = clamp(half_width + 0.5 - distance_to_edge, 0.0, 1.0);
  coverage *= smoothstep(vec3(1.5 * line_width), vec3(8.0 * line_width), height);
  return max(max(coverage.x, coverage.y), coverage.z);
}
#endif

void main() {
  // Cloth has two sides; the normal is that of the side which is seen.
  vec3 n = normalize(world_normal) * (gl_FrontFacing ? 1.0 : -1.0);
  vec3 to_eye = normalize(eye - world_position);

#ifdef TEXTURE
  vec3 albedo = texture(cloth_texture, texture_position).rgb;
#elif defined(VERTEX_COLORS)
  vec3 albedo = vertex_color;
#else
  vec3 albedo = cloth_color;
#endif
  if (!gl_FrontFacing) albedo *= 0.95;
#ifdef MESH_LINES
  albedo = mix(albedo, line_color, line_coverage());
#endif
#ifndef VERTEX_COLORS
  albedo = max(albedo, 0.02);  // no cloth is as black as a hole
#endif

  float towards = dot(n, key_direction);
#ifdef DARK
  const float lit = 0.0;
#else
  float lit = 1.0;
#endif
#ifdef SHADOWS
  lit = past_spheres(world_position, vec4(0.0));
#ifndef PAST_SPHERES
  lit *= past_cloth(world_position, n);
#endif
#endif
#ifdef OCCLUSION
  float open = gl_FrontFacing ? openness.x : openness.y;
  // What hides the surroundings is cloth of about this colour, and gives back what it gets.
  vec3 around = open / (1.0 - 0.7 * albedo * (1.0 - open));
#else
  const vec3 around = vec3(1.0);
#endif

  // It has to vanish where the light only grazes the cloth, as whether that is in the shadow is a matter of rounding.
  float key = max(0.0, towards);
#ifdef TRANSLUCENCY
  key += translucency * max(0.0, -towards);
#endif
  float fill = wrapped_cosine(n, fill_direction, 0.4);
  vec3 surroundings = (ambient_light(n) + fill_light * fill) * around;
  vec3 direct = key_light * lit;

  // Fibres that stand up from the cloth catch light where it is seen edge-on, and give it most of their colour.
  float aside = 1.0 - clamp(dot(n, to_eye), 0.0, 1.0);
  vec3 tint = mix(vec3(1.0), albedo / max(albedo.r, max(albedo.g, albedo.b)), 0.8);
  vec3 sheen = 0.16 * tint * aside * aside * aside * (surroundings + direct * max(0.0, towards));
  float glance = power4(half_cosine(n, to_eye, key_direction));
  vec3 specular = direct * 0.03 * highlight(n, key_direction, 12.0, glance * glance * glance);

#ifdef VERTEX_COLORS
  // Colours that say something keep their value; only how squarely the surface is seen shows its folds, faintly.
  color = vec4(albedo * (1.0 - 0.35 * aside * aside), 1.0);
#else
  color = vec4(film(albedo * (surroundings + direct * key) + sheen + specular), 1.0);
#endif
}
