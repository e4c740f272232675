// The light of a photographer's studio: a bright sky above, a dim floor below, a key light to the camera's upper left and
// a fill light to its right. All values are linear light.

uniform vec3 eye;             // the camera [m]
uniform vec3 up;              // unit vector to the sky
uniform vec3 key_direction;   // unit vectors to the lights
uniform vec3 fill_direction;
uniform float exposure;       // by what all light is multiplied

const vec3 sky_light = vec3(0.34, 0.36, 0.40);
const vec3 floor_light = vec3(0.20, 0.19, 0.18);
const vec3 key_light = vec3(1.02, 0.99, 0.93);
const vec3 fill_light = vec3(0.10, 0.11, 0.13);

// Light from all around on a surface with normal n.
vec3 ambient_light(vec3 n) { return mix(floor_light, sky_light, 0.5 + 0.5 * dot(n, up)); }

// Lambert's cosine, but reaching `wrap` beyond the terminator, as in cloth, where light is scattered.
float wrapped_cosine(vec3 n, vec3 direction, float wrap) {
  return max(0.0, (dot(n, direction) + wrap) / (1.0 + wrap));
}

// x to the power of 4: multiplications take software a fraction of the time of pow().
float power4(float x) {
  float square = x * x;
  return square * square;
}

// The cosine that Blinn and Phong's highlight is a power of.
float half_cosine(vec3 n, vec3 to_eye, vec3 direction) { return max(dot(n, normalize(to_eye + direction)), 0.0); }

// Highlight of a surface of that exponent, with energy kept.
// @param powered half_cosine() to the power of `shininess`
float highlight(vec3 n, vec3 direction, float shininess, float powered) {
  return (shininess + 8.0) / 8.0 * powered * max(dot(n, direction), 0.0);
}

// What of a mirror's reflection a polished surface shows, by the cosine between its normal and the view. It is weaker at
// the rim than Schlick's (1994), as on a surface that is not perfectly smooth.
float fresnel(float cosine) { return 0.04 + 0.5 * power4(1.0 - clamp(cosine, 0.0, 1.0)); }

// What a film keeps of light: all of it up to the shoulder, beyond that ever less, so that nothing is ever just white.
vec3 film(vec3 light) {
  const float shoulder = 0.6, rest = 1.0 - shoulder;
  light *= exposure;
  vec3 over = max(light - shoulder, 0.0);
  return min(light, shoulder) + rest * over / (rest + over);
}
