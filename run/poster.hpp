#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/format.hpp"

namespace drape {

/// A film's poster: the first of the frames in which the cloth is bent most. Bending is the sum of the angles between
/// neighbouring triangles, weighted by edge length.
class Poster {
 public:
  explicit Poster(const FilmInfo& film);

  void see(const Frame& frame, const Image& image);

  /// Returns the poster; absent until the first frame was seen.
  [[nodiscard]] const std::optional<Image>& image() const { return image_; }
  [[nodiscard]] int frame() const { return frame_; }

 private:
  [[nodiscard]] double bend(const Vertices& x) const;

  struct Hinge {
    std::array<int, 2> edge, opposite;
  };
  std::vector<Hinge> hinges_;
  std::optional<Image> image_;
  double most_ = -1;
  int frame_ = 0;
};

/// Returns the names of the posters of these outputs: "film.poster.png" beside each film that is drawn.
std::vector<std::string> poster_files(const std::vector<std::string>& outputs, const FilmInfo& film);

}  // namespace drape
