#include "study/case.hpp"

#include <fmt/format.h>

#include "core/shell.hpp"

namespace drape {
namespace {

std::string arguments(const StudyCase& what) {
  std::string text = shell_file(what.scene);
  for (const std::string& value : what.overrides) text += " --set " + shell_word(value);
  return text + fmt::format(" --steps {}", what.steps);
}

}  // namespace

Scene StudyCase::load() const { return load_scene((folder.empty() ? data_folder() : folder) / scene, overrides); }

std::string StudyCase::command() const { return "drape simulate " + arguments(*this); }

std::string StudyCase::film_command(const std::string& film) const {
  return "drape render " + arguments(*this) + " -o " + shell_word(film);
}

std::string plain_number(double value) { return fmt::format("{}", value); }

}  // namespace drape
