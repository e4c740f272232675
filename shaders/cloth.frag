#version 330 core
#extension GL_ARB_texture_gather : require
#include "lighting.glsl"
#include "shadow.glsl"

#if defined(TEXTURE) || defined(WEAVE)
in vec2 texture_position;
#endif
#ifdef WEAVE
uniform vec3 weave;  // yarns in a unit of u and of v; depth of their relief
#endif
#ifdef TEXTURE
uniform sampler2D cloth_texture;
#if SAMPLES > 1
uniform float anisotropy;  // ratio, length by width, up to which a footprint is resolved across
#endif
#elif defined(VERTEX_COLORS)
in vec3 vertex_color;
#else
uniform vec3 cloth_color;
#endif
#ifdef TRANSLUCENCY
uniform float translucency;  // fraction of the key light that shines through
#endif
#ifdef OCCLUSION
in vec2 openness;  // fraction of ambient light that cloth and spheres leave to the front and to the back
#endif
#ifdef MESH_LINES
uniform vec3 line_color;
uniform float line_width;  // [pixels]
in vec3 corner_weights;
flat in vec3 edge_line_scale;
#endif

in vec3 world_position;
in vec3 world_normal;
in vec3 to_eye;
in vec3 halfway;

out vec4 color;  // premultiplied

#ifdef MESH_LINES
// Fraction of the pixel that the lines along the triangle's edges cover. They fade where the triangle is so small that
// lines would fill it.
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

#ifdef WEAVE
// Brightness of a plain weave, 1 on average. A yarn is brightest along its middle, where it lies on top. The relief fades
// before a yarn is too narrow for its pixels, as in a mipmap, so that it never makes moiré. Parabolas stand for sines,
// which take software several times as long.
float woven() {
  vec2 yarn = weave.xy * texture_position, change = fwidth(yarn);
  float seen = clamp((1.0 / 3.0 - max(change.x, change.y)) * 6.0, 0.0, 1.0);  // change: [yarns/pixel]
  vec2 place = 2.0 * fract(0.5 * yarn) - 1.0;
  vec2 wave = 4.0 * place * (1.0 - abs(place));  // up and down over two yarns
  vec2 across = wave * wave;
  float along_u = across.y * (0.6 + 0.4 * across.x), along_v = across.x * (0.6 + 0.4 * across.y);
  float light = mix(along_u, along_v, clamp(0.5 + 2.5 * wave.x * wave.y, 0.0, 1.0));
  const float mean = 8.0 / 15.0 * (0.6 + 0.4 * 8.0 / 15.0);
  return 1.0 + weave.z * seen * (light - mean);
}
#endif

#if defined(TEXTURE) && SAMPLES > 1
// Returns the mean of samples along the longer axis of the pixel's footprint in the texture. A footprint up to
// `tolerated` times as long as wide gives the value of a single sample, so that no seam shows where the triangles drawn
// with one begin. The mipmap's level is chosen as Mesa does: by the largest change of a coordinate.
vec3 along_footprint() {
  const float tolerated = 1.5;  // as in draw_cloth.hpp
  vec2 size = vec2(textureSize(cloth_texture, 0));
  vec2 right = dFdx(texture_position) * size, above = dFdy(texture_position) * size;  // [texels/pixel]
  float a = dot(right, right), b = dot(right, above), c = dot(above, above);
  float middle = 0.5 * (a + c), apart = sqrt(0.25 * (a - c) * (a - c) + b * b);
  float longest = sqrt(middle + apart), shortest = sqrt(max(middle - apart, 0.0));
  vec2 direction = a > c ? vec2(0.5 * (a - c) + apart, b) : vec2(b, 0.5 * (c - a) + apart);  // in the picture
  vec2 axis = (right * direction.x + above * direction.y) * inversesqrt(max(dot(direction, direction), 1e-30)) / size;
  vec2 change = max(abs(right), abs(above));
  float width = max(tolerated * max(shortest, longest / anisotropy), 1.0);
  float level = log2(min(width, max(change.x, change.y)));
  vec2 apart_by = axis * max(1.0 - width / longest, 0.0) / float(SAMPLES - 1);
  vec3 sum = vec3(0.0);
  for (int k = 0; k < SAMPLES; ++k) {
    sum += textureLod(cloth_texture, texture_position + (float(k) - 0.5 * float(SAMPLES - 1)) * apart_by, level).rgb;
  }
  return sum / float(SAMPLES);
}
#endif

void main() {
  // Cloth has two sides; use the normal of the visible one.
  vec3 n = normalize(world_normal) * (gl_FrontFacing ? 1.0 : -1.0);

#ifdef TEXTURE
#if SAMPLES > 1
  vec3 albedo = along_footprint();
#else
  vec3 albedo = texture(cloth_texture, texture_position).rgb;
#endif
#elif defined(VERTEX_COLORS)
  vec3 albedo = vertex_color;
#else
  vec3 albedo = cloth_color;
#endif
#ifdef WEAVE
  albedo *= woven();
#endif
  if (!gl_FrontFacing) albedo *= 0.95;
#ifdef MESH_LINES
  albedo = mix(albedo, line_color, line_coverage());
#endif
#ifndef VERTEX_COLORS
  albedo = max(albedo, 0.02);  // even black cloth reflects some light
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
  // The occluding cloth has about the same colour, and reflects the light that it receives.
  vec3 around = open / (1.0 - 0.7 * albedo * (1.0 - open));
#else
  const vec3 around = vec3(1.0);
#endif

  // The light must fall to zero at grazing incidence, because rounding decides there if the cloth is in shadow.
  float key = max(0.0, towards);
#ifdef TRANSLUCENCY
  key += translucency * max(0.0, -towards);
#endif
  float fill = wrapped_cosine(n, fill_direction, 0.4);
  vec3 surroundings = (ambient_light(n) + fill_light * fill) * around;
  vec3 direct = key_light * lit;

  // Sheen: fibres that stand up catch light where the cloth is seen edge-on, tinted with most of its colour.
  float aside = 1.0 - clamp(dot(n, to_eye), 0.0, 1.0);
  vec3 tint = mix(vec3(1.0), albedo / max(albedo.r, max(albedo.g, albedo.b)), 0.8);
  vec3 sheen = 0.16 * tint * aside * aside * aside * (surroundings + direct * max(0.0, towards));
  float glance = power4(max(dot(n, halfway), 0.0));
  vec3 specular = direct * 0.03 * highlight(n, key_direction, 12.0, glance * glance * glance);

#ifdef VERTEX_COLORS
  // Data colours keep their value; only a slight darkening at edge-on view shows the folds.
  color = vec4(albedo * (1.0 - 0.35 * aside * aside), 1.0);
#else
  color = vec4(film(albedo * (surroundings + direct * key) + sheen + specular), 1.0);
#endif
}
