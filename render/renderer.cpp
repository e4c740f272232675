#include "drape/render/renderer.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "drape/core/error.hpp"
#include "drape/render/image.hpp"
#include "drape/render/settings.hpp"
#include "render/draw_cloth.hpp"
#include "render/draw_obstacles.hpp"
#include "render/gl/device.hpp"
#include "render/gl/program.hpp"
#include "render/outline.hpp"
#include "render/shadows.hpp"
#include "render/shot.hpp"

namespace drape {
namespace {

/// Bayer's 4×4 matrix of dither thresholds.
constexpr std::array<std::array<double, 4>, 4> thresholds{
    {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}}};

constexpr std::uint32_t full = 65535;  // 16-bit value of light 1, and of coverage 1

void check_complete(const GlFunctions& gl) {
  const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw OutputError(fmt::format("cannot draw: OpenGL refuses the framebuffer (status {:#x})", status));
  }
}

Eigen::Vector2i checked_size(const GlFunctions& gl, Eigen::Vector2i size) {
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (size.minCoeff() < 1 || size.maxCoeff() > largest) {
    throw OutputError(fmt::format("cannot draw a picture of {}x{} pixels: width and height must be 1 to {}", size.x(),
                                  size.y(), largest));
  }
  return size;
}

/// Returns the sRGB byte of each 16-bit linear value.
const std::vector<std::uint8_t>& encoding() {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> bytes(full + 1);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes[i] = static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(static_cast<double>(i) / full)));
    }
    return bytes;
  }();
  return table;
}

}  // namespace

/// Drawing target: 16 bits of linear light per channel, premultiplied with coverage. The samples of a pixel are
/// averaged in linear light; one sample per pixel is smoothed along outlines. The picture is then composed over the
/// background and encoded as sRGB. The last two steps run here, not in OpenGL: Mesa's sRGB framebuffers differ between
/// processors, while a table is exact and faster than a shader on a processor.
///
/// A picture takes four calls: begin(), finish(), read(), compose(). Mesa's threads draw between finish() and read(),
/// and may draw the next picture before compose().
class Canvas {
 public:
  /// @param size picture size [pixels]
  /// @throws OutputError if the picture is too large for OpenGL
  Canvas(const GlFunctions& gl, Eigen::Vector2i size, const Look& look);

  /// Clears the canvas and directs drawing to it.
  /// @param box pixels that will be drawn; everything outside is background
  void begin(const PixelBox& box);

  /// Averages the samples of everything drawn since begin(), and lets Mesa's threads start. Returns at once.
  void finish();

  /// Waits for Mesa's threads and reads what they have drawn.
  /// @throws OutputError if OpenGL reports an error
  void read();

  /// Returns the picture that was read, over the background. Untouched pixels have the background's exact bytes. To be
  /// called once after read().
  /// @param outline outlines to smooth, with one sample per pixel
  [[nodiscard]] Image compose(std::span<const OutlineSegment> outline);

 private:
  /// A colour buffer and, with `depth`, a depth buffer of the same size and number of samples.
  struct Target {
    Renderbuffer color;
    std::optional<Renderbuffer> depth;
    Framebuffer framebuffer;
    Target(const GlFunctions& gl, Eigen::Vector2i size, int samples, bool with_depth);
  };

  /// One row of the background.
  struct Row {
    std::array<std::uint32_t, 3> light{};  // 16 bits, linear
  };

  const GlFunctions& gl_;
  Eigen::Vector2i size_;
  std::vector<Row> background_;  // rows from below
  Image empty_;                  // the background alone
  PixelBox box_, read_box_;      // of the pictures drawn and read last
  Target samples_;
  std::optional<Target> resolved_;   // absent with one sample per pixel
  std::vector<std::uint16_t> rgba_;  // pixels read, rows from below
  std::vector<float> depth_;         // likewise, with one sample per pixel
};

Canvas::Target::Target(const GlFunctions& gl, Eigen::Vector2i size, int samples, bool with_depth)
    : color(gl), framebuffer(gl) {
  const GLsizei count = samples > 1 ? samples : 0;
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  gl.BindRenderbuffer(GL_RENDERBUFFER, color.id());
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, count, GL_RGBA16, size.x(), size.y());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color.id());
  if (with_depth) {
    depth.emplace(gl);
    gl.BindRenderbuffer(GL_RENDERBUFFER, depth->id());
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, count, GL_DEPTH_COMPONENT32F, size.x(), size.y());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth->id());
  }
  check_complete(gl);
}

Canvas::Canvas(const GlFunctions& gl, Eigen::Vector2i size, const Look& look)
    : gl_(gl),
      size_(checked_size(gl, size)),
      empty_(size.x(), size.y()),
      samples_(gl, size, look.samples, true),
      rgba_(4 * static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y())) {
  if (look.samples > 1) resolved_.emplace(gl, size, 1, false);
  const Rgb bottom = look.lower_background(), top = look.upper_background();
  const std::array<double, 3> lower{bottom.r, bottom.g, bottom.b};
  const std::array<double, 3> upper{top.r, top.g, top.b};
  for (int y = 0; y < size.y(); ++y) {
    Row& row = background_.emplace_back();
    const double height = 1 - (size.y() - 1 - y + 0.5) / size.y();  // of the row's middle, 0 to 1
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = std::clamp(std::lerp(lower[c], upper[c], height), 0.0, 1.0);
      row.light[c] = static_cast<std::uint32_t>(std::lround(full * srgb_to_linear(value)));
    }
    // A gradient without dithering has visible bands. A uniform colour needs none and stays exact.
    const auto& offsets = thresholds[static_cast<std::size_t>(y % 4)];
    for (int x = 0; x < size.x(); ++x) {
      const double offset = (offsets[static_cast<std::size_t>(x % 4)] + 0.5) / 16 - 0.5;
      for (std::size_t c = 0; c < 3; ++c) {
        const double exact = 255 * std::clamp(std::lerp(lower[c], upper[c], height), 0.0, 1.0);
        const double dithered = lower[c] == upper[c] ? exact : exact + offset;
        empty_.at(x, size.y() - 1 - y)[c] = static_cast<std::uint8_t>(std::lround(std::clamp(dithered, 0.0, 255.0)));
      }
    }
  }
}

// Emptying, resolving and reading the whole picture would take llvmpipe longer than most of what is drawn.
void Canvas::begin(const PixelBox& box) {
  box_ = box;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, samples_.framebuffer.id());
  gl_.Viewport(0, 0, size_.x(), size_.y());
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(box.corner.x(), box.corner.y(), box.size.x(), box.size.y());
  gl_.Enable(GL_DEPTH_TEST);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Canvas::finish() {
  if (resolved_ && !box_.empty()) {
    const Eigen::Vector2i from = box_.corner, to = box_.corner + box_.size;
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, samples_.framebuffer.id());
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_->framebuffer.id());
    gl_.BlitFramebuffer(from.x(), from.y(), to.x(), to.y(), from.x(), from.y(), to.x(), to.y(), GL_COLOR_BUFFER_BIT,
                        GL_NEAREST);
  }
  gl_.Flush();
}

void Canvas::read() {
  read_box_ = box_;
  if (box_.empty()) return;
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_ ? resolved_->framebuffer.id() : samples_.framebuffer.id());
  gl_.ReadPixels(box_.corner.x(), box_.corner.y(), box_.size.x(), box_.size.y(), GL_RGBA, GL_UNSIGNED_SHORT,
                 rgba_.data());
  if (!resolved_) {
    depth_.resize(static_cast<std::size_t>(box_.size.x()) * static_cast<std::size_t>(box_.size.y()));
    gl_.ReadPixels(box_.corner.x(), box_.corner.y(), box_.size.x(), box_.size.y(), GL_DEPTH_COMPONENT, GL_FLOAT,
                   depth_.data());
  }
  if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR) {
    throw OutputError(fmt::format("cannot draw: OpenGL reports error {:#x}", error));
  }
}

Image Canvas::compose(std::span<const OutlineSegment> outline) {
  if (!resolved_) smooth_outlines(outline, read_box_, depth_, rgba_);
  Image image = empty_;
  const std::uint8_t* encode = encoding().data();
  const std::uint16_t* from = rgba_.data();
  const Eigen::Vector2i begin = read_box_.corner, end = read_box_.corner + read_box_.size;
  for (int y = begin.y(); y < end.y(); ++y) {
    const Row& row = background_[static_cast<std::size_t>(y)];
    std::uint8_t* to = image.at(begin.x(), size_.y() - 1 - y);
    for (int x = begin.x(); x < end.x(); ++x, from += 4, to += 3) {
      const std::uint32_t uncovered = full - from[3];
      if (uncovered == full) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t light = from[c] + (uncovered * row.light[c] + full / 2) / full;
        to[c] = encode[std::min(light, full)];
      }
    }
  }
  return image;
}

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
    {
      const auto lock = lock_gl();
      if (previous) canvas_.read();
      draw(shot);
    }
    started_ = true;
    const std::vector<OutlineSegment> outline = std::exchange(outline_, find_outline(shot));
    if (!previous) return std::nullopt;
    return canvas_.compose(outline);
  }

  std::optional<Image> finish() {
    if (!std::exchange(started_, false)) return std::nullopt;
    {
      const auto lock = lock_gl();
      device_->make_current();
      canvas_.read();
    }
    return canvas_.compose(outline_);
  }

  [[nodiscard]] std::string description() const {
    const auto lock = lock_gl();
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
      if (!spheres_) spheres_.emplace(*device_, look_, shot.spheres.size(), shot.cuts.size());
      spheres_->draw(shot, shadow());
    }
    if (!shot.bodies.empty()) {
      if (!bodies_) bodies_.emplace(*device_, look_, shot.spheres.size(), shot.cuts.size());
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
                   const std::vector<std::array<float, 2>>& uvs, GlBackend backend) {
  const auto lock = lock_gl();
  implementation_ =
      std::make_unique<Implementation>(data_folder, size, view, look, vertex_count, triangles, uvs, backend);
}

Renderer::~Renderer() {
  const auto lock = lock_gl();
  implementation_.reset();
}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&& other) noexcept {
  const auto lock = lock_gl();
  implementation_ = std::move(other.implementation_);
  return *this;
}

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
