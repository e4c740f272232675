#version 330 core

uniform mat4 view_projection;
uniform vec3 eye;            // [m]
uniform float depth_behind;  // depth of the drawn surface behind the true one [m]

layout(location = 0) in vec3 position;  // [m]
layout(location = 1) in vec3 normal;

out vec3 world_position;
out vec3 world_normal;

void main() {
  world_position = position;
  world_normal = normal;
  gl_Position = view_projection * vec4(position, 1.0);
  // The cloth rests on a contact layer around the body, and dips into it between its vertices. The depth offset makes
  // the cloth hide the body there as well.
  vec4 behind = view_projection * vec4(position + depth_behind * normalize(position - eye), 1.0);
  gl_Position.z = behind.z / behind.w * gl_Position.w;
}
