#pragma once

#include <cstdint>
#include <string>

#include "core/atomic_file.hpp"
#include "output/format.hpp"
#include "output/gif/frame_spool.hpp"

namespace drape {

/// A film of at most so many bytes: its pictures are kept until the last one is there, and then encoded at one size and
/// rate after the other, to find what fits. It plays for as long, with every n-th of its pictures.
///
/// Its pictures become smaller first, down to half their width; then their rate, down to 10 in a second, at half the
/// width or more; then their size again. Of what may not change the other alone does. The width that is found is one
/// that fits where one that is a hundredth larger, or a pixel, does not; the rate is the first that does. They depend
/// on nothing but the pictures.
class SizeLimitedEncoder final : public Encoder {
 public:
  /// @param make what makes the film's encoder, at any size
  /// @param film with its largest size
  /// @throws Error as `make`
  SizeLimitedEncoder(FilmMaker<Image> make, const std::filesystem::path& file, const FilmInfo& film);

  void add(const Image& image) override;

  /// @throws OutputError also if nothing fits
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  /// A film of every so many-th picture, and what it takes.
  struct Trial {
    int width, stride;
    std::uint64_t bytes;
  };
  [[nodiscard]] int height_of(int width) const;
  [[nodiscard]] bool fits(const Trial& trial) const { return trial.bytes <= limit_.bytes; }
  /// Encodes the film, and keeps it if it fits.
  Trial encode(int width, int stride);
  /// @returns what is kept
  Trial find_largest();
  /// The first stride from a trial's on, up to `most`, with which its width fits, or the last one that was tried.
  Trial find_stride(Trial trial, int most);
  /// The largest width from `least` on that fits, or that one.
  Trial find_width(int stride, int least);
  /// "240x200 pixels instead of 480x400 and 10 frames per second instead of 20".
  [[nodiscard]] std::string changes(const Trial& kept) const;
  [[noreturn]] void fail(const Trial& smallest) const;

  FilmMaker<Image> make_;
  const FilmInfo film_;
  const FileLimit limit_;
  PartialFile file_;
  gif::FrameSpool spool_;
  int width_ = 0, height_ = 0;  // of the pictures
};

}  // namespace drape
