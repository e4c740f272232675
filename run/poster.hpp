#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/format.hpp"
#include "output/poster_frame.hpp"

namespace drape {

/// A film's poster: the picture of its PosterFrame.
class Poster {
 public:
  explicit Poster(const FilmInfo& film) : frames_(film.triangles()) {}

  void see(const Frame& frame, const Image& image);

  /// Returns the poster; absent until the first frame was seen.
  [[nodiscard]] const std::optional<Image>& image() const { return image_; }
  [[nodiscard]] int frame() const { return frame_; }

 private:
  PosterFrame frames_;
  std::optional<Image> image_;
  int frame_ = 0;
};

/// Returns the names of the posters of these outputs: "film.poster.png" beside each film that is drawn.
std::vector<std::string> poster_files(const std::vector<std::string>& outputs, const FilmInfo& film);

}  // namespace drape
