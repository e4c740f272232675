#include "output/format.hpp"

namespace drape {

const std::vector<Triangle>& FilmInfo::triangles() const {
  static const std::vector<Triangle> none;
  return cloth != nullptr ? cloth->triangles : none;
}

const std::vector<std::array<float, 2>>& FilmInfo::texture_coordinates() const {
  static const std::vector<std::array<float, 2>> none;
  return uvs != nullptr ? *uvs : none;
}

bool OutputFormat::drawn() const {
  return std::holds_alternative<FilmMaker<Image>>(make) || std::holds_alternative<FrameMaker<Image>>(make);
}

bool OutputFormat::file_per_frame() const {
  return std::holds_alternative<FrameMaker<Image>>(make) || std::holds_alternative<FrameMaker<Frame>>(make);
}

}  // namespace drape
