#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "import/sources.hpp"
#include "run/progress.hpp"

namespace drape {

/// Options for importing a motion.
struct ImportOptions {
  std::vector<std::string> cloths = {};  ///< files or sequences, at least one; several become one mesh
  std::vector<std::string> bodies = {};  ///< files or sequences, each a separate body
  std::string mesh = {}, prim = {};      ///< see open_motion_source()
  ImportAxes axes = {};
  std::optional<double> fps = {};  ///< frames per second; absent: the times in the files, otherwise 25
};

/// Properties of an imported motion.
struct ImportedMotion {
  std::int64_t frames = 0;
  double step = 0;  ///< frame interval [s]
  int vertices = 0, triangles = 0, bodies = 0;
  std::uint64_t size = 0;  ///< file size [bytes]
};

/// Imports a motion into a motion file without physics: velocities that the files lack are differences of positions,
/// energies are 0. Memory holds three moments of the cloth and all of moving bodies.
/// @param file name ending in .drape
/// @throws UsageError  naming the faulty input
/// @throws OutputError if the file cannot be written
/// @throws Interrupted if a stop is requested; no file remains
ImportedMotion import_motion(const ImportOptions& options, const std::filesystem::path& file,
                             const std::stop_token& stop, Progress& progress);

}  // namespace drape
