#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>

#include "output/gif_compactor.hpp"
#include "output/gif_palette.hpp"
#include "output/libav.hpp"

namespace drape {

/// Writes the file of an animated GIF: FFmpeg's paletteuse, gif encoder and gif muxer in a row. Of each frame only the
/// rectangle that has changed is stored, and within it the pixels that have not are transparent.
///
/// A film may take 0.14 bytes per pixel and frame, which is 5.6 MB for 209 frames of 480×400. The more it is beyond
/// that, the more freedom the GifCompactor gets; a film that needs less is not touched.
class GifWriter {
 public:
  /// @param file           to write to, by name
  /// @param name           of the file in messages
  /// @param last_duration  how long the last frame is shown [1/100 s]
  /// @throws OutputError
  GifWriter(const std::filesystem::path& file, std::string name, int width, int height, const GifPalette& palette,
            std::int64_t last_duration);

  /// @param start  when it is shown [1/100 s]
  void add(const Image& image, std::int64_t start);

  /// Completes and closes the file.
  void finish();

 private:
  void encode_filtered();
  [[nodiscard]] int tolerance() const;
  void encode(const AVFrame* frame);
  void checked(int result) const;

  std::string name_;
  OrderedDither dither_;
  libav::FilterGraph graph_;
  std::deque<Image> sources_;  // of the frames inside the graph
  GifCompactor compactor_;
  libav::Codec codec_;
  libav::Format format_;
  libav::Packet packet_;
  double bytes_per_frame_;  // that are allowed
  double debt_ = 0;         // bytes that the frames up to now have taken beyond that; negative: saved
};

}  // namespace drape
