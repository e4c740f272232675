// What cloth and spheres take of the key light. Needs lighting.glsl.

#include "spheres.glsl"

#ifdef SHADOWS
// How much of the key light the spheres leave, without the one at whose surface the point is. The light is not a point,
// so edges get softer with their distance.
float past_spheres(vec3 p, vec4 own) {
  float light = 1.0;
#if SPHERES > 0
  for (int i = 0; i < SPHERES; ++i) {
    if (spheres[i] == own) continue;
    vec3 to_center = spheres[i].xyz - p;
    float radius = spheres[i].w, along = dot(to_center, key_direction);
    float beside = length(to_center - along * key_direction);
    float softness = 0.04 * radius + 0.22 * max(along, 0.0);
    float covered = 1.0 - smoothstep(radius - softness, radius + softness, beside);
    light *= 1.0 - covered * smoothstep(-0.3 * radius, 0.3 * radius, along);
  }
#endif
  return light;
}

#ifndef GROUND
uniform sampler2D shadow_map;  // how far the cloth reaches towards the light [m]
uniform vec4 shadow_u, shadow_v, shadow_depth;  // column, row, whole in the middles of texels, and depth of a point (x, 1)
uniform float shadow_lowest;  // depth below which nothing becomes darker
uniform vec4 shadow_texel;  // its width in texture coordinates, twice, and in metres; what hides all light, inverse [1/m]

// How much of the key light the cloth leaves: by how much each of the four texels around a point is above it, weighted by
// how near they are. Nothing jumps here: were depths only compared, the last bit of a number, in which processors differ,
// could turn a pixel from light to dark. One gather takes llvmpipe half as long as three filtered samples.
float past_cloth(vec3 p) {
  vec2 place = vec2(dot(shadow_u, vec4(p, 1.0)), dot(shadow_v, vec4(p, 1.0)));
  float depth = max(dot(shadow_depth, vec4(p, 1.0)), shadow_lowest);
  vec2 corner = floor(place), part = place - corner;
  vec4 depths = textureGather(shadow_map, (corner + 1.0) * shadow_texel.xy);
  vec4 hidden = clamp((depths - depth) * shadow_texel.w, 0.0, 1.0);
  vec2 across = mix(hidden.wx, hidden.zy, part.x);  // of the lower two and the upper two
  return 1.0 - mix(across.x, across.y, part.y);
}
#endif
#endif
