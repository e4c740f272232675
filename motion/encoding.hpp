#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drape/sim/simulation.hpp"
#include "drape/sim/state.hpp"

namespace drape {

/// Statistics of a step.
struct StepRow {
  std::int64_t step = 0;  ///< 0: the start, which has only energies and colliders
  Energies energies;      ///< at its end [J]
  int iterations = 0;
  bool converged = true;
  bool redone = false;
  std::int64_t substeps = 1;        ///< number of substeps
  std::optional<double> estimate;   ///< estimated error added by the step, if an accuracy is set [m]
  double residual = 0;              ///< ‖∇g‖ at its end [N]
  std::optional<double> error;      ///< estimated error of its solve, if available [m]
  std::vector<Collider> colliders;  ///< at its end, in the scene's order
  std::vector<Energies> cloths;     ///< energies of each of several cloths at its end; empty: unknown [J]
};

/// Selection of the steps whose states are stored. The first and the last one are always stored.
struct RecordedSteps {
  std::optional<std::int64_t> every = 1;  ///< interval in steps; absent: the steps that the film's frames need
};

/// Header of a motion file.
struct MotionHeader {
  std::string program = {};             ///< version of the program that wrote it: "0.1.0 (3f2a…)"
  std::string name = {};                ///< name of the scene
  std::string scene = {};               ///< see PortableScene
  std::vector<std::string> files = {};  ///< names of the files in the scene
  std::string physics = {};             ///< see physics_hash()
  double step = 0;                      ///< h [s]
  std::int64_t steps = 0;               ///< number of steps of the complete motion
  RecordedSteps recorded = {};
  int vertices = 0, triangles = 0;
  bool textured = false;                    ///< true if the cloth has texture coordinates
  std::vector<std::string> colliders = {};  ///< kinds of the colliders: "sphere", "ground", "body"
  std::vector<std::string> cloths = {};     ///< names of several cloths, whose energies the rows have
  bool imported = false;                    ///< made by another program: the scene has only its look, no physics
  bool energies = true;                     ///< false: the energies of the rows are unknown, and stored as 0
};

/// Returns the version of this program, as written to headers.
std::string this_program();

/// Packs a header as the payload of a block.
std::string pack_header(const MotionHeader& header);
/// Unpacks a header. @throws std::invalid_argument, see blocks.hpp
MotionHeader unpack_header(std::string_view payload);

/// Returns the kinds of colliders, as written to headers.
std::vector<std::string> collider_kinds(const std::vector<Collider>& colliders);

/// Packs and unpacks rows of consecutive steps.
std::string pack_rows(const std::vector<StepRow>& rows);
std::vector<StepRow> unpack_rows(std::string_view payload, const MotionHeader& header);

/// Packs the triangles and texture coordinates of a cloth, as in Mesh.
std::string pack_surface(const std::vector<Triangle>& triangles, const std::vector<std::array<float, 2>>& uvs);

// Tags of blocks, in their order in the file; states and rows alternate.
inline constexpr const char* header_tag = "HEAD";
inline constexpr const char* file_tag = "FILE";
inline constexpr const char* mesh_tag = "MESH";
inline constexpr const char* state_tag = "STAT";
inline constexpr const char* rows_tag = "ROWS";
inline constexpr const char* index_tag = "INDX";
inline constexpr const char* motion_magic = "drape recorded motion 1\n";
inline constexpr const char* motion_end = "drapeend";

/// Number of states per group. Within a group, states are predicted from earlier ones.
inline constexpr std::size_t states_in_group = 32;
/// Number of rows per block; the last block may have fewer.
inline constexpr std::size_t rows_in_block = 1024;

/// Lossless codec from states of a motion to bytes: it stores each state as its difference from a prediction by
/// earlier states. docs/reference/motion-file.md describes the format for readers.
class StateCodec {
 public:
  /// @param vertices number of vertices of the cloth
  /// @param step     h [s]
  StateCodec(Eigen::Index vertices, double step) : vertices_(vertices), step_(step) {}

  /// Forgets all earlier states, so that the next one can be decoded alone.
  void begin_group() { known_ = 0; }

  /// Encodes the next state, of a later step than the last one.
  std::string encode(const State& state);

  /// Decodes the next state; valid until the next call.
  /// @throws std::invalid_argument, see blocks.hpp
  const State& decode(std::string_view bytes);

 private:
  static constexpr int most_known = 4;  // number of earlier states used for prediction

  /// Method of prediction: an order of extrapolation, 0 (none) to 4, or for velocities one of these.
  enum Predictor { by_way = 5, by_mean_way = 6 };

  /// Returns the k-th state before the next one, from 1 on.
  [[nodiscard]] const State& before(int k) const {
    return states_[static_cast<std::size_t>((newest_ + 1 + most_known - k) % most_known)];
  }
  [[nodiscard]] std::array<double, most_known> weights(int order, std::int64_t step) const;
  /// Calls use(i, prediction) for every `stride`-th number of a field.
  template <class Use>
  void predict(int how, bool velocities, const State& state, Eigen::Index stride, const Use& use) const;
  [[nodiscard]] int best(bool velocities, const State& state) const;
  /// Returns the storage for the next state, which replaces the oldest.
  State& next_place();

  Eigen::Index vertices_;
  double step_;
  std::array<State, most_known> states_;  // ring buffer
  int newest_ = 0, known_ = 0;
};

}  // namespace drape
