// What cloth and spheres take of the light. Needs lighting.glsl.

#if SPHERES > 0
uniform vec4 spheres[SPHERES];  // center, radius [m]
#endif

// The part of the surroundings of a point p with normal n that the spheres leave free: 1 for all of it. For a sphere
// above the horizon it is exact (Quilez, "sphere ambient occlusion").
float free_sky(vec3 p, vec3 n) {
  float open = 1.0;
#if SPHERES > 0
  for (int i = 0; i < SPHERES; ++i) {
    vec3 to_center = spheres[i].xyz - p;
    float distance = length(to_center);
    float relative = max(distance / spheres[i].w, 1.0);
    open *= 1.0 - clamp(dot(n, to_center / distance), 0.0, 1.0) / (relative * relative);
  }
#endif
  return open;
}

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
uniform vec4 shadow_u, shadow_v, shadow_depth;  // texture coordinates and depth of a point (x, 1)
uniform float shadow_lowest;  // depth below which nothing becomes darker
uniform vec4 shadow_texel;  // its width in texture coordinates, twice, and in metres; what hides all light, inverse [1/m]

float hidden_by_cloth(vec2 place, float depth) {
  return clamp((texture(shadow_map, place).r - depth) * shadow_texel.w, 0.0, 1.0);
}

// How much of the key light the cloth leaves. Nothing jumps here: were depths compared, the last bit of a number, in which
// processors differ, could turn a pixel from light to dark.
float past_cloth(vec3 p) {
  vec2 place = vec2(dot(shadow_u, vec4(p, 1.0)), dot(shadow_v, vec4(p, 1.0)));
  float depth = max(dot(shadow_depth, vec4(p, 1.0)), shadow_lowest);
  vec2 texel = shadow_texel.xy;
  return 1.0 - (hidden_by_cloth(place + vec2(0.0, 1.1) * texel, depth) +
                hidden_by_cloth(place + vec2(-0.95, -0.55) * texel, depth) +
                hidden_by_cloth(place + vec2(0.95, -0.55) * texel, depth)) / 3.0;
}
#endif
#endif
