// Studio lighting: a bright sky above, a dim floor below, a key light to the camera's upper left and a fill light to
// its right. All values are linear light.

uniform vec3 eye;             // position of the camera [m]
uniform vec3 up;              // unit vector towards the sky
uniform vec3 key_direction;   // unit vectors towards the lights
uniform vec3 fill_direction;
uniform float exposure;       // factor of all light

const vec3 sky_light = vec3(0.34, 0.36, 0.40);
const vec3 floor_light = vec3(0.20, 0.19, 0.18);
const vec3 key_light = vec3(1.02, 0.99, 0.93);
const vec3 fill_light = vec3(0.10, 0.11, 0.13);

// Returns the ambient light on a surface with normal n.
vec3 ambient_light(vec3 n) { return mix(floor_light, sky_light, 0.5 + 0.5 * dot(n, up)); }

// Returns Lambert's cosine, extended by `wrap` beyond the terminator, because cloth scatters light.
float wrapped_cosine(vec3 n, vec3 direction, float wrap) {
  return max(0.0, (dot(n, direction) + wrap) / (1.0 + wrap));
}

// Returns x to the power of 4: multiplications take software a fraction of the time of pow().
float power4(float x) {
  float square = x * x;
  return square * square;
}

// Returns the cosine whose power is Blinn and Phong's highlight.
float half_cosine(vec3 n, vec3 to_eye, vec3 direction) { return max(dot(n, normalize(to_eye + direction)), 0.0); }

// Returns the energy-conserving highlight of that exponent.
// @param powered half_cosine() to the power of `shininess`
float highlight(vec3 n, vec3 direction, float shininess, float powered) {
  return (shininess + 8.0) / 8.0 * powered * max(dot(n, direction), 0.0);
}

// Returns the reflected fraction of a polished surface, from the cosine between normal and view. Weaker at the rim than
// Schlick's (1994), for a surface that is not perfectly smooth.
float fresnel(float cosine) { return 0.04 + 0.5 * power4(1.0 - clamp(cosine, 0.0, 1.0)); }

// Tone curve: keeps light up to the shoulder and compresses it beyond, so that nothing becomes pure white.
vec3 film(vec3 light) {
  const float shoulder = 0.6, rest = 1.0 - shoulder;
  light *= exposure;
  vec3 over = max(light - shoulder, 0.0);
  return min(light, shoulder) + rest * over / (rest + over);
}
