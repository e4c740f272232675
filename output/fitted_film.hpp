#pragma once

#include <cstdint>

#include "core/atomic_file.hpp"
#include "output/format.hpp"
#include "output/gif/frame_spool.hpp"

namespace drape {

/// A film of at most so many bytes: its pictures are kept until the last one is there, and then encoded at one size
/// after the other, to find the largest that fits. It keeps its frames and their rate. The size that is found is one
/// that fits where one that is a hundredth wider, or a pixel, does not; it depends on nothing but the pictures.
class FittedFilm final : public Encoder {
 public:
  /// @param make what makes the film's encoder, at any size
  /// @param film with its largest size [bytes]
  /// @throws Error as `make`
  FittedFilm(FilmMaker<Image> make, const std::filesystem::path& file, const FilmInfo& film);

  void add(const Image& image) override;

  /// @throws OutputError also if no size fits
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  struct Trial {
    int width;
    std::uint64_t bytes;
  };
  [[nodiscard]] int height_of(int width) const;
  /// Encodes the film at a size, and keeps it if it fits.
  Trial encode(int width);
  /// @returns the width of what is kept
  int find_largest();

  FilmMaker<Image> make_;
  FilmInfo film_;
  std::uint64_t largest_;
  PartialFile file_;
  gif::FrameSpool spool_;
  int width_ = 0, height_ = 0;  // of the pictures
};

}  // namespace drape
