#include "render/draw_cloth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "render/color.hpp"
#include "render/gl/inspect.hpp"
#include "render/normals.hpp"
#include "render/texture_image.hpp"

namespace drape {
namespace {

constexpr GLuint position_attribute = 0, normal_attribute = 1, uv_attribute = 2, barycentric_attribute = 3,
                 line_scale_attribute = 4, color_attribute = 5, occlusion_attribute = 6;

/// Texels of the maps of ambient occlusion across what the picture shows.
constexpr double occlusion_resolution = 100;

Edge sorted(int p, int q) { return {std::min(p, q), std::max(p, q)}; }

/// Of each triangle, for the edges opposite to its corners: whether only one triangle has that edge.
std::vector<std::array<bool, 3>> boundary_edges(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> uses;
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) ++uses[sorted(t[(c + 1) % 3], t[(c + 2) % 3])];
  }
  std::vector<std::array<bool, 3>> boundary(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      boundary[t][c] = uses[sorted(triangles[t][(c + 1) % 3], triangles[t][(c + 2) % 3])] == 1;
    }
  }
  return boundary;
}

}  // namespace

DrawCloth::DrawCloth(GlDevice& device, const Look& look, const std::vector<Triangle>& triangles,
                     const std::vector<std::array<float, 2>>& uvs)
    : device_(device),
      gl_(device.gl()),
      look_(look),
      triangles_(triangles),
      array_(gl_),
      static_buffer_(gl_),
      dynamic_buffer_(gl_),
      index_buffer_(gl_) {
  if (!uvs.empty() && uvs.size() != 3 * triangles.size()) {
    throw std::invalid_argument("a cloth needs a texture coordinate for each corner of each triangle, or none at all");
  }
  if (!look.texture.empty()) {
    if (uvs.empty()) {
      throw UsageError(fmt::format("the texture {} cannot be put on a cloth whose mesh has no texture coordinates",
                                   shown(look.texture)));
    }
    load_texture();
  }
  if (look.ambient_occlusion) {
    occlusion_.emplace();
    occlusion_buffer_.emplace(gl_);
  }
  make_corners(uvs);
}

void DrawCloth::load_texture() {
  GLint largest = 0;
  gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  const std::vector<TextureLevel> levels = load_texture_image(look_.texture, largest);
  texture_.emplace(gl_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_->id());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 2);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    gl_.TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), GL_RGB16, levels[i].width, levels[i].height, 0, GL_RGB,
                   GL_UNSIGNED_SHORT, levels[i].pixels.data());
  }
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  if (look_.anisotropy > 1) {
    gl_.TexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY,
                      static_cast<float>(std::min(max_anisotropy(gl_), look_.anisotropy)));
  }
}

void DrawCloth::make_corners(const std::vector<std::array<float, 2>>& uvs) {
  std::vector<Corner> corners;
  if (look_.mesh_lines) {
    const std::vector<std::array<bool, 3>> boundary = boundary_edges(triangles_);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        Corner corner;
        if (!uvs.empty()) corner.uv = uvs[3 * t + c];
        corner.barycentric[c] = 1;
        for (std::size_t k = 0; k < 3; ++k) corner.line_scale[k] = boundary[t][k] ? 2 : 1;
        indices_.push_back(static_cast<unsigned>(corners.size()));
        positions_.push_back(triangles_[t][c]);
        corners.push_back(corner);
      }
    }
  } else {
    std::map<std::tuple<int, float, float>, unsigned> known;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        Corner corner;
        if (!uvs.empty()) corner.uv = uvs[3 * t + c];
        const auto [place, is_new] =
            known.try_emplace({triangles_[t][c], corner.uv[0], corner.uv[1]}, static_cast<unsigned>(corners.size()));
        if (is_new) {
          positions_.push_back(triangles_[t][c]);
          corners.push_back(corner);
        }
        indices_.push_back(place->second);
      }
    }
  }

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

  dynamic_.resize(6 * positions_.size());
  gl_.BindBuffer(GL_ARRAY_BUFFER, dynamic_buffer_.id());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(dynamic_.size() * sizeof(float)), nullptr, GL_STREAM_DRAW);
  attribute(position_attribute, 3, 6 * sizeof(float), 0);
  attribute(normal_attribute, 3, 6 * sizeof(float), 3 * sizeof(float));
}

void DrawCloth::upload_frame(const Shot& shot, const Occluders& occluders) {
  const Frame& frame = shot.frame;
  const Vertices normals = vertex_normals(frame.positions, triangles_);
  float* to = dynamic_.data();
  for (const int vertex : positions_) {
    for (int axis = 0; axis < 3; ++axis) *to++ = static_cast<float>(frame.positions(vertex, axis));
    for (int axis = 0; axis < 3; ++axis) *to++ = static_cast<float>(normals(vertex, axis));
  }
  gl_.BindBuffer(GL_ARRAY_BUFFER, dynamic_buffer_.id());
  gl_.BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(dynamic_.size() * sizeof(float)), dynamic_.data());
  if (occlusion_) upload_occlusion(shot, occluders, normals);
}

void DrawCloth::upload_occlusion(const Shot& shot, const Occluders& occluders, const Vertices& normals) {
  const std::vector<AmbientOcclusion::Sides>& open =
      occlusion_->compute(occluders.positions(), normals, occluders.triangles(), shot.extent / occlusion_resolution);
  std::vector<AmbientOcclusion::Sides> of_corners;
  of_corners.reserve(positions_.size());
  for (const int vertex : positions_) of_corners.push_back(open[static_cast<std::size_t>(vertex)]);
  gl_.BindVertexArray(array_.id());
  gl_.BindBuffer(GL_ARRAY_BUFFER, occlusion_buffer_->id());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(of_corners.size() * sizeof(AmbientOcclusion::Sides)),
                 of_corners.data(), GL_STREAM_DRAW);
  gl_.EnableVertexAttribArray(occlusion_attribute);
  gl_.VertexAttribPointer(occlusion_attribute, 2, GL_FLOAT, GL_FALSE, sizeof(AmbientOcclusion::Sides), nullptr);
}

void DrawCloth::upload_colors(std::span<const Rgb> colors) {
  std::vector<float> linear;
  linear.reserve(3 * positions_.size());
  for (const int vertex : positions_) {
    const Eigen::Vector3f color = linear_color(colors[static_cast<std::size_t>(vertex)]);
    linear.insert(linear.end(), color.data(), color.data() + 3);
  }
  if (!color_buffer_) color_buffer_.emplace(gl_);
  gl_.BindVertexArray(array_.id());
  gl_.BindBuffer(GL_ARRAY_BUFFER, color_buffer_->id());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(linear.size() * sizeof(float)), linear.data(),
                 GL_STREAM_DRAW);
  gl_.EnableVertexAttribArray(color_attribute);
  gl_.VertexAttribPointer(color_attribute, 3, GL_FLOAT, GL_FALSE, 3 * sizeof(float), nullptr);
}

void DrawCloth::find_programs(std::size_t sphere_count, bool colored) {
  if (lit_program_ && sphere_count_ == sphere_count && colored_ == colored) return;
  sphere_count_ = sphere_count;
  colored_ = colored;
  lit_program_ = find_program(false);
  if (look_.shadows) shadowed_program_ = find_program(true);
}

const Program* DrawCloth::find_program(bool shadowed) const {
  std::vector<std::string> defines = light_defines(look_, sphere_count_, shadowed);
  if (colored_) {
    defines.emplace_back("VERTEX_COLORS");
  } else if (texture_) {
    defines.emplace_back("TEXTURE");
  }
  if (look_.mesh_lines) defines.emplace_back("MESH_LINES");
  return &device_.program("cloth", defines);
}

void DrawCloth::set_uniforms(const Program& program) const {
  program.set("cloth_texture", 0);
  program.set("translucency", static_cast<float>(look_.translucency));
  program.set("cloth_color", linear_color(look_.color));
  program.set("line_color", linear_color(look_.line_color));
  program.set("line_width", static_cast<float>(look_.line_width));
}

// Reading the shadow map takes llvmpipe about as long as all else in a pixel.
void DrawCloth::upload_indices(const ClothShadow& shadow) {
  std::vector<unsigned> lit, shadowed;
  lit.reserve(indices_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    std::vector<unsigned>& group = shadow.may_fall_on(triangles_[t]) ? shadowed : lit;
    for (std::size_t c = 0; c < 3; ++c) group.push_back(indices_[3 * t + c]);
  }
  lit_count_ = lit.size() / 3;
  lit.insert(lit.end(), shadowed.begin(), shadowed.end());
  gl_.BindVertexArray(array_.id());
  gl_.BufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(lit.size() * sizeof(unsigned)), lit.data());
}

void DrawCloth::draw(const Shot& shot, const ClothShadow* shadow, const Occluders& occluders,
                     std::span<const Rgb> colors) {
  upload_frame(shot, occluders);
  if (!colors.empty()) upload_colors(colors);
  find_programs(shot.spheres.size(), !colors.empty());
  lit_count_ = triangles_.size();
  if (shadow != nullptr) upload_indices(*shadow);
  if (texture_) {
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, texture_->id());
  }
  gl_.BindVertexArray(array_.id());
  const auto draw_triangles = [&](const Program& program, std::size_t first, std::size_t count) {
    if (count == 0) return;
    program.use();
    set_uniforms(program);
    shot.set_uniforms(program);
    if (shadow != nullptr) shadow->set_uniforms(program);
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT,
                     buffer_offset(3 * first * sizeof(unsigned)));
  };
  draw_triangles(*lit_program_, 0, lit_count_);
  if (shadow != nullptr) draw_triangles(*shadowed_program_, lit_count_, triangles_.size() - lit_count_);
}

}  // namespace drape
