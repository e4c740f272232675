#include "drape/render/renderer.hpp"

#include <fmt/format.h>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/canvas.hpp"
#include "render/draw_cloth.hpp"
#include "render/draw_obstacles.hpp"
#include "render/gl/device.hpp"
#include "render/outline.hpp"
#include "render/shadows.hpp"
#include "render/shot.hpp"

namespace drape {

class Renderer::Implementation {
 public:
  Implementation(const std::filesystem::path& data_folder, Eigen::Vector2i size, const View& view, const Look& look,
                 int vertex_count, const std::vector<Triangle>& triangles, const std::vector<std::array<float, 2>>& uvs,
                 GlBackend backend)
      : size_(size),
        view_(view),
        look_(look),
        vertex_count_(vertex_count),
        device_(borrow_device(data_folder, backend)),
        canvas_(device_->gl(), size, look),
        cloth_(*device_, look, size, triangles, uvs),
        occluders_(cloth_.triangles()) {
    if (look.shadows) shadow_.emplace(device_->gl(), size.y());
  }

  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  // Makes the device current, because the members destroyed next belong to it.
  ~Implementation() {
    try {
      device_->make_current();
    } catch (const std::exception&) {
      // Ignored: Mesa frees the objects with their context.
    }
  }

  void set_weave(const Vertices& rest, const std::vector<std::array<float, 2>>& uvs) { cloth_.set_weave(rest, uvs); }

  void look_from(const View& view) { view_ = view; }

  /// @param colors colours of the vertices; empty: none
  Image draw(const Frame& frame, std::span<const Rgb> colors) {
    if (started_) throw std::logic_error("finish() must return the frame that start() began before draw()");
    start(frame, colors);
    return *finish();
  }

  // Mesa's threads may draw the previous frame until it is read, so this frame is prepared before.
  std::optional<Image> start(const Frame& frame, std::span<const Rgb> colors) {
    if (frame.positions.rows() != vertex_count_) {  // the triangles refer to this many
      throw std::invalid_argument("a frame has another number of vertices than its renderer was made for");
    }
    device_->make_current();
    const Shot shot(frame, view_, static_cast<double>(size_.x()) / size_.y(), look_);
    prepare(shot, colors);
    const bool previous = std::exchange(started_, false);
    if (previous) canvas_.read();
    draw(shot);
    started_ = true;
    const std::vector<OutlineSegment> outline = std::exchange(outline_, find_outline(shot));
    if (!previous) return std::nullopt;
    return canvas_.compose(outline);
  }

  std::optional<Image> finish() {
    if (!std::exchange(started_, false)) return std::nullopt;
    device_->make_current();
    canvas_.read();
    return canvas_.compose(outline_);
  }

  [[nodiscard]] std::string description() const {
    device_->make_current();
    const auto text = [this](GLenum name) { return reinterpret_cast<const char*>(device_->gl().GetString(name)); };
    return fmt::format("{}, OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
  }

 private:
  void prepare(const Shot& shot, std::span<const Rgb> colors) {
    cloth_.shape(shot.frame);
    occluders_.take(cloth_.positions(), shot.frame);
    if (shadow_) shadow_->cast(shot, occluders_);
    cloth_.prepare(shot, shadow(), colors);
  }

  void draw(const Shot& shot) {
    canvas_.begin(covered_box(shot, cloth_.positions(), size_));
    if (shadow_) shadow_->upload();
    if (!shot.grounds.empty()) {
      if (!grounds_) grounds_.emplace(*device_, look_, shot.spheres.size());
      grounds_->draw(shot, shadow(), size_);
    }
    cloth_.draw(shot, shadow());
    if (!shot.spheres.empty()) {  // after the cloth, which hides much of them
      if (!spheres_) spheres_.emplace(*device_, look_, shot.spheres.size(), shot.grounds.size());
      spheres_->draw(shot, shadow());
    }
    if (!shot.bodies.empty()) {
      if (!bodies_) bodies_.emplace(*device_, look_, shot.spheres.size(), shot.grounds.size());
      bodies_->draw(shot, shadow());
    }
    canvas_.finish();
  }

  /// Returns the outlines to smooth in what was drawn: with several samples per pixel none.
  [[nodiscard]] std::vector<OutlineSegment> find_outline(const Shot& shot) const {
    std::vector<OutlineSegment> outline;
    if (look_.samples > 1) return outline;
    const Projection project(shot, size_);
    cloth_.append_outline(project, outline);
    DrawSphere::append_outline(shot, project, outline);
    if (!shot.bodies.empty()) bodies_->append_outline(shot, project, outline);
    return outline;
  }

  [[nodiscard]] const ClothShadow* shadow() const { return shadow_ ? &*shadow_ : nullptr; }

  Eigen::Vector2i size_;
  View view_;
  Look look_;
  int vertex_count_;
  BorrowedDevice device_;  // first: the members below belong to it
  Canvas canvas_;
  DrawCloth cloth_;
  Occluders occluders_;
  std::optional<ClothShadow> shadow_;    // absent if the look has none
  std::optional<DrawSphere> spheres_;    // made at the first frame with a sphere
  std::optional<DrawGround> grounds_;    // likewise
  std::optional<DrawBody> bodies_;       // likewise
  std::vector<OutlineSegment> outline_;  // of the frame that was started last
  bool started_ = false;                 // true while Mesa draws a frame that has not been read
};

namespace {

/// @throws std::invalid_argument if the frame has not as many vertices as there are colours
std::span<const Rgb> checked(const std::vector<Rgb>& vertex_colors, const Frame& frame) {
  if (vertex_colors.empty() || vertex_colors.size() != static_cast<std::size_t>(frame.positions.rows())) {
    throw std::invalid_argument("a frame needs a colour for each of its vertices");
  }
  return vertex_colors;
}

}  // namespace

Renderer::Renderer(const std::filesystem::path& data_folder, Eigen::Vector2i size, const View& view, const Look& look,
                   int vertex_count, const std::vector<Triangle>& triangles,
                   const std::vector<std::array<float, 2>>& uvs, GlBackend backend)
    : implementation_(
          std::make_unique<Implementation>(data_folder, size, view, look, vertex_count, triangles, uvs, backend)) {}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::set_weave(const Vertices& rest, const std::vector<std::array<float, 2>>& uvs) {
  implementation_->set_weave(rest, uvs);
}

void Renderer::look_from(const View& view) { implementation_->look_from(view); }

Image Renderer::draw(const Frame& frame) { return implementation_->draw(frame, {}); }

Image Renderer::draw(const Frame& frame, const std::vector<Rgb>& vertex_colors) {
  return implementation_->draw(frame, checked(vertex_colors, frame));
}

std::optional<Image> Renderer::start(const Frame& frame) { return implementation_->start(frame, {}); }

std::optional<Image> Renderer::start(const Frame& frame, const std::vector<Rgb>& vertex_colors) {
  return implementation_->start(frame, checked(vertex_colors, frame));
}

std::optional<Image> Renderer::finish() { return implementation_->finish(); }

std::string Renderer::description() const { return implementation_->description(); }

}  // namespace drape
