#version 330 core
#define GROUND
#include "lighting.glsl"
#include "shadow.glsl"

uniform mat4 view_projection;
uniform vec4 ground;      // unit normal, height [m]
uniform vec4 focus;       // point where the camera looks, and radius around it to which the ground is visible [m]
uniform float sunk;       // depth below its surface from which the ground hides objects [m]
uniform vec3 ground_color;
uniform float grid_spacing;  // [m]; 0: no lines
#ifdef SHADOWS
uniform sampler2D cloth_shadow;
uniform vec4 shadow_u, shadow_v;  // texture coordinates of a point (x, 1)
#endif

in vec4 far_point;

out vec4 color;  // premultiplied

// Fraction of the pixel that the grid lines cover; lines fade where they would merge.
float grid(vec2 place) {
  vec2 cells = place / grid_spacing;
  vec2 pixel = max(fwidth(cells), 1e-6);
  vec2 distance_to_line = abs(fract(cells - 0.5) - 0.5) / pixel;
  vec2 line = clamp(1.1 - distance_to_line, 0.0, 1.0) * (1.0 - smoothstep(0.04, 0.22, pixel));
  return max(line.x, line.y);
}

void main() {
  vec3 n = ground.xyz;
  vec3 ray = normalize(far_point.xyz / far_point.w - eye);
  float descent = -dot(n, ray);
  float above = dot(n, eye) - ground.w;
  // Derivatives need a value in every pixel, so rays that miss the ground get a far point and are discarded below.
  vec3 p = eye + ray * (above / max(descent, 1e-5));

  vec3 side = normalize(abs(n.x) < 0.9 ? cross(n, vec3(1, 0, 0)) : cross(n, vec3(0, 1, 0)));
  float line = grid_spacing > 0.0 ? grid(vec2(dot(p, cross(side, n)), dot(p, side))) : 0.0;
  float key = wrapped_cosine(n, key_direction, 0.15), open = 1.0;
#ifdef SHADOWS
  float taken = texture(cloth_shadow, vec2(dot(shadow_u, vec4(p, 1.0)), dot(shadow_v, vec4(p, 1.0)))).r;
  key *= past_spheres(p, vec4(0.0)) * (1.0 - 0.9 * taken);
  open -= 0.4 * taken;
#endif
#ifdef OCCLUSION
  open *= free_sky(p, n);
#endif
  float coverage = (1.0 - smoothstep(0.25, 1.0, length(p - focus.xyz) / focus.w)) * smoothstep(0.0, 0.22, descent);
  if (descent <= 1e-5 || coverage <= 0.0) discard;

  vec3 light = ambient_light(n) * open + key_light * key + fill_light * wrapped_cosine(n, fill_direction, 0.4);
  vec3 albedo = ground_color * (1.0 - 0.22 * line);
  color = vec4(film(albedo * light), 1.0) * coverage;

  vec4 behind = view_projection * vec4(eye + ray * ((above + sunk) / descent), 1.0);
  gl_FragDepth = behind.w > 0.0 ? clamp(0.5 + 0.5 * behind.z / behind.w, 0.0, 0.9999999) : 0.0;
}
