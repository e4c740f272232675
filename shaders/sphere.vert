#version 330 core

uniform mat4 view_projection;
uniform vec3 eye;        // [m]
uniform vec4 sphere;     // center, radius [m]

layout(location = 0) in vec3 cap;  // 0 in the middle of the visible cap to 1 at its rim; cosine and sine of the direction

out vec3 world_position;

// The cloth rests on a contact layer around the sphere, and dips into it between its vertices or when pulled hard. To
// let the cloth hide the sphere there as well, the sphere's depth is that of a smaller one.
const float depth_radius = 0.92;

void main() {
  vec3 axis = eye - sphere.xyz;
  float distance = length(axis);
  axis /= distance;
  vec3 side = normalize(abs(axis.z) < 0.9 ? cross(vec3(0, 0, 1), axis) : cross(vec3(1, 0, 0), axis));
  vec3 other = cross(axis, side);

  float angle = cap.x * acos(sphere.w / distance);  // the view touches the sphere at the rim
  vec3 normal = cos(angle) * axis + sin(angle) * (cap.y * side + cap.z * other);
  world_position = sphere.xyz + sphere.w * normal;
  gl_Position = view_projection * vec4(world_position, 1.0);

  // Intersects the same ray with the smaller sphere, or takes its nearest point.
  vec3 ray = normalize(world_position - eye);
  float nearest = -distance * dot(ray, axis);
  float missed_by = distance * distance - nearest * nearest;
  float small_radius = depth_radius * sphere.w;
  float hit = nearest - sqrt(max(small_radius * small_radius - missed_by, 0.0));
  vec4 behind = view_projection * vec4(eye + hit * ray, 1.0);
  gl_Position.z = behind.z / behind.w * gl_Position.w;
}
