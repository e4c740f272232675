#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::testing {

/// A folder of the running test's own, for scene files that it writes. Deleted with the object.
class SceneFolder {
 public:
  SceneFolder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) /
            (std::string("drape_") + test->test_suite_name() + "_" + test->name() + "_" + std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~SceneFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

  [[nodiscard]] Scene load(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return load_scene(write("scene.toml", text), overrides);
  }

  /// What is wrong with a scene, without the folder's name: "scene.toml:1:1: missing table [cloth]"; or "(no error)".
  [[nodiscard]] std::string problems(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return without_folder(usage_error([&] { static_cast<void>(load(text, overrides)); }));
  }

  [[nodiscard]] std::string without_folder(std::string text) const {
    const std::string prefix = path_.string() + "/";
    for (std::size_t at = 0; (at = text.find(prefix, at)) != std::string::npos;) text.erase(at, prefix.size());
    return text;
  }

 private:
  std::filesystem::path path_;
};

/// The least that a scene must say; a test adds lines. It has five.
inline const std::string least_scene =
    "[cloth]\n"
    "mesh = { grid = [2, 2] }\n"
    "stiffness = 10\n"
    "[time]\n"
    "step = 0.01\n";

}  // namespace drape::testing
