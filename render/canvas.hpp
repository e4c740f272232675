#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drape/render/image.hpp"
#include "drape/render/settings.hpp"
#include "render/gl/program.hpp"
#include "render/outline.hpp"
#include "render/shot.hpp"

namespace drape {

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

}  // namespace drape
