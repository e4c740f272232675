#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/files.hpp"
#include "output/gif/compactor.hpp"
#include "output/gif/palette.hpp"
#include "output/registry.hpp"

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

/// A film on a page as the bytes of its files: a looping GIF, and for print some of its frames in a PNG.
struct PageFilm {
  std::string gif, stills;
};

/// The frames of a page's film, and how its stills are arranged, see montage().
struct PageFrames {
  std::size_t count = 0;                            ///< at least one
  std::size_t first = 0;                            ///< where the loop begins: a page shows it until it plays
  std::function<Image(std::size_t frame)> picture;  ///< called once for each frame, from the first one on
  int columns = 1, gap = 0;
  std::uint8_t gray = 255;
};

/// Writes the GIF of a page's film, and returns it with its stills: those of html::printed_moments().
/// @throws OutputError, and what picture() throws: then no file is written
PageFilm write_page_film(const std::filesystem::path& gif, double fps, const PageFrames& frames);

/// A film of limited file size. It keeps all pictures until the last is added, then encodes them at several sizes and
/// rates to find the largest film that fits. Its duration is unchanged: it plays every n-th picture.
///
/// Pictures shrink first, down to half their width; then the rate falls, down to 10 per second, at half the width or
/// more; then pictures shrink further. FilmKeeps excludes one of the two. The width is maximal to one percent, or one
/// pixel; the rate is the first that fits. The result depends only on the pictures.
class SizeLimitedEncoder final : public Encoder {
 public:
  /// @param make maker of the film's encoder at any size
  /// @param film film with a limit for its file
  /// @throws Error as `make`
  SizeLimitedEncoder(FilmMaker<Image> make, const std::filesystem::path& file, const FilmInfo& film);

  void add(const Image& image) override;

  /// @throws OutputError also if nothing fits
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  /// A film of every `stride`-th picture, and its size.
  struct Trial {
    int width, stride;
    std::uint64_t bytes;
  };
  [[nodiscard]] int height_of(int width) const;
  [[nodiscard]] bool fits(const Trial& trial) const { return trial.bytes <= limit_.bytes; }
  /// Encodes the film, and keeps the file if it fits.
  Trial encode(int width, int stride);
  /// Finds the best film. @returns the kept trial
  Trial find_largest();
  /// Finds the first stride from a trial's to `most` with which its width fits; otherwise returns the last trial.
  Trial find_stride(Trial trial, int most);
  /// Finds the largest width from `least` on that fits; otherwise returns `least`.
  Trial find_width(int stride, int least);
  /// Returns "240x200 pixels instead of 480x400 and 10 frames per second instead of 20".
  [[nodiscard]] std::string changes(const Trial& kept) const;
  [[noreturn]] void fail(const Trial& smallest) const;

  FilmMaker<Image> make_;
  const FilmInfo film_;
  const FileLimit limit_;
  PartialFile file_;
  gif::FrameSpool spool_;
  int width_ = 0, height_ = 0;  // of the added pictures
};

}  // namespace drape
