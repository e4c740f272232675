// The spheres and their occlusion of ambient light.

#if SPHERES > 0
uniform vec4 spheres[SPHERES];  // center, radius [m]
#endif

// Returns the fraction of ambient light that the spheres leave to a point p with normal n. It is exact for a sphere
// above the horizon (Quilez, "sphere ambient occlusion").
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
