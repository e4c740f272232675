#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/energies.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// A moment of a motion that was made elsewhere.
struct ImportedMoment {
  Vertices x;       ///< n×3 [m]
  Vertices v = {};  ///< n×3 [m/s]; empty where the file does not say it
  std::optional<Energies> energies = {};
};

/// Spheres, or planes, that are at a place in each moment.
struct ImportedShapes {
  /// For each moment and each shape four numbers: centre and radius, or normal and height. Empty: there is none.
  std::vector<std::vector<Eigen::Vector4d>> by_moment = {};
};

class MotionSource;

/// Things around a cloth that a file holds beside its motion.
struct ImportedColliders {
  ImportedShapes spheres = {}, grounds = {};
  std::vector<std::shared_ptr<MotionSource>> bodies = {};
};

/// A motion in a file or files, read a moment at a time. All that is wrong with the files is a UsageError that names
/// the file.
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  /// The name of the file or files, for messages.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// The mesh at the first moment.
  [[nodiscard]] virtual const Mesh& mesh() const = 0;
  /// The number of moments, at least 1.
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// The times of the moments [s], as far as they are known before they are read; empty: the file does not say them.
  [[nodiscard]] virtual std::vector<double> times() { return {}; }
  /// The i-th moment. They are asked for in order, each once.
  /// @throws UsageError if it is cut short, has another number of vertices or other triangles, or is not finite
  [[nodiscard]] virtual ImportedMoment moment(std::size_t i) = 0;
  /// Positions at rest [m], where the file says them.
  [[nodiscard]] virtual std::optional<Vertices> rest() { return std::nullopt; }
  /// The frames per second of the film, where the file says it.
  [[nodiscard]] virtual std::optional<double> fps() { return std::nullopt; }
  [[nodiscard]] virtual ImportedColliders colliders() { return {}; }
};

/// @throws UsageError "name: …" naming the vertex, if one is not finite or beyond 10¹⁰⁰ m
void require_finite(const std::string& name, const Vertices& x);

/// Names the file in the messages of readers.
[[noreturn]] void fail_import(const std::string& name, const std::string& message);

}  // namespace drape
