#pragma once

#include <string>
#include <vector>

#include "drape/scene/scene.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::test {

/// A folder for a test's scene files.
class SceneFolder : public ScratchFolder {
 public:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    return put(folder_ / name, text);
  }

  [[nodiscard]] LoadedScene load(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return load_scene(write("scene.toml", text), overrides);
  }

  /// Returns a scene's errors without the folder's name: "scene.toml:1:1: missing table [cloth]"; or "(no error)".
  [[nodiscard]] std::string problems(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return without_folder(usage_error([&] { static_cast<void>(load(text, overrides)); }));
  }

  [[nodiscard]] std::string without_folder(std::string text) const {
    const std::string prefix = folder_.string() + "/";
    for (std::size_t at = 0; (at = text.find(prefix, at)) != std::string::npos;) text.erase(at, prefix.size());
    return text;
  }
};

/// A minimal scene of five lines, which tests extend. Not inline, like all such texts: each file has its own,
/// initialised before the texts that the file makes of it.
const std::string least_scene =
    "[cloth]\n"
    "mesh = { grid = [2, 2] }\n"
    "stiffness = 10\n"
    "[time]\n"
    "step = 0.01\n";

/// Returns a complete scene with one line of a table, which is line 5.
inline std::string with(const std::string& table, const std::string& line) {
  const std::string text = "[cloth]\nmesh = { grid = [2, 2] }\nstiffness = 10\n";
  return text + (table == "cloth" ? "" : "[" + table + "]") + "\n" + line + "\n";
}

/// A cloth that swings from one corner, in ten steps; tests add tables.
const std::string swinging_cloth =
    "[cloth]\n"
    "mesh = { grid = [6, 6] }\n"
    "stiffness = 50\n"
    "pins = [\"corner:x-y-\"]\n"
    "[time]\n"
    "step = 0.02\n"
    "duration = 0.2\n"
    "[effects.gravity]\n";

}  // namespace drape::test
