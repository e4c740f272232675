#version 330 core
#include "lighting.glsl"

#ifdef TEXTURE
uniform sampler2D cloth_texture;
in vec2 texture_position;
#elif defined(VERTEX_COLORS)
in vec3 vertex_color;
#else
uniform vec3 cloth_color;
#endif
#if SPHERES > 0
uniform vec4 spheres[SPHERES];  // center, radius [m]
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

// The part of the surroundings of a point with normal n that the spheres leave free: 1 for all of it. For a sphere above
// the horizon it is exact (Quilez, "sphere ambient occlusion").
float free_sky(vec3 n) {
  float open = 1.0;
#if SPHERES > 0
  for (int i = 0; i < SPHERES; ++i) {
    vec3 to_center = spheres[i].xyz - world_position;
    float distance = length(to_center);
    float relative = max(distance / spheres[i].w, 1.0);
    open *= 1.0 - clamp(dot(n, to_center / distance), 0.0, 1.0) / (relative * relative);
  }
#endif
  return open;
}

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

  float open = free_sky(n);
  float key = wrapped_cosine(n, key_direction, 0.25);
  float key_through = 0.12 * max(0.0, -dot(n, key_direction));  // what shines through from the other side
  float fill = wrapped_cosine(n, fill_direction, 0.4);
  vec3 light = ambient_light(n) * open + key_light * (key + key_through) + fill_light * fill;

  // Fibres that stand up from the cloth catch light where it is seen edge-on.
  float aside = 1.0 - clamp(dot(n, to_eye), 0.0, 1.0);
  float sheen = 0.10 * aside * aside * aside;
  float glance = power4(half_cosine(n, to_eye, key_direction));
  vec3 specular = key_light * 0.03 * highlight(n, key_direction, 12.0, glance * glance * glance);

  color = vec4(min(albedo * light * (1.0 + sheen) + specular, 1.0), 1.0);
}
