#include "output/beside.hpp"

#include <algorithm>

#include "output/path_template.hpp"

namespace drape {

int frame_digits(const FilmInfo& film) {
  return static_cast<int>(std::to_string(film.first_frame + std::max(1, film.expected_frames) - 1).size());
}

std::string file_beside(const std::filesystem::path& file, const char* beside, const FilmInfo& film, int frame) {
  return (file.parent_path() / file.stem()).string() + PathTemplate(beside).path(film.scene, frame, frame_digits(film));
}

}  // namespace drape
