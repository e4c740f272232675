#version 330 core
#extension GL_ARB_texture_gather : require
#include "lighting.glsl"
#include "shadow.glsl"

uniform vec3 sphere_color;
uniform vec4 sphere;  // center, radius [m]
#if GROUNDS > 0
uniform vec4 grounds[GROUNDS];  // unit normal, height [m]
#endif

in vec3 world_position;

out vec4 color;  // premultiplied

// Returns the light that a mirror reflects: the floor, and above it the bright walls and ceiling of the studio.
vec3 surroundings(vec3 direction) { return mix(vec3(0.35), vec3(0.95), smoothstep(-0.5, 0.4, dot(direction, up))); }

void main() {
  // Intersects the pixel's ray with the exact sphere, which the triangles only approximate.
  vec3 to_eye = normalize(eye - world_position);
  vec3 from_center = eye - sphere.xyz;
  vec3 beside = from_center - dot(from_center, to_eye) * to_eye;  // from the centre to the ray
  float towards = sqrt(max(sphere.w * sphere.w - dot(beside, beside), 0.0));
  vec3 n = (beside + towards * to_eye) / sphere.w;
#if GROUNDS > 0
  for (int i = 0; i < GROUNDS; ++i) {
    if (dot(grounds[i].xyz, sphere.xyz + sphere.w * n) < grounds[i].w) discard;
  }
#endif

  vec3 direct = key_light;
  float open = 1.0;
#ifdef SHADOWS
  vec3 p = sphere.xyz + sphere.w * n;
  open = past_cloth(p, key_direction);  // the map has no spheres, so this one cannot shade itself
  direct *= open;
#if SPHERES > 1
  direct *= past_spheres(p, sphere);
#endif
#endif
  // The occluder is near and reflects some of its light: less into the mirror image, more into ambient light.
  vec3 light = ambient_light(n) * (1.5 - 0.5 * open) + direct * wrapped_cosine(n, key_direction, 0.1) +
               fill_light * wrapped_cosine(n, fill_direction, 0.2);
  float mirror = fresnel(dot(n, to_eye));
  float glance = power4(half_cosine(n, to_eye, key_direction));
  float wide = glance * glance * glance;  // power 12; powers 24 and 256 follow
  vec3 gloss = surroundings(reflect(-to_eye, n)) * (0.3 + 0.7 * open) * mirror +
               direct * (0.060 * highlight(n, key_direction, 256.0, power4(power4(power4(glance)))) +
                         0.035 * highlight(n, key_direction, 24.0, wide * wide));

  color = vec4(film(sphere_color * light * (1.0 - mirror) + gloss), 1.0);
}
