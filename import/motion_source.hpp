#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/energies.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// A moment of an imported motion.
struct ImportedMoment {
  Vertices x;       ///< n×3 [m]
  Vertices v = {};  ///< n×3 [m/s]; empty if unknown
  std::optional<Energies> energies = {};
};

/// Positions of spheres or planes in each moment.
struct ImportedShapes {
  /// Four numbers for each moment and each shape: centre and radius, or normal and height. Empty: no shapes.
  std::vector<std::vector<Eigen::Vector4d>> by_moment = {};
};

class MotionSource;

/// Objects beside the cloth in an imported file.
struct ImportedColliders {
  ImportedShapes spheres = {}, grounds = {};
  std::vector<std::shared_ptr<MotionSource>> bodies = {};
};

/// A motion in a file or files, read one moment at a time. Errors in the files are UsageErrors that name the file.
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  /// Returns the name of the file or files, for messages.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Returns the mesh at the first moment.
  [[nodiscard]] virtual const Mesh& mesh() const = 0;
  /// Returns the number of moments, at least 1.
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// Returns the times of the moments [s]; empty if they are unknown before reading.
  [[nodiscard]] virtual std::vector<double> times() { return {}; }
  /// Returns the i-th moment. Callers request each moment once, in order.
  /// @throws UsageError if it is incomplete or non-finite, or the number of vertices or the triangles have changed
  [[nodiscard]] virtual ImportedMoment moment(std::size_t i) = 0;
  /// Returns rest positions [m], if known.
  [[nodiscard]] virtual std::optional<Vertices> rest() { return std::nullopt; }
  /// Returns the frames per second of the film, if known.
  [[nodiscard]] virtual std::optional<double> fps() { return std::nullopt; }
  [[nodiscard]] virtual ImportedColliders colliders() { return {}; }
};

/// @throws UsageError "name: …" naming the vertex, if a coordinate is non-finite or beyond 10¹⁰⁰ m
void require_finite(const std::string& name, const Vertices& x);

/// Throws a UsageError that names the file.
[[noreturn]] void fail_import(const std::string& name, const std::string& message);

}  // namespace drape
