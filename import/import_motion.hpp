#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "import/sources.hpp"
#include "run/progress.hpp"

namespace drape {

/// How a motion that was made elsewhere is read.
struct ImportOptions {
  std::vector<std::string> cloths = {};  ///< files or sequences, at least one; several become one mesh
  std::vector<std::string> bodies = {};  ///< likewise, each a body of its own
  std::string mesh = {}, prim = {};      ///< see open_motion_source()
  ImportAxes axes = {};
  std::optional<double> fps = {};  ///< frames per second; absent: the times that the files say, or else 25
};

/// A motion that has been imported.
struct ImportedMotion {
  std::int64_t frames = 0;
  double step = 0;  ///< from a frame to the next [s]
  int vertices = 0, triangles = 0, bodies = 0;
  std::uint64_t size = 0;  ///< of the file [bytes]
};

/// Reads a motion and writes it as a motion file without physics: velocities that the files do not say are differences
/// of positions, energies are 0. Of the cloth, three moments are in memory; of moving bodies all.
/// @param file ending in .drape
/// @throws UsageError  naming the input that is wrong
/// @throws OutputError if the file cannot be written
/// @throws Interrupted if a stop is requested; nothing is left then
ImportedMotion import_motion(const ImportOptions& options, const std::filesystem::path& file,
                             const std::stop_token& stop, Progress& progress);

}  // namespace drape
