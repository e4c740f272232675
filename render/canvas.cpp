#include "render/canvas.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "drape/core/error.hpp"
#include "drape/render/image.hpp"

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

}  // namespace drape
