#pragma once

#include <cstdint>
#include <filesystem>

#include "render/encode/gif_palette.hpp"
#include "render/encode/libav.hpp"

namespace drape {

/// Writes the file of an animated GIF: FFmpeg's paletteuse, gif encoder and gif muxer in a row. Of each frame only the
/// rectangle that has changed is stored, and within it the pixels that have not are transparent.
class GifWriter {
 public:
  /// @param file           to write to, by name
  /// @param name           of the file in messages
  /// @param last_duration  how long the last frame is shown [1/100 s]
  /// @throws OutputError
  GifWriter(const std::filesystem::path& file, std::string name, int width, int height, const GifPalette& palette,
            std::int64_t last_duration);

  /// @param frame  in RGB32, see libav::rgb32_frame
  /// @param start  when it is shown [1/100 s]
  void add(libav::Frame frame, std::int64_t start);

  /// Completes and closes the file.
  void finish();

 private:
  void encode_filtered();
  void encode(const AVFrame* frame);
  void checked(int result) const;

  std::string name_;
  libav::FilterGraph graph_;
  libav::Codec codec_;
  libav::Format format_;
  libav::Packet packet_;
};

}  // namespace drape
