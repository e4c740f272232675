#include "render/draw_sphere.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "render/color.hpp"

namespace drape {
namespace {

/// Segments of the rings from the middle of the cap to its rim, each a multiple of the previous. The rim deviates from
/// a circle by at most 0.03 % of the radius. Each pixel computes its exact point on the sphere, so more inner rings
/// would change only the depth, by less than the margin of depth_radius in sphere.vert. Pixels are drawn in blocks, and
/// small triangles share many of these.
constexpr std::array<unsigned, 5> ring_segments{1, 16, 32, 32, 128};

/// Returns the polar coordinates of the cap's vertices: radius from its middle (0) to its rim (1), and direction.
std::vector<Eigen::Vector3f> cap_vertices() {
  std::vector<Eigen::Vector3f> vertices;
  for (std::size_t ring = 0; ring < ring_segments.size(); ++ring) {
    const double outwards = static_cast<double>(ring) / (ring_segments.size() - 1);
    for (unsigned segment = 0; segment < ring_segments[ring]; ++segment) {
      const double angle = 2 * std::numbers::pi * segment / ring_segments[ring];
      vertices.emplace_back(Eigen::Vector3d(outwards, std::cos(angle), std::sin(angle)).cast<float>());
    }
  }
  return vertices;
}

/// Fills the gap between two rings: each inner segment gets one triangle and a fan of outer ones.
std::vector<unsigned> cap_triangles() {
  std::vector<unsigned> indices;
  unsigned first = 0;
  for (std::size_t ring = 0; ring + 1 < ring_segments.size(); ++ring) {
    const unsigned inner = ring_segments[ring], outer = ring_segments[ring + 1], outer_first = first + inner;
    for (unsigned segment = 0; segment < outer; ++segment) {
      const unsigned a = first + segment / (outer / inner), b = outer_first + segment,
                     c = outer_first + (segment + 1) % outer;
      indices.insert(indices.end(), {a, b, c});
      const unsigned next = first + (segment + 1) / (outer / inner) % inner;
      if (next != a) indices.insert(indices.end(), {a, c, next});
    }
    first = outer_first;
  }
  return indices;
}

std::vector<std::string> defines(const Look& look, std::size_t sphere_count, std::size_t ground_count) {
  std::vector<std::string> all = light_defines(look, sphere_count, look.shadows);
  all.push_back(fmt::format("GROUNDS {}", ground_count));
  return all;
}

}  // namespace

DrawSphere::DrawSphere(GlDevice& device, const Look& look, std::size_t sphere_count, std::size_t ground_count)
    : gl_(device.gl()),
      program_(device.program("sphere", defines(look, sphere_count, ground_count))),
      color_(linear_color(look.sphere_color)),
      array_(gl_),
      vertex_buffer_(gl_),
      index_buffer_(gl_) {
  const std::vector<Eigen::Vector3f> vertices = cap_vertices();
  const std::vector<unsigned> indices = cap_triangles();
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
}

void DrawSphere::draw(const Shot& shot, const ClothShadow* shadow) {
  program_.use();
  program_.set("sphere_color", color_);
  shot.set_uniforms(program_);
  if (shadow != nullptr) shadow->set_uniforms(program_);
  gl_.BindVertexArray(array_.id());
  for (const Eigen::Vector4f& sphere : shot.spheres) {
    if ((shot.eye - sphere.head<3>()).norm() <= sphere[3])
      continue;  // the camera is inside the sphere and cannot see its outside
    program_.set("sphere", std::span(&sphere, 1));
    gl_.DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  }
}

}  // namespace drape
