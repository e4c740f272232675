#version 330 core
#extension GL_ARB_texture_gather : require
#include "lighting.glsl"
#include "shadow.glsl"

uniform vec3 body_color;
#if GROUNDS > 0
uniform vec4 grounds[GROUNDS];  // unit normal, height [m]
#endif

in vec3 world_position;
in vec3 world_normal;

out vec4 color;  // premultiplied

void main() {
#if GROUNDS > 0
  for (int i = 0; i < GROUNDS; ++i) {
    if (dot(grounds[i].xyz, world_position) < grounds[i].w) discard;
  }
#endif
  vec3 n = normalize(world_normal), to_eye = normalize(eye - world_position);
  if (!gl_FrontFacing) n = -n;

  float towards = dot(n, key_direction);
  vec3 direct = key_light;
#ifdef SHADOWS
  direct *= past_spheres(world_position, vec4(0.0)) * past_cloth(world_position, n);
#endif
  vec3 light = ambient_light(n) + direct * max(towards, 0.0) + fill_light * wrapped_cosine(n, fill_direction, 0.2);
#ifdef OCCLUSION
  light -= ambient_light(n) * (1.0 - free_sky(world_position, n));
#endif
  float glance = power4(half_cosine(n, to_eye, key_direction));
  vec3 gloss = direct * 0.025 * highlight(n, key_direction, 16.0, power4(glance));
  color = vec4(film(body_color * light + gloss), 1.0);
}
