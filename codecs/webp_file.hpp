#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <opencv2/core/types.hpp>
#include <string>

namespace drape {

/// The file of an animated WebP that repeats for ever (RFC 9649): frames, of which each changes a rectangle.
class WebpFile {
 public:
  /// @throws std::runtime_error why it cannot be written
  WebpFile(const std::string& file, cv::Size size);

  /// Shows a frame over those before it, until the next begins.
  /// @param still the bytes of a WebP file of its own; what is transparent in it stays
  /// @param place of it; its corner has even numbers
  /// @param begin [ms]
  void show(const std::string& still, const cv::Rect& place, std::int64_t begin);

  /// When the frame that is shown began [ms].
  [[nodiscard]] std::int64_t last_begin() const { return begin_; }

  /// Ends the last frame, and completes the file.
  void finish(std::int64_t end);

 private:
  void write_frame(std::int64_t end);
  void put(const std::string& bytes);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> stream_;
  std::string frame_;  // the chunks of that which is shown
  cv::Rect place_;
  std::int64_t begin_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace drape
