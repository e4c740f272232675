#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/covered_box.hpp"
#include "render/gl/objects.hpp"
#include "render/image.hpp"
#include "render/settings.hpp"

namespace drape {

/// What is drawn on: 16 bits of linear light per channel, premultiplied with coverage. The samples of a pixel are
/// averaged as light adds up, and only then laid over the background and encoded as sRGB. The last two are done here
/// and not by OpenGL: Mesa's sRGB framebuffers differ between processors, a table does not, and it is faster than a
/// shader on one.
class Canvas {
 public:
  /// @param size in pixels
  /// @throws OutputError if the picture is too large for OpenGL
  Canvas(const GlFunctions& gl, Eigen::Vector2i size, const Look& look);

  /// Directs drawing to the canvas, emptied.
  /// @param box what will be drawn on: nothing outside it changes, and all of it is background
  void begin(const PixelBox& box);

  /// The picture: what was drawn since begin(), over the background. Where nothing was drawn the background's bytes are
  /// exact.
  /// @throws OutputError if OpenGL reports an error
  Image finish();

 private:
  /// A colour buffer, and with `depth` a depth buffer, of the same size and number of samples.
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

  /// Lays what was drawn in the box over the background.
  void compose(Image& image) const;

  const GlFunctions& gl_;
  Eigen::Vector2i size_;
  std::vector<Row> background_;  // of each row of the picture, from below
  Image empty_;                  // nothing but background
  PixelBox box_;
  Target samples_;
  std::optional<Target> resolved_;   // absent with one sample per pixel
  std::vector<std::uint16_t> rgba_;  // of the box, rows from below
};

}  // namespace drape
