#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "motion/reader.hpp"
#include "motion/writer.hpp"
#include "tests/support/opened_blocks.hpp"

namespace drape {

/// A folder of this process, removed at its end.
class FuzzFolder {
 public:
  FuzzFolder() { std::filesystem::create_directories(path_); }
  ~FuzzFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FuzzFolder(const FuzzFolder&) = delete;
  FuzzFolder& operator=(const FuzzFolder&) = delete;

  std::filesystem::path put(const std::string& name, std::string_view bytes) const {
    std::ofstream(path_ / name, std::ios::binary | std::ios::trunc) << bytes;
    return path_ / name;
  }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return path_ / name; }
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ifstream stream(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }

 private:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() / ("drape-fuzz-" + std::to_string(getpid()));
};

/// A small complete motion and its earlier form: the growing file with its checkpoint, with all parts.
struct SealedMotion {
  std::string complete, growing, checkpoint;

  explicit SealedMotion(const FuzzFolder& folder) {
    const LoadedScene scene = load_scene(folder.put("scene.toml",
                                                    "[cloth]\nmesh = { grid = [1, 1] }\nstiffness = 10\n[time]\nstep = "
                                                    "0.01\nduration = 0.05\n[effects.gravity]\n"));
    MotionFileWriter writer(folder.path("made.drape"), {.steps = 5}, scene);
    Simulation::Checkpoint last;
    State& state = last.state;
    state = {scene.simulation.cloth.positions, scene.simulation.cloth.velocities, 0};
    for (std::int64_t step = 0; step <= 5; ++step) {
      state.step = step;
      state.x.array() += 0.01;
      StepRow row;
      row.step = step;
      row.energies = {.kinetic = 0.1, .gravity = 0.2, .elastic = 0.3};
      writer.add(row);
      writer.add(state);
      if (step != 4) continue;
      last.energy_memory = EnergyMemory{1, state.x, 2, 3};
      state.restraint = {.acceleration = state.v, .tensions = Eigen::VectorXd::Ones(5)};
      state.contact_forces = {{.key = {0, 1, 2, 3, 0, 1}, .force = {0, 0, 1}}};
      state.substeps = 6;
      writer.keep(last, std::vector<float>(4, 10.0F));
      growing = folder.content("made.drape.partial");
      checkpoint = folder.content("made.drape.checkpoint");
      state.restraint = {};
      state.contact_forces = {};
      state.substeps = 0;
    }
    writer.finish();
    complete = folder.content("made.drape");
  }
};

/// Edits a file as a fuzzer requests: a block, a two-byte position in it, and the bits to flip in that byte. Restores
/// sizes and checksums.
inline std::string with_edits(std::string_view file, std::string_view edits) {
  constexpr std::size_t most = 64, edit_size = 4;
  test::OpenedBlocks blocks(file);
  for (std::size_t k = 0; k < most && edits.size() >= edit_size; ++k, edits.remove_prefix(edit_size)) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(edits[i]); };
    blocks.change(byte(0), byte(1) + std::size_t{256} * byte(2), byte(3));
  }
  return blocks.sealed();
}

}  // namespace drape
