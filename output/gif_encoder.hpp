#pragma once

#include <functional>

#include "core/atomic_file.hpp"
#include "output/format.hpp"
#include "output/gif/color_histogram.hpp"
#include "output/gif/frame_spool.hpp"

namespace drape {

/// An animated GIF of 256 colours that repeats for ever. Frame k is shown from round(100·k/fps) to round(100·(k+1)/fps)
/// hundredths of a second, the unit of the format, so that rounding errors do not accumulate.
///
/// Processes the film twice, because colours are known only after the last frame: add() counts colours and stores the
/// frame on disk, finish() encodes. Its memory is independent of the number of frames.
class GifEncoder : public Encoder {
 public:
  /// @throws UsageError if fps is not within 0.01 … 50
  GifEncoder(const std::filesystem::path& file, double fps, std::function<void(int, int)> progress);

  void add(const Image& image) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  [[nodiscard]] std::int64_t start(int frame) const;  // [1/100 s]
  void encode();

  double fps_;
  PartialFile file_;
  std::function<void(int, int)> progress_;
  gif::FrameSpool spool_;
  gif::ColorHistogram colors_;
};

OutputFormat gif_format();

}  // namespace drape
