#include "render/draw_cloth.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/render/image.hpp"
#include "render/smooth_surface.hpp"

namespace drape {
namespace {

constexpr GLuint position_attribute = 0, normal_attribute = 1, uv_attribute = 2, barycentric_attribute = 3,
                 line_scale_attribute = 4, color_attribute = 5, occlusion_attribute = 6;

/// Texels of the ambient occlusion maps across the visible part of the scene.
constexpr double occlusion_resolution = 100;

/// Returns for each triangle, by the edge opposite each corner, whether it is the edge's only triangle.
std::vector<std::array<bool, 3>> boundary_edges(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> uses;
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) ++uses[undirected(t[(c + 1) % 3], t[(c + 2) % 3])];
  }
  std::vector<std::array<bool, 3>> boundary(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      boundary[t][c] = uses[undirected(triangles[t][(c + 1) % 3], triangles[t][(c + 2) % 3])] == 1;
    }
  }
  return boundary;
}

/// Returns for each texture coordinate whether the texture repeats: some coordinate lies outside 0 to 1, or one vertex
/// is at both ends of the texture, as on the seam of a tube.
/// @param uvs per triangle corner
std::array<bool, 2> repeats(std::span<const Triangle> triangles, std::span<const std::array<float, 2>> uvs) {
  constexpr float slack = 1e-4F;
  std::array<bool, 2> repeating{};
  std::map<int, std::array<float, 2>> known;
  for (std::size_t i = 0; i < uvs.size(); ++i) {
    const std::array<float, 2>& first = known.try_emplace(triangles[i / 3][i % 3], uvs[i]).first->second;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const float here = uvs[i][axis];
      const bool around = std::abs(here - first[axis]) >= 1 - slack;
      repeating[axis] = repeating[axis] || here < -slack || here > 1 + slack || around;
    }
  }
  return repeating;
}

/// Returns the hem's triangles and those that join it to the cloth.
std::vector<Triangle> joined(const Hem& hem) {
  std::vector<Triangle> all = hem.triangles();
  all.insert(all.end(), hem.joints().begin(), hem.joints().end());
  return all;
}

}  // namespace

DrawCloth::DrawCloth(GlDevice& device, const Look& look, Eigen::Vector2i size, const std::vector<Triangle>& triangles,
                     const std::vector<std::array<float, 2>>& uvs)
    : device_(device),
      gl_(device.gl()),
      look_(look),
      triangles_(triangles),
      surface_(triangles, SmoothSurface::levels_for(triangles.size(), static_cast<double>(size.x()) * size.y())),
      hem_(surface_, look.mesh_lines ? 0 : look.thickness),
      outline_(surface_.triangles()),
      hem_outline_(joined(hem_)),
      occluders_(triangles_),
      array_(gl_),
      static_buffer_(gl_),
      dynamic_buffer_(gl_),
      index_buffer_(gl_),
      size_(size) {
  if (!uvs.empty() && uvs.size() != 3 * triangles.size()) {
    throw std::invalid_argument("a cloth needs a texture coordinate for each corner of each triangle, or none at all");
  }
  if (look.cloths.empty()) {
    paint({.color = look.color, .texture = look.texture}, uvs);
  } else {
    for (const ClothLook& cloth : look.cloths) paint(cloth, uvs);
  }
  if (look.ambient_occlusion) {
    occlusion_.emplace();
    occlusion_buffer_.emplace(gl_);
  }
  make_corners(uvs);
}

void DrawCloth::shape(const Frame& frame) {
  positions_ = surface_.positions(frame.positions);
  normals_ = vertex_normals(positions_, surface_.triangles());
  hem_.append(positions_, normals_);
  float* to = dynamic_.data();
  for (const Source& source : sources_) {
    for (int axis = 0; axis < 3; ++axis) *to++ = static_cast<float>(positions_(source.vertex, axis));
    for (int axis = 0; axis < 3; ++axis) *to++ = static_cast<float>(normals_(source.vertex, axis));
  }
}

void DrawCloth::paint(const ClothLook& look, const std::vector<std::array<float, 2>>& uvs) {
  Painted& cloth =
      painted_.emplace_back(Painted{.first_triangle = look.first_triangle, .color = look.color, .texture = {}});
  const auto next = std::ranges::find_if(
      look_.cloths, [&](const ClothLook& other) { return other.first_triangle > look.first_triangle; });
  const auto first = static_cast<std::size_t>(look.first_triangle);
  const auto last = next == look_.cloths.end() ? triangles_.size() : static_cast<std::size_t>(next->first_triangle);
  const std::span own = std::span(uvs).subspan(uvs.empty() ? 0 : 3 * first, uvs.empty() ? 0 : 3 * (last - first));
  if (look_.cloths.size() > 1 && !uvs.empty()) {
    cloth.woven = std::ranges::any_of(own, [](const std::array<float, 2>& uv) { return uv[0] != 0 || uv[1] != 0; });
  }
  if (look.texture.empty()) return;
  if (uvs.empty()) {
    throw UsageError(fmt::format("the texture {} cannot be put on a cloth whose mesh has no texture coordinates",
                                 shown(look.texture)));
  }
  load_texture(cloth, look.texture, repeats(std::span(triangles_).subspan(first, last - first), own));
}

std::size_t DrawCloth::painted_at(int triangle) const {
  const auto after = std::ranges::upper_bound(painted_, triangle, {}, &Painted::first_triangle);
  return static_cast<std::size_t>(after - painted_.begin()) - 1;
}

void DrawCloth::load_texture(Painted& cloth, const std::filesystem::path& file,
                             const std::array<bool, 2>& repeating) const {
  GLint largest = 0;
  gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  const std::vector<TextureLevel> levels = load_texture_image(file, largest);
  cloth.texture_size = {levels.front().width, levels.front().height};
  cloth.texture.emplace(gl_);
  gl_.BindTexture(GL_TEXTURE_2D, cloth.texture->id());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 2);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    gl_.TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), GL_RGB16, levels[i].width, levels[i].height, 0, GL_RGB,
                   GL_UNSIGNED_SHORT, levels[i].pixels.data());
  }
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  // At the cloth's border a filter that repeated the texture would mix in the colour of the opposite border.
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, repeating[0] ? GL_REPEAT : GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, repeating[1] ? GL_REPEAT : GL_CLAMP_TO_EDGE);
}

void DrawCloth::make_corners(const std::vector<std::array<float, 2>>& uvs) {
  const std::vector<std::array<bool, 3>> boundary =
      look_.mesh_lines ? boundary_edges(triangles_) : std::vector<std::array<bool, 3>>();
  std::vector<Corner> corners;
  std::map<std::tuple<int, float, float>, unsigned> known;
  for (const SmoothSurface::Piece& piece : surface_.pieces()) {
    const auto parent = static_cast<std::size_t>(piece.parent);
    for (std::size_t c = 0; c < 3; ++c) {
      Corner corner;
      for (std::size_t k = 0; k < 3 && !uvs.empty(); ++k) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
          corner.uv[axis] += piece.weights[c][k] * uvs[3 * parent + k][axis];
        }
      }
      const auto number = static_cast<unsigned>(corners.size());
      if (look_.mesh_lines) {
        corner.barycentric = piece.weights[c];
        for (std::size_t k = 0; k < 3; ++k) corner.line_scale[k] = boundary[parent][k] ? 2 : 1;
      } else {
        const auto [place, is_new] = known.try_emplace({piece.corners[c], corner.uv[0], corner.uv[1]}, number);
        indices_.push_back(place->second);
        if (!is_new) continue;
      }
      if (look_.mesh_lines) indices_.push_back(number);
      sources_.push_back({piece.corners[c], triangles_[parent], piece.weights[c]});
      corners.push_back(corner);
    }
  }
  find_footprints(corners);
  add_hem(corners);
  upload_corners(corners);
}

void DrawCloth::find_footprints(const std::vector<Corner>& corners) {
  const auto textured = [](const Painted& cloth) { return cloth.texture.has_value(); };
  if (most_footprint_samples(look_.anisotropy) == 1 || std::ranges::none_of(painted_, textured)) return;
  std::vector<Eigen::Matrix2d> edges;
  for (std::size_t t = 0; t < surface_.triangles().size(); ++t) {
    const Painted& cloth = painted_[painted_at(surface_.pieces()[t].parent)];
    Eigen::Matrix2d edge;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::array<float, 2>&from = corners[indices_[3 * t]].uv, &to = corners[indices_[3 * t + k + 1]].uv;
      edge.col(static_cast<Eigen::Index>(k)) =
          Eigen::Vector2d(double{to[0]} - from[0], double{to[1]} - from[1]).cwiseProduct(cloth.texture_size);
    }
    edges.push_back(edge);
  }
  footprints_.emplace(std::move(edges), look_.anisotropy);
}

// The hem takes the texture of the border beside it. Its corners are in the order of its vertices.
void DrawCloth::add_hem(std::vector<Corner>& corners) {
  const auto first = static_cast<unsigned>(corners.size());
  for (std::size_t k = 0; k < hem_.corners().size(); ++k) {
    const Hem::Corner& border = hem_.corners()[k];
    const unsigned at_border = indices_[3 * static_cast<std::size_t>(border.piece) + border.corner];
    corners.push_back(corners[at_border]);
    sources_.push_back(sources_[at_border]);
    sources_.back().vertex = surface_.vertex_count() + static_cast<int>(k);
  }
  for (const Triangle& t : hem_.triangles()) {
    for (const int vertex : t) indices_.push_back(first + static_cast<unsigned>(vertex - surface_.vertex_count()));
  }
}

void DrawCloth::upload_corners(const std::vector<Corner>& corners) {
  gl_.BindVertexArray(array_.id());
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_.id());
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices_.size() * sizeof(unsigned)), indices_.data(),
                 GL_STREAM_DRAW);
  gl_.BindBuffer(GL_ARRAY_BUFFER, static_buffer_.id());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(Corner)), corners.data(),
                 GL_STATIC_DRAW);
  const auto attribute = [this](GLuint index, GLint size, std::size_t stride, std::size_t start) {
    gl_.EnableVertexAttribArray(index);
    gl_.VertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride), buffer_offset(start));
  };
  attribute(uv_attribute, 2, sizeof(Corner), offsetof(Corner, uv));
  attribute(barycentric_attribute, 3, sizeof(Corner), offsetof(Corner, barycentric));
  attribute(line_scale_attribute, 3, sizeof(Corner), offsetof(Corner, line_scale));

  dynamic_.resize(6 * sources_.size());
  gl_.BindBuffer(GL_ARRAY_BUFFER, dynamic_buffer_.id());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(dynamic_.size() * sizeof(float)), nullptr, GL_STREAM_DRAW);
  attribute(position_attribute, 3, 6 * sizeof(float), 0);
  attribute(normal_attribute, 3, 6 * sizeof(float), 3 * sizeof(float));
}

// Ambient light varies slowly in space, so it is computed at the cloth's own vertices only.
void DrawCloth::find_occlusion(const Shot& shot) {
  const Vertices& positions = shot.frame.positions;
  occluders_.take(positions, shot.frame);
  const std::vector<AmbientOcclusion::Sides>& open =
      occlusion_->compute(occluders_.positions(), vertex_normals(positions, triangles_), occluders_.triangles(),
                          shot.extent / occlusion_resolution);
  open_.clear();
  for (const Source& source : sources_) {
    AmbientOcclusion::Sides mean{};
    for (std::size_t k = 0; k < 3; ++k) {
      const AmbientOcclusion::Sides& corner = open[static_cast<std::size_t>(source.corners[k])];
      for (std::size_t side = 0; side < 2; ++side) mean[side] += source.weights[k] * corner[side];
    }
    open_.insert(open_.end(), mean.begin(), mean.end());
  }
}

void DrawCloth::find_colors(std::span<const Rgb> colors) {
  linear_.clear();
  if (colors.empty()) return;
  for (const Source& source : sources_) {
    Eigen::Vector3f color = Eigen::Vector3f::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      color += source.weights[k] * linear_color(colors[static_cast<std::size_t>(source.corners[k])]);
    }
    linear_.insert(linear_.end(), color.data(), color.data() + 3);
  }
}

void DrawCloth::upload(const Buffer& buffer, GLuint attribute, GLint size, const std::vector<float>& numbers) {
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer.id());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(numbers.size() * sizeof(float)), numbers.data(),
                 GL_STREAM_DRAW);
  gl_.EnableVertexAttribArray(attribute);
  gl_.VertexAttribPointer(attribute, size, GL_FLOAT, GL_FALSE, 0, nullptr);
}

void DrawCloth::upload() {
  gl_.BindVertexArray(array_.id());
  gl_.BindBuffer(GL_ARRAY_BUFFER, dynamic_buffer_.id());
  gl_.BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(dynamic_.size() * sizeof(float)), dynamic_.data());
  if (occlusion_) upload(*occlusion_buffer_, occlusion_attribute, 2, open_);
  if (!linear_.empty()) {
    if (!color_buffer_) color_buffer_.emplace(gl_);
    upload(*color_buffer_, color_attribute, 3, linear_);
  }
  gl_.BufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(sorted_.size() * sizeof(unsigned)),
                    sorted_.data());
}

void DrawCloth::choose_programs(std::size_t sphere_count, bool colored, bool woven) {
  if (sphere_count_ == sphere_count && colored_ == colored && woven_ == woven) return;
  sphere_count_ = sphere_count;
  colored_ = colored;
  woven_ = woven;
  for (Painted& cloth : painted_) cloth.programs = {};
}

const Program* DrawCloth::find_program(const Painted& cloth, std::size_t kind) const {
  using Light = ClothShadow::Light;
  const auto light = static_cast<Light>(kind % kinds_of_light);
  const bool shadows = light == Light::past_spheres || light == Light::past_cloth;
  std::vector<std::string> defines = light_defines(look_, sphere_count_, shadows);
  if (light == Light::past_spheres) defines.emplace_back("PAST_SPHERES");
  if (light == Light::none) defines.emplace_back("DARK");
  if (colored_) {
    defines.emplace_back("VERTEX_COLORS");
  } else if (cloth.texture) {
    const std::array<int, kinds_of_samples> samples{1, 2, most_footprint_samples(look_.anisotropy)};
    defines.emplace_back("TEXTURE");
    defines.push_back(fmt::format("SAMPLES {}", samples[kind / kinds_of_light]));
  }
  if (woven_ && cloth.woven) defines.emplace_back("WEAVE");
  if (look_.mesh_lines) defines.emplace_back("MESH_LINES");
  return &device_.program("cloth", defines);
}

void DrawCloth::set_uniforms(const Painted& cloth, const Program& program) const {
  program.set("cloth_texture", 0);
  program.set("anisotropy", static_cast<float>(look_.anisotropy));
  program.set("translucency", static_cast<float>(look_.translucency));
  program.set("cloth_color", linear_color(cloth.color));
  program.set("line_color", linear_color(look_.line_color));
  program.set("line_width", static_cast<float>(look_.line_width));
  if (woven_ && cloth.woven) weave_->set_uniform(program);
}

// Sorts triangles by cloth, then by samples of the texture, then by light: reading the shadow map takes llvmpipe
// several times as long as all else in a pixel, and each sample of a texture a sixth of the rest.
void DrawCloth::sort_triangles(const Shot& shot, const ClothShadow* shadow) {
  std::vector<std::vector<unsigned>> groups(kinds * painted_.size());
  const std::vector<int>* samples = nullptr;
  if (footprints_ && !colored_) samples = &footprints_->count(shot, positions_, surface_.triangles(), size_);
  std::vector<std::size_t> group_of;
  for (std::size_t t = 0; t < surface_.triangles().size(); ++t) {
    const std::size_t light =
        shadow == nullptr ? 0 : static_cast<std::size_t>(shadow->light_on(surface_.triangles()[t]));
    const std::size_t more = samples == nullptr ? 0 : static_cast<std::size_t>(std::min((*samples)[t], 3) - 1);
    group_of.push_back(kinds * painted_at(surface_.pieces()[t].parent) + kinds_of_light * more + light);
  }
  if (hemmed_) {
    for (const int piece : hem_.pieces()) group_of.push_back(group_of[static_cast<std::size_t>(piece)]);
  }
  for (std::size_t t = 0; t < group_of.size(); ++t) {
    std::vector<unsigned>& group = groups[group_of[t]];
    for (std::size_t c = 0; c < 3; ++c) group.push_back(indices_[3 * t + c]);
  }
  sorted_.clear();
  for (std::size_t k = 0; k < groups.size(); ++k) {
    painted_[k / kinds].counts[k % kinds] = groups[k].size() / 3;
    sorted_.insert(sorted_.end(), groups[k].begin(), groups[k].end());
  }
}

void DrawCloth::prepare(const Shot& shot, const ClothShadow* shadow, std::span<const Rgb> colors) {
  if (occlusion_) find_occlusion(shot);
  find_colors(colors);
  choose_programs(shot.spheres.size(), !colors.empty(), colors.empty() && weave_ && weave_->visible(shot, size_.y()));
  hemmed_ = !hem_.triangles().empty() && resolves(shot, look_.thickness, Hem::least_pixels, size_.y());
  painted_.front().counts = {hemmed_ ? indices_.size() / 3 : surface_.triangles().size()};
  if (shadow != nullptr || painted_.size() > 1 || footprints_) sort_triangles(shot, shadow);
}

void DrawCloth::append_outline(const Projection& project, std::vector<OutlineSegment>& outline) const {
  const std::vector<Eigen::Vector3d> points = project.points(positions_);
  outline_.append(points, !hemmed_, outline);  // the hem covers the border
  if (hemmed_) hem_outline_.append(points, false, outline);
}

void DrawCloth::draw(const Shot& shot, const ClothShadow* shadow) {
  upload();
  std::size_t first = 0;
  for (Painted& cloth : painted_) {
    if (cloth.texture) {
      gl_.ActiveTexture(GL_TEXTURE0);
      gl_.BindTexture(GL_TEXTURE_2D, cloth.texture->id());
    }
    for (std::size_t k = 0; k < kinds; first += cloth.counts[k++]) {
      if (cloth.counts[k] == 0) continue;
      if (cloth.programs[k] == nullptr) cloth.programs[k] = find_program(cloth, k);
      const Program& program = *cloth.programs[k];
      program.use();
      set_uniforms(cloth, program);
      shot.set_uniforms(program);
      if (shadow != nullptr) shadow->set_uniforms(program);
      gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * cloth.counts[k]), GL_UNSIGNED_INT,
                       buffer_offset(3 * first * sizeof(unsigned)));
    }
  }
}

Weave::Weave(const Vertices& rest, const std::vector<Triangle>& triangles,
             const std::vector<std::array<float, 2>>& uvs) {
  if (uvs.size() != 3 * triangles.size()) return;
  // Mean length of a unit of each coordinate, weighted by the triangles' areas.
  Eigen::Vector2d lengths = Eigen::Vector2d::Zero(), longest = lengths;
  double area = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Eigen::Matrix<double, 3, 2> edges;
    Eigen::Matrix2d across;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      edges.col(column) = (rest.row(triangles[t][k + 1]) - rest.row(triangles[t][0])).transpose();
      for (std::size_t axis = 0; axis < 2; ++axis) {
        across(static_cast<Eigen::Index>(axis), column) = uvs[3 * t + k + 1][axis] - uvs[3 * t][axis];
      }
    }
    const Eigen::Vector3d e = edges.col(0), f = edges.col(1);
    const double here = e.cross(f).norm();
    if (!(here > 0) || across.determinant() == 0) continue;
    const Eigen::Vector2d local = (edges * across.inverse()).colwise().norm().transpose();
    lengths += here * local;
    longest = longest.cwiseMax(local);
    area += here;
  }
  if (!(area > 0)) return;
  yarns_ = (lengths / (area * yarn_width)).cast<float>();
  widest_ = yarn_width * (longest.array() * area / lengths.array()).maxCoeff();
}

bool Weave::visible(const Shot& shot, int height) const {
  if (yarns_.isZero()) return false;
  constexpr double slack = 0.8;  // for cloth between the vertices, and for stretched yarns
  return resolves(shot, widest_ / slack, least_pixels, height);
}

void Weave::set_uniform(const Program& program) const {
  constexpr float depth = 0.7F;  // of the relief
  program.set("weave", Eigen::Vector3f(yarns_.x(), yarns_.y(), depth));
}

namespace {

/// Excess over a number of samples that is too small to be seen.
constexpr double footprint_slack = 1.05;

}  // namespace

int most_footprint_samples(int anisotropy) {
  return std::max(1, static_cast<int>(std::ceil(anisotropy / tolerated_stretch)));
}

int footprint_samples(const Eigen::Matrix2d& change, int anisotropy) {
  const double a = change.col(0).squaredNorm(), b = change.col(0).dot(change.col(1)), c = change.col(1).squaredNorm();
  const double middle = (a + c) / 2, apart = std::sqrt((a - c) * (a - c) / 4 + b * b);
  const double longest = std::sqrt(middle + apart), shortest = std::sqrt(std::max(middle - apart, 0.0));
  const double width = std::max({tolerated_stretch * shortest, tolerated_stretch * longest / anisotropy, 1.0});
  const double needed = longest / width;
  if (!(needed > footprint_slack)) return 1;
  return needed <= 2 * footprint_slack ? std::min(2, most_footprint_samples(anisotropy))
                                       : most_footprint_samples(anisotropy);
}

const std::vector<int>& TextureFootprints::count(const Shot& shot, const Vertices& positions,
                                                 std::span<const Triangle> triangles, Eigen::Vector2i picture) {
  const Eigen::Matrix4d to_clip = shot.view_projection.cast<double>();
  const Eigen::MatrixX4d clip = (positions * to_clip.leftCols<3>().transpose()).rowwise() + to_clip.col(3).transpose();
  samples_.assign(triangles.size(), 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (edges_[t].isZero(0)) continue;
    Eigen::Matrix<double, 2, 3> places;  // [pixels]
    bool behind = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto corner = clip.row(triangles[t][c]);
      behind = behind || !(corner[3] > 0);
      places.col(static_cast<Eigen::Index>(c)) =
          corner.head<2>().transpose().cwiseProduct(picture.cast<double>()) / (2 * corner[3]);
    }
    if (behind) continue;
    Eigen::Matrix2d sides;
    sides << places.col(1) - places.col(0), places.col(2) - places.col(0);
    if (sides.determinant() != 0) samples_[t] = footprint_samples(edges_[t] * sides.inverse(), anisotropy_);
  }
  return samples_;
}

}  // namespace drape
