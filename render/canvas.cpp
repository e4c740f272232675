#include "render/canvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"
#include "render/color.hpp"

namespace drape {
namespace {

constexpr std::uint32_t full = 65535;  // the 16 bits of light 1, and of coverage 1

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

/// The sRGB byte of each 16-bit linear value.
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

/// The background in one row of the picture, as bytes and as 16-bit light.
struct Background {
  std::array<std::uint8_t, 3> bytes{};
  std::array<std::uint32_t, 3> light{};

  /// @param height of the row's middle, 0 at the bottom of the picture to 1 at its top
  Background(const Look& look, double height) {
    const Rgb top = look.background_top.value_or(look.background);
    const std::array<double, 3> lower{look.background.r, look.background.g, look.background.b};
    const std::array<double, 3> upper{top.r, top.g, top.b};
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = std::clamp(std::lerp(lower[c], upper[c], height), 0.0, 1.0);
      bytes[c] = static_cast<std::uint8_t>(std::lround(255 * value));
      light[c] = static_cast<std::uint32_t>(std::lround(full * srgb_to_linear(value)));
    }
  }
};

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
      look_(look),
      samples_(gl, size, look.samples, true),
      rgba_(4 * static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y())) {
  if (look.samples > 1) resolved_.emplace(gl, size, 1, false);
}

void Canvas::begin() {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, samples_.framebuffer.id());
  gl_.Viewport(0, 0, size_.x(), size_.y());
  gl_.Enable(GL_DEPTH_TEST);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

Image Canvas::finish() {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, samples_.framebuffer.id());
  if (resolved_) {
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_->framebuffer.id());
    gl_.BlitFramebuffer(0, 0, size_.x(), size_.y(), 0, 0, size_.x(), size_.y(), GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_->framebuffer.id());
  }
  gl_.ReadPixels(0, 0, size_.x(), size_.y(), GL_RGBA, GL_UNSIGNED_SHORT, rgba_.data());
  if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR) {
    throw OutputError(fmt::format("cannot draw: OpenGL reports error {:#x}", error));
  }

  const std::uint8_t* encode = encoding().data();
  Image image(size_.x(), size_.y());
  const std::uint16_t* from = rgba_.data();  // rows from bottom to top
  for (int y = size_.y() - 1; y >= 0; --y) {
    const Background background(look_, 1 - (y + 0.5) / size_.y());
    std::uint8_t* to = image.at(0, y);
    for (int x = 0; x < size_.x(); ++x, from += 4, to += 3) {
      const std::uint32_t uncovered = full - from[3];
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t light = from[c] + (uncovered * background.light[c] + full / 2) / full;
        to[c] = uncovered == full ? background.bytes[c] : encode[std::min(light, full)];
      }
    }
  }
  return image;
}

}  // namespace drape
