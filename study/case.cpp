#include "study/case.hpp"

#include <fmt/format.h>

namespace drape {

Scene StudyCase::load() const { return load_scene(data_folder() / scene, overrides); }

std::string StudyCase::command() const {
  std::string text = "drape simulate " + scene;
  for (const std::string& value : overrides) text += " --set " + value;
  return text + fmt::format(" --steps {}", steps);
}

}  // namespace drape
