// Shadows of cloth and spheres in the key light. Needs lighting.glsl.

#include "spheres.glsl"

#ifdef SHADOWS
// Returns the fraction of the key light that the spheres leave, without the sphere `own` of the point itself. The light
// has an extent, so edges soften with distance.
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
uniform sampler2D shadow_map;  // depth of the cloth towards the light [m]
uniform vec4 shadow_u, shadow_v, shadow_depth;  // column, row (whole in the middles of texels) and depth of a point (x, 1)
uniform float shadow_lift;    // offset of a point above its surface, in perpendicular light [m]
uniform float shadow_lowest;  // depth below which shadows stay equally dark
uniform vec4 shadow_texel;  // width in texture coordinates (x, y) and metres; inverse of the height that hides all light [1/m]

// Returns the fraction of the key light that the cloth leaves to a point of a surface with normal n. The surface is
// approximated by a plane and compared with 36 texels around the point; heights above the plane hide light, weighted by
// a tent filter with a radius of three texels. The result is continuous: hard comparisons of depths would let the last
// bit, which differs between processors, flip a pixel. In slanting light the required height grows. One gather takes
// llvmpipe half as long as three filtered samples.
float past_cloth(vec3 p, vec3 n) {
  vec2 place = vec2(dot(shadow_u, vec4(p, 1.0)), dot(shadow_v, vec4(p, 1.0)));
  float depth = dot(shadow_depth, vec4(p, 1.0));
  vec2 corner = floor(place), part = place - corner;
  float facing = dot(n, key_direction), texel = shadow_texel.z;
  vec2 along = vec2(dot(n, shadow_u.xyz), dot(n, shadow_v.xyz)) * (texel * texel);
  float inverse = facing / max(facing * facing, 0.0004);
  vec2 slope = -along * inverse;  // of the plane, in depth by texels
  float steep = 1.0 + min(length(along) * abs(inverse) / texel, 4.0);
  float scale = shadow_texel.w / steep;
  depth += shadow_lift * steep;

  float hidden = 0.0;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      vec2 first = vec2(2 * column - 2, 2 * row - 2);  // of the four texels, relative to the point's corner
      vec2 lower = first - part, upper = lower + 1.0;
      vec4 depths = textureGather(shadow_map, (corner + first + 1.0) * shadow_texel.xy);
      vec4 plane = vec4(lower.x, upper.x, upper.x, lower.x) * slope.x + vec4(upper.y, upper.y, lower.y, lower.y) * slope.y;
      vec4 covered = clamp((depths - max(plane + depth, shadow_lowest)) * scale, 0.0, 1.0);
      vec2 low_weight = 3.0 - abs(lower), high_weight = 3.0 - abs(upper);
      hidden += dot(covered, vec4(low_weight.x, high_weight.x, high_weight.x, low_weight.x) *
                                 vec4(high_weight.y, high_weight.y, low_weight.y, low_weight.y));
    }
  }
  return 1.0 - hidden / 81.0 * smoothstep(0.01, 0.04, abs(facing));
}
#endif
#endif
