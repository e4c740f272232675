#include "output/format.hpp"

namespace drape {

bool OutputFormat::drawn() const {
  return std::holds_alternative<FilmMaker<Image>>(make) || std::holds_alternative<FrameMaker<Image>>(make);
}

bool OutputFormat::file_per_frame() const {
  return std::holds_alternative<FrameMaker<Image>>(make) || std::holds_alternative<FrameMaker<Frame>>(make);
}

}  // namespace drape
