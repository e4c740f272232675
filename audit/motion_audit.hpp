#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "audit/stuck.hpp"
#include "audit/surface.hpp"
#include "sim/collider.hpp"

namespace drape::audit {

/// Checks of a motion's states and of the straight ways between them.
enum class Check {
  crossings,  ///< pairs of triangles that cross, of the cloth with itself and with bodies
  ways,       ///< pairs of features that meet on their straight ways from the state before
  inside,     ///< vertices inside closed bodies and spheres and under grounds
  stretch,    ///< edges longer than a limit
  stuck       ///< vertices that stand still while others fall
};
inline constexpr std::size_t check_count = 5;

/// Limits beyond which something is a finding.
struct AuditLimits {
  double stretch = HUGE_VAL;  ///< of an edge's length to that at rest
  double depth = 1e-3;        ///< of a vertex in a solid [m]
};

/// The mesh that is audited, and what is known of it beside its motion.
struct AuditedCloth {
  Vertices rest;  ///< n×3 [m]
  std::vector<Triangle> triangles;
  Held held;
  Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();  ///< see StuckWatch
};

/// A state of a motion.
struct AuditedState {
  std::int64_t step = 0;
  double time = 0;  ///< [s]
  const Vertices& x;
  const std::vector<Collider>& colliders;  ///< at that time, always as many of the same kinds
};

/// The state in which a check finds most: most pairs or vertices, the greatest depth or stretch.
struct WorstState {
  std::int64_t step = 0;
  double time = 0;            ///< [s]
  std::size_t count = 0;      ///< of findings in it
  double value = 0;           ///< the greatest depth [m] or stretch; elsewhere the count
  std::string text;           ///< the worst of them: "cloth edge 3 4 is stretched to 1.2"
  std::vector<int> vertices;  ///< of the cloth that take part, ascending
  Vertices x;                 ///< where the cloth is
  std::vector<Collider> colliders;
};

/// Findings of a check in all states.
struct CheckFindings {
  std::int64_t states = 0;  ///< in which it found something
  std::int64_t first = 0;   ///< step of the first of them
  double first_time = 0;    ///< [s]
  std::size_t touches = 0;  ///< of ways: those that end or begin in a touch, which are no findings
  double largest = 0;       ///< the greatest depth [m] or stretch of all states, also below the limit
  WorstState worst;
};

/// Audits the states of a motion one after another, in memory that does not depend on their number.
class MotionAudit {
 public:
  /// @throws std::invalid_argument if a triangle is not one of the rest shape's vertices
  MotionAudit(AuditedCloth cloth, const AuditLimits& limits);

  /// Takes the next state.
  /// @throws std::invalid_argument naming the vertex if a position is not finite, or if there are more or fewer than at
  ///         rest
  void add(const AuditedState& state);

  [[nodiscard]] const CheckFindings& findings(Check check) const { return found_[static_cast<std::size_t>(check)]; }
  [[nodiscard]] std::int64_t states() const { return states_; }
  /// True where no check has found anything.
  [[nodiscard]] bool clean() const;

 private:
  struct Finding {
    std::size_t count = 0;
    double value = 0;
    std::string text;
    std::vector<int> vertices;
  };

  void note(Check check, const AuditedState& state, Finding finding);
  [[nodiscard]] Finding crossings(const AuditedState& state) const;
  [[nodiscard]] Finding ways(const AuditedState& state);
  [[nodiscard]] Finding inside(const AuditedState& state);
  [[nodiscard]] Finding stretched(const AuditedState& state);

  AuditedCloth cloth_;
  AuditLimits limits_;
  std::unique_ptr<const Topology> topology_;  // which others refer to
  StuckWatch stuck_;
  std::vector<Topology> bodies_;  // as the colliders; empty for those that are no meshes
  std::vector<char> closed_;
  std::int64_t states_ = 0;
  Vertices before_;
  std::vector<Collider> colliders_before_;
  std::array<CheckFindings, check_count> found_;
};

}  // namespace drape::audit
