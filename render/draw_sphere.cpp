#include "render/draw_sphere.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "render/color.hpp"

namespace drape {
namespace {

// The rim is within 0.03 % of the radius of a circle. Mesa takes about a microsecond per triangle, and every pixel
// finds its own place on the sphere: more rings would only change the depth, by less than sphere.vert's depth_radius
// leaves.
constexpr unsigned segments = 128, rings = 4;

}  // namespace

DrawSphere::DrawSphere(const GlFunctions& gl, const std::filesystem::path& data_folder, const Look& look,
                       std::size_t ground_count)
    : gl_(gl),
      program_(gl, data_folder, "sphere", {fmt::format("GROUNDS {}", ground_count)}),
      array_(gl),
      vertex_buffer_(gl),
      index_buffer_(gl) {
  // Polar coordinates of the cap: how far from its middle (0) to its rim (1), and the direction.
  std::vector<Eigen::Vector3f> vertices;
  for (unsigned ring = 0; ring <= rings; ++ring) {
    for (unsigned segment = 0; segment < segments; ++segment) {
      const double angle = 2 * std::numbers::pi * segment / segments;
      vertices.emplace_back(
          Eigen::Vector3d(static_cast<double>(ring) / rings, std::cos(angle), std::sin(angle)).cast<float>());
    }
  }
  std::vector<unsigned> indices;
  for (unsigned ring = 0; ring < rings; ++ring) {
    for (unsigned segment = 0; segment < segments; ++segment) {
      const unsigned a = ring * segments + segment, b = ring * segments + (segment + 1) % segments;
      for (const unsigned index : {a, a + segments, b + segments, a, b + segments, b}) indices.push_back(index);
    }
  }
  index_count_ = static_cast<GLsizei>(indices.size());

  gl_.BindVertexArray(array_.id());
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertex_buffer_.id());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Eigen::Vector3f)), vertices.data(),
                 GL_STATIC_DRAW);
  gl_.EnableVertexAttribArray(0);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_.id());
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(unsigned)), indices.data(),
                 GL_STATIC_DRAW);
  program_.use();
  program_.set("sphere_color", linear_color(look.sphere_color));
}

void DrawSphere::draw(const Shot& shot) {
  program_.use();
  shot.set_uniforms(program_);
  gl_.BindVertexArray(array_.id());
  for (const Eigen::Vector4f& sphere : shot.spheres) {
    if ((shot.eye - sphere.head<3>()).norm() <= sphere[3]) continue;  // its outside cannot be seen from within
    program_.set("sphere", std::span(&sphere, 1));
    gl_.DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  }
}

}  // namespace drape
