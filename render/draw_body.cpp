#include "render/draw_body.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "render/color.hpp"
#include "render/normals.hpp"

namespace drape {
namespace {

Eigen::Vector3d face_normal(const Vertices& x, const Triangle& t) {
  const Eigen::RowVector3d a = x.row(t[0]);
  return (x.row(t[1]) - a).cross(x.row(t[2]) - a).transpose().stableNormalized();
}

/// Disjoint sets of the numbers 0, 1, … (union-find).
class Groups {
 public:
  explicit Groups(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }
  std::size_t root(std::size_t k) {
    while (parents_[k] != k) k = parents_[k] = parents_[parents_[k]];
    return k;
  }
  void join(std::size_t k, std::size_t l) { parents_[std::max(root(k), root(l))] = std::min(root(k), root(l)); }

 private:
  std::vector<std::size_t> parents_;
};

std::vector<std::string> body_defines(const Look& look, std::size_t sphere_count, std::size_t ground_count) {
  std::vector<std::string> all = light_defines(look, sphere_count, look.shadows);
  all.push_back(fmt::format("GROUNDS {}", ground_count));
  return all;
}

}  // namespace

CreasedMesh::CreasedMesh(const std::vector<Triangle>& mesh, const Vertices& positions) : triangles(mesh.size()) {
  std::vector<Eigen::Vector3d> normals;
  for (const Triangle& t : mesh) normals.push_back(face_normal(positions, t));
  // Joins corners, numbered 3·t + c, across smooth edges.
  Groups corners(3 * mesh.size());
  std::map<Edge, std::array<std::size_t, 2>> edges;  // with a triangle and its corner where the edge begins
  const double flattest = std::cos(crease * std::numbers::pi / 180);
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int p = mesh[t][c], q = mesh[t][(c + 1) % 3];
      const auto [known, is_new] = edges.try_emplace({std::min(p, q), std::max(p, q)}, std::array{t, c});
      if (is_new) continue;
      const auto [other, d] = known->second;
      if (std::abs(normals[t].dot(normals[other])) < flattest) continue;
      const bool same_start = mesh[other][d] == p;
      corners.join(3 * t + c, 3 * other + (same_start ? d : (d + 1) % 3));
      corners.join(3 * t + (c + 1) % 3, 3 * other + (same_start ? (d + 1) % 3 : d));
    }
  }
  std::map<std::size_t, int> numbers;
  for (std::size_t k = 0; k < 3 * mesh.size(); ++k) {
    const auto [known, is_new] = numbers.try_emplace(corners.root(k), static_cast<int>(sources.size()));
    if (is_new) sources.push_back(mesh[k / 3][k % 3]);
    triangles[k / 3][k % 3] = known->second;
  }
}

DrawBody::DrawBody(GlDevice& device, const Look& look, std::size_t sphere_count, std::size_t ground_count)
    : gl_(device.gl()),
      program_(device.program("body", body_defines(look, sphere_count, ground_count))),
      color_(linear_color(look.body_color)) {}

std::unique_ptr<DrawBody::Drawn> DrawBody::make(const MeshShape& body) const {
  auto drawn = std::make_unique<Drawn>(gl_, CreasedMesh(*body.triangles, body.positions));
  gl_.BindVertexArray(drawn->array.id());
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, drawn->indices.id());
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(drawn->mesh.triangles.size() * sizeof(Triangle)),
                 drawn->mesh.triangles.data(), GL_STATIC_DRAW);
  gl_.BindBuffer(GL_ARRAY_BUFFER, drawn->vertices.id());
  for (const GLuint attribute : {0U, 1U}) {
    gl_.EnableVertexAttribArray(attribute);
    gl_.VertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, 6 * sizeof(float),
                            buffer_offset(3 * sizeof(float) * attribute));
  }
  return drawn;
}

void DrawBody::upload(const Drawn& drawn, const MeshShape& body) {
  const CreasedMesh& mesh = drawn.mesh;
  Vertices x(static_cast<Eigen::Index>(mesh.sources.size()), 3);
  for (std::size_t k = 0; k < mesh.sources.size(); ++k) {
    x.row(static_cast<Eigen::Index>(k)) = body.positions.row(mesh.sources[k]);
  }
  const Vertices normals = vertex_normals(x, mesh.triangles);
  floats_.clear();
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    for (int axis = 0; axis < 3; ++axis) floats_.push_back(static_cast<float>(x(k, axis)));
    for (int axis = 0; axis < 3; ++axis) floats_.push_back(static_cast<float>(normals(k, axis)));
  }
  gl_.BindBuffer(GL_ARRAY_BUFFER, drawn.vertices.id());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(floats_.size() * sizeof(float)), floats_.data(),
                 GL_STREAM_DRAW);
}

void DrawBody::draw(const Shot& shot, const ClothShadow* shadow) {
  for (std::size_t k = 0; k < shot.bodies.size(); ++k) {
    const MeshShape& body = *shot.bodies[k];
    if (k == drawn_.size()) drawn_.push_back(make(body));
    const Drawn& drawn = *drawn_[k];
    upload(drawn, body);
    program_.use();
    program_.set("body_color", color_);
    shot.set_uniforms(program_);
    if (shadow != nullptr) shadow->set_uniforms(program_);
    program_.set("depth_behind", static_cast<float>(body.thickness));
    gl_.BindVertexArray(drawn.array.id());
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * drawn.mesh.triangles.size()), GL_UNSIGNED_INT, nullptr);
  }
}

}  // namespace drape
