#version 330 core

uniform mat4 from_clip;  // clip space to the world

out vec4 far_point;  // on the far plane, homogeneous [m]

// Draws one triangle that covers the picture.
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
  far_point = from_clip * vec4(corner, 1.0, 1.0);
}
