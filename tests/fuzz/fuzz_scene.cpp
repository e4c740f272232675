// Scene files. The reader takes a file, so every input is written to one, in a folder that is removed at the end.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "drape/scene/scene.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"

namespace {

class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("drape-fuzz-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
    std::ofstream(path_ / "a.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] std::filesystem::path scene() const { return path_ / "scene.toml"; }

 private:
  std::filesystem::path path_;
};

/// Returns true for a huge grid: four million cells are allowed, but making them wastes a fuzzer's time.
bool takes_long(const std::string& text) {
  static const std::regex large_grid("grid\\s*=\\s*\\[[^\\]]*[0-9_xob]{3}");
  return std::regex_search(text, large_grid);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const std::string text(data, data + size);
  if (takes_long(text)) return -1;
  std::ofstream(folder.scene(), std::ios::binary | std::ios::trunc) << text;
  drape::accepts_or_refuses([&] {
    const drape::Scene scene = drape::load_scene(folder.scene());
    if (!scene.simulation.cloth.positions.allFinite() || !scene.simulation.cloth.velocities.allFinite()) std::abort();
  });
  return 0;
}
