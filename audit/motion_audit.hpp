#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "audit/crossings.hpp"
#include "audit/touches.hpp"
#include "drape/sim/mesh.hpp"
#include "drape/sim/state.hpp"

namespace drape::audit {

/// Largest rise of a motion's energy beyond the work done on it.
struct EnergyRise {
  double rise = 0;  ///< [J]; infinite for a non-finite energy
  int from = 0;     ///< state of least energy before the rise
  int to = 0;       ///< state at the end of the rise
};

/// Computes the largest rise over the running minimum: max over i < j of Eⱼ − Eᵢ − (W of the steps from i to j).
/// @param energies total energy of every state, including the first [J]
/// @param work     external work in each step, for example by moving obstacles and wind [J]; empty: none
/// @throws std::invalid_argument unless work is empty or one shorter than energies
EnergyRise largest_rise(std::span<const double> energies, std::span<const double> work = {});

/// An edge longer than allowed.
struct StretchedEdge {
  Edge edge = {};
  double stretch = 0;  ///< length over rest length; infinite where the rest length is zero
};

/// Returns for example "cloth edge 3 4 is stretched to 1.2".
std::string describe(const StretchedEdge& stretched);

/// Finds the edges longer than `limit` times their rest length, most stretched first. Non-finite lengths count.
/// @param rest rest positions [m], as many as x
/// @throws std::invalid_argument if rest and x differ in size
std::vector<StretchedEdge> find_stretched(const std::vector<Edge>& edges, const Vertices& rest, const Vertices& x,
                                          double limit);

/// Vertices that may rest: a known set, or all that have not moved yet.
struct Held {
  bool known = false;         ///< false: vertices that have not moved since the first state are held
  std::vector<int> vertices;  ///< known held vertices, such as pins
};

/// Detector of vertices that rest in mid-air while others fall.
///
/// A vertex is stuck if three conditions hold at once:
/// - it has rested for at least two steps: each moved it by at most 10⁻⁹ of a mean edge;
/// - meanwhile, a vertex that shares an edge with it has fallen by a quarter of that edge or more;
/// - it has no support: it is free, and more than half a mean edge away from each collider's contact layer and each
///   cloth triangle without this vertex.
class StuckWatch {
 public:
  /// @param cloth must outlive this
  /// @param rest  rest positions, for the mean edge length [m]
  /// @param down  unit direction of gravity; zero: nothing falls
  StuckWatch(const Topology& cloth, const Vertices& rest, const Held& held, Eigen::Vector3d down);

  /// Processes the next state.
  /// @returns the stuck vertices, ascending
  std::vector<int> add(const Vertices& x, const std::vector<Collider>& colliders);

 private:
  [[nodiscard]] bool supported(int vertex, const Vertices& x, const std::vector<Collider>& colliders) const;

  const Topology& cloth_;
  bool held_known_;
  Eigen::Vector3d down_;
  double mean_edge_ = 0;
  Vertices before_;
  std::vector<char> held_;
  std::vector<int> still_;    // steps without motion
  std::vector<double> fall_;  // fall of the neighbours meanwhile, relative to the edge
};

/// Checks of a motion's states and of the linear paths between them.
enum class Check {
  crossings,  ///< pairs of intersecting triangles, within the cloth and with bodies
  ways,       ///< pairs of features that meet on their linear paths from the previous state
  inside,     ///< vertices inside closed bodies and spheres and under grounds
  stretch,    ///< edges stretched beyond a limit
  stuck       ///< vertices that rest while others fall
};
inline constexpr std::size_t check_count = 5;

/// Limits above which a value is a finding.
struct AuditLimits {
  double stretch = HUGE_VAL;  ///< ratio of an edge's length to its rest length
  double depth = 1e-3;        ///< depth of a vertex in a solid [m]
};

/// The audited mesh and its constant properties.
struct AuditedCloth {
  Vertices rest;  ///< n×3 [m]
  std::vector<Triangle> triangles;
  Held held;
  Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();  ///< see StuckWatch
  std::vector<Edge> sewn = {};                       ///< see Topology
};

/// A state of a motion.
struct MotionState {
  std::int64_t step = 0;
  double time = 0;  ///< [s]
  const Vertices& x;
  const std::vector<Collider>& colliders;  ///< at that time; their number and kinds are constant
};

/// The state with the worst result of a check: most pairs or vertices, greatest depth or stretch.
struct WorstState {
  std::int64_t step = 0;
  double time = 0;            ///< [s]
  std::size_t count = 0;      ///< number of findings
  double value = 0;           ///< greatest depth [m] or stretch; for other checks the count
  std::string text;           ///< description of the worst finding: "cloth edge 3 4 is stretched to 1.2"
  std::vector<int> vertices;  ///< affected vertices of the cloth, ascending
  Vertices x;                 ///< positions of the cloth
  std::vector<Collider> colliders;
};

/// Findings of a check in all states.
struct CheckFindings {
  std::int64_t states = 0;  ///< number of states with findings
  std::int64_t first = 0;   ///< step of the first state with findings
  double first_time = 0;    ///< [s]
  std::size_t touches = 0;  ///< for ways: pairs that touch without passing through each other, which are no findings
  double largest = 0;       ///< greatest depth [m] or stretch of all states, including those below the limit
  WorstState worst;
};

/// Audit of a motion, one state after another, with constant memory.
class MotionAudit {
 public:
  /// @throws std::invalid_argument if a triangle has a vertex outside the rest shape
  MotionAudit(AuditedCloth cloth, const AuditLimits& limits);

  /// Audits the next state.
  /// @throws std::invalid_argument naming the vertex if a position is non-finite, or if the number of vertices differs
  ///         from the rest shape
  void add(const MotionState& state);

  [[nodiscard]] const CheckFindings& findings(Check check) const { return found_[static_cast<std::size_t>(check)]; }
  [[nodiscard]] std::int64_t states() const { return states_; }
  /// Returns true if no check has findings.
  [[nodiscard]] bool clean() const;

 private:
  struct Finding {
    std::size_t count = 0;
    double value = 0;
    std::string text;
    std::vector<int> vertices;
  };

  void note(Check check, const MotionState& state, Finding finding);
  [[nodiscard]] Finding crossings(const MotionState& state) const;
  [[nodiscard]] Finding ways(const MotionState& state);
  [[nodiscard]] Finding inside(const MotionState& state);
  [[nodiscard]] Finding stretched(const MotionState& state);

  AuditedCloth cloth_;
  AuditLimits limits_;
  std::unique_ptr<const Topology> topology_;  // others refer to it
  StuckWatch stuck_;
  std::vector<Topology> bodies_;  // in the order of the colliders; empty unless a mesh
  std::vector<char> closed_;
  std::vector<Touches> touches_;  // of the cloth with itself, then with each collider
  std::int64_t states_ = 0;
  Vertices before_;
  std::vector<Collider> colliders_before_;
  std::array<CheckFindings, check_count> found_;
};

}  // namespace drape::audit
