#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <opencv2/core/types.hpp>
#include <string>

#include "output/codecs/codecs.hpp"

namespace drape {

/// Implements Codecs::begin_animation for WebP.
///
/// Each frame rewrites, with lossy compression, the moved pixels that are wrong in the viewer's picture. Pixels that
/// rest for five frames must be within 2 of 255: wrong ones are compressed again, and losslessly if that fails.
/// libwebp's WebPAnimEncoder compares frames as drawn, not as seen, so small changes accumulate: a passing shadow
/// leaves bars.
AnimationPen begin_webp(const std::string& file, double fps, cv::Size size);

/// An animated WebP file that repeats for ever (RFC 9649). Each of its frames changes a rectangle.
class WebpFile {
 public:
  /// @throws std::runtime_error with the reason if it cannot be written
  WebpFile(const std::string& file, cv::Size size);

  /// Shows a frame on top of the previous ones, until the next begins.
  /// @param still bytes of a WebP file; its transparent pixels keep the previous picture
  /// @param place rectangle of the frame; its corner has even coordinates
  /// @param begin [ms]
  void show(const std::string& still, const cv::Rect& place, std::int64_t begin);

  /// Returns when the current frame began [ms].
  [[nodiscard]] std::int64_t last_begin() const { return begin_; }

  /// Ends the last frame and completes the file.
  void finish(std::int64_t end);

 private:
  void write_frame(std::int64_t end);
  void put(const std::string& bytes);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> stream_;
  std::string frame_;  // chunks of the current frame
  cv::Rect place_;
  std::int64_t begin_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace drape
