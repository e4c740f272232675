#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/format.hpp"

namespace drape {

/// The one picture of a film that tells most of it: of the frame in which the cloth is bent most, by the angles between
/// neighbouring triangles, each as much as their edge is long. Of several such frames it is the first.
class Poster {
 public:
  explicit Poster(const FilmInfo& film);

  void see(const Frame& frame, const Image& image);

  /// Absent as long as nothing was seen.
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

/// Where the posters of these outputs go: "film.poster.png" beside each film that is drawn.
std::vector<std::string> poster_files(const std::vector<std::string>& outputs, const FilmInfo& film);

}  // namespace drape
