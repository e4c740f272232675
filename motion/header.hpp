#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motion/step_row.hpp"

namespace drape {

/// Which steps of a motion have their states in its file. The first and the last one always have.
struct RecordedSteps {
  std::optional<std::int64_t> every =
      1;  ///< those of numbers that it divides; absent: those that the film's frames need
};

/// What a motion file says of its motion.
struct MotionHeader {
  std::string program = {};             ///< which wrote it: "0.1.0 (3f2a…)"
  std::string name = {};                ///< of the scene
  std::string scene = {};               ///< see PortableScene
  std::vector<std::string> files = {};  ///< that it names
  std::string physics = {};             ///< see physics_hash()
  double step = 0;                      ///< h [s]
  std::int64_t steps = 0;               ///< that there are when it is complete
  RecordedSteps recorded = {};
  int vertices = 0, triangles = 0;
  bool textured = false;                    ///< whether the cloth has texture coordinates
  std::vector<std::string> colliders = {};  ///< their kinds: "sphere", "ground", "body"
  bool imported = false;                    ///< it was made elsewhere: its scene is what is drawn, and has no physics
};

/// What a header says of this program.
std::string this_program();

/// As the payload of a block.
std::string pack_header(const MotionHeader& header);
/// The inverse. @throws std::invalid_argument, see packing.hpp
MotionHeader unpack_header(std::string_view payload);

/// The kinds that a header says.
std::vector<std::string> collider_kinds(const std::vector<Collider>& colliders);

/// Rows of consecutive steps, likewise.
std::string pack_rows(const std::vector<StepRow>& rows);
std::vector<StepRow> unpack_rows(std::string_view payload, const MotionHeader& header);

/// A cloth's triangles and its texture coordinates, as in Mesh, likewise.
std::string pack_surface(const std::vector<Triangle>& triangles, const std::vector<std::array<float, 2>>& uvs);

// The tags of blocks, in the order in which a file has them; states and rows alternate.
inline constexpr const char* header_tag = "HEAD";
inline constexpr const char* file_tag = "FILE";
inline constexpr const char* mesh_tag = "MESH";
inline constexpr const char* state_tag = "STAT";
inline constexpr const char* rows_tag = "ROWS";
inline constexpr const char* index_tag = "INDX";
inline constexpr const char* motion_magic = "drape recorded motion 1\n";
inline constexpr const char* motion_end = "drapeend";

/// States are foretold from those before them in groups of as many.
inline constexpr std::size_t states_in_group = 32;
/// So many rows are in a block, or fewer in the last.
inline constexpr std::size_t rows_in_block = 1024;

}  // namespace drape
