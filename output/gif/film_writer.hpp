#pragma once

#include <cstdint>

#include "core/atomic_file.hpp"
#include "output/gif/compactor.hpp"
#include "output/gif/container.hpp"
#include "output/gif/ordered_dither.hpp"
#include "output/gif/palette.hpp"
#include "render/image.hpp"

namespace drape::gif {

/// Writes the frames of a film to a GIF.
///
/// A film may take 0.14 bytes per pixel and frame, which is 5.6 MB for 209 frames of 480×400. The more it is beyond
/// that, the more freedom the Compactor gets; a film that needs less is not touched.
class FilmWriter {
 public:
  /// @param file  has to outlive it
  /// @throws OutputError
  FilmWriter(PartialFile& file, int width, int height, const Palette& palette);

  /// @param duration  how long it is shown [1/100 s]
  void add(const Image& image, std::int64_t duration);

  /// Completes the file.
  void finish() { container_.finish(); }

 private:
  [[nodiscard]] int tolerance() const;

  OrderedDither dither_;
  Compactor compactor_;
  Container container_;
  double bytes_per_frame_;  // that are allowed
  double debt_ = 0;         // bytes that the frames up to now have taken beyond that; negative: saved
};

}  // namespace drape::gif
