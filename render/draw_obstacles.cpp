#include "render/draw_obstacles.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "drape/render/image.hpp"
#include "render/smooth_surface.hpp"

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
  auto drawn = std::make_unique<Drawn>(gl_, body);
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

// The depths are those of body.vert.
void DrawBody::append_outline(const Shot& shot, const Projection& project, std::vector<OutlineSegment>& outline) const {
  const Eigen::Vector3d eye = shot.eye.cast<double>();
  for (std::size_t k = 0; k < shot.bodies.size(); ++k) {
    const MeshShape& body = *shot.bodies[k];
    std::vector<Eigen::Vector3d> points = project.points(body.positions);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d p = body.positions.row(static_cast<Eigen::Index>(i)).transpose();
      points[i].z() = project.point(p + body.thickness * (p - eye).normalized()).z();
    }
    drawn_[k]->outline.append(points, true, outline);
  }
}

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

// As sphere.vert draws the rim, where the smaller sphere's depth is that of the ray's nearest point.
void DrawSphere::append_outline(const Shot& shot, const Projection& project, std::vector<OutlineSegment>& outline) {
  const Eigen::Vector3d eye = shot.eye.cast<double>();
  for (const Eigen::Vector4f& sphere : shot.spheres) {
    const Eigen::Vector3d center = sphere.head<3>().cast<double>();
    const double radius = double{sphere[3]}, distance = (eye - center).norm();
    if (!(distance > radius)) continue;
    const Eigen::Vector3d axis = (eye - center) / distance;
    const Eigen::Vector3d side =
        (std::abs(axis.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX()).cross(axis).normalized();
    const double cosine = radius / distance, sine = std::sqrt(1 - cosine * cosine);
    std::vector<Eigen::Vector3d> rim;
    for (unsigned k = 0; k < ring_segments.back(); ++k) {
      const double angle = 2 * std::numbers::pi * k / ring_segments.back();
      const Eigen::Vector3d out = std::cos(angle) * side + std::sin(angle) * axis.cross(side);
      const Eigen::Vector3d p = center + radius * (cosine * axis + sine * out), ray = (p - eye).normalized();
      rim.push_back(project.point(p));
      rim.back().z() = project.point(eye - distance * ray.dot(axis) * ray).z();
    }
    for (std::size_t k = 0; k < rim.size(); ++k) outline.push_back({rim[k], rim[(k + 1) % rim.size()]});
  }
}

namespace {

/// Radius to which the ground is visible, in distances from the camera to its focus on the ground.
constexpr double reach = 2.6;
/// Height of the cloth from which its shadow is soft, in heights of the picture.
constexpr double softening = 0.1;

/// Returns the camera's focus on the ground, and the radius around it to which the ground is visible [m].
Eigen::Vector4d focus_of(const Shot& shot, const GroundShape& ground) {
  const Eigen::Vector3d eye = shot.eye.cast<double>(), forward = -shot.back.cast<double>();
  const double above = ground.normal.dot(eye) - ground.height, descent = -ground.normal.dot(forward);
  const double distance = descent > 0.1 ? above / descent : 3 * above;
  const Eigen::Vector3d ahead = eye + distance * forward;
  const Eigen::Vector3d focus = ahead - (ground.normal.dot(ahead) - ground.height) * ground.normal;
  return {focus[0], focus[1], focus[2], reach * distance};
}

void set(const Program& program, const char* name, const Eigen::Vector4d& value) {
  const Eigen::Vector4f single = value.cast<float>();
  program.set(name, std::span(&single, 1));
}

/// Returns corners of quadrilaterals that hold all shadows on a ground: those of spheres, with the size of
/// past_spheres() in shadow.glsl, and that of the cloth's picture.
Vertices shadow_corners(const Shot& shot, const GroundShape& ground, const GroundShadow& shadow) {
  const Eigen::Vector3d light = shot.key_direction.cast<double>().normalized();
  const double rise = ground.normal.dot(light);
  std::vector<Eigen::Vector3d> corners = shadow.corners(ground);
  const Eigen::Vector3d side = ground.normal.unitOrthogonal(), other = ground.normal.cross(side);
  for (const Eigen::Vector4f& sphere : shot.spheres) {
    const Eigen::Vector3d center = sphere.head<3>().cast<double>();
    const double along = (ground.normal.dot(center) - ground.height) / rise;
    const double radius = double{sphere[3]}, farthest = std::abs(along) + radius / rise;
    const double reached = (1.05 * radius + 0.22 * farthest) / rise;
    for (const double x : {-reached, reached}) {
      for (const double y : {-reached, reached}) corners.emplace_back(center - along * light + x * side + y * other);
    }
  }
  Vertices points(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) points.row(static_cast<Eigen::Index>(i)) = corners[i].transpose();
  return points;
}

/// Returns the parts of the picture below, above, left and right of a box; some may be empty.
std::array<PixelBox, 4> around(const PixelBox& box, Eigen::Vector2i picture) {
  const Eigen::Vector2i from = box.corner, to = box.corner + box.size;
  return {PixelBox{{0, 0}, {picture.x(), from.y()}}, PixelBox{{0, to.y()}, {picture.x(), picture.y() - to.y()}},
          PixelBox{{0, from.y()}, {from.x(), box.size.y()}},
          PixelBox{{to.x(), from.y()}, {picture.x() - to.x(), box.size.y()}}};
}

}  // namespace

DrawGround::DrawGround(GlDevice& device, const Look& look, std::size_t sphere_count)
    : gl_(device.gl()),
      look_(look),
      lit_(&device.program("ground", light_defines(look, sphere_count, false))),
      array_(gl_),
      texture_(gl_) {
  if (look.shadows) shadowed_ = &device.program("ground", light_defines(look, sphere_count, true));
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

// A shadow doubles the cost of a ground's pixel, so only pixels that it may touch use the shader with shadows.
void DrawGround::draw(const Shot& shot, const ClothShadow* shadow, Eigen::Vector2i picture) {
  gl_.BindVertexArray(array_.id());
  for (const GroundShape& ground : shot.grounds) {
    const PixelBox box = shadow != nullptr ? cast(shot, *shadow, ground, picture) : PixelBox{};
    if (!box.empty()) draw(*shadowed_, shot, ground, box);
    for (const PixelBox& rest : around(box, picture)) {
      if (!rest.empty()) draw(*lit_, shot, ground, rest);
    }
  }
  gl_.Scissor(0, 0, picture.x(), picture.y());
}

PixelBox DrawGround::cast(const Shot& shot, const ClothShadow& shadow, const GroundShape& ground,
                          Eigen::Vector2i picture) {
  const Eigen::Vector3d light = shot.key_direction.cast<double>().normalized();
  shadow_.cast(shadow.map(), ground, light, softening * shot.extent);
  if (!shadow_.reaches(ground, light)) return {};
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 2);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R16, shadow_.columns(), shadow_.rows(), 0, GL_RED, GL_UNSIGNED_SHORT,
                 shadow_.pixels().data());
  return box_around(shot, shadow_corners(shot, ground, shadow_), picture);
}

void DrawGround::draw(const Program& program, const Shot& shot, const GroundShape& ground, const PixelBox& box) const {
  program.use();
  shot.set_uniforms(program);
  program.set("cloth_shadow", 0);
  program.set("ground_color", linear_color(look_.ground_color));
  program.set("grid_spacing", shot.backdrop ? 0.0F : static_cast<float>(look_.ground_grid));
  program.set("from_clip", Eigen::Matrix4f(shot.view_projection.cast<double>().inverse().cast<float>()));
  set(program, "shadow_u", shadow_.u());
  set(program, "shadow_v", shadow_.v());
  set(program, "ground", {ground.normal[0], ground.normal[1], ground.normal[2], ground.height});
  set(program, "focus", focus_of(shot, ground));
  program.set("sunk", static_cast<float>(GroundShadow::hidden_below * ground.thickness));
  gl_.Scissor(box.corner.x(), box.corner.y(), box.size.x(), box.size.y());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace drape
