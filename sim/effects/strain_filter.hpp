#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "sim/system.hpp"

namespace drape {

/// A spring's position in a string: a chain of springs, each continued at its end by the straightest neighbour.
struct StringLink {
  std::size_t spring;  ///< number in the cloth
  int from, to;        ///< ends, in the direction of the string
  bool joined;         ///< true if it continues the previous link
};

/// Groups springs into strings, each spring once. A string passes through free vertices in the direction straightest at
/// rest, and ends where no spring is within 37° of it. On a grid the strings are the lines and diagonals.
/// @param springs numbers of the springs to group
std::vector<StringLink> lay_out_strings(const Cloth& cloth, const std::vector<std::size_t>& springs);

/// A pulling spring in a string, with the change of its tension.
struct Tension {
  Eigen::Vector3d along;  ///< unit direction of the pull
  double weight;          ///< sum of 1/m of both ends [1/kg]
  double coupling;        ///< lengthening of this spring by the tension of the previous one, and vice versa [1/kg]
  double excess;          ///< length beyond the limit at the current tension [m]
  double pull;            ///< current tension, not negative; springs at 0 stay there [kg·m]
  double more = 0;        ///< result: change of the tension, at least −pull [kg·m]

  // For the elimination.
  bool slack = false;
  double next = 0;
};

/// Finds the changes of a string's tensions such that no spring is too long, and none that could pull less is too
/// short. Solves a tridiagonal system without the springs that would have to push.
void balance(std::span<Tension> string);

/// Filter that changes velocities by impulses along the springs until no spring ends the step outside its limits. It
/// follows Provot 1995, "Deformation constraints in a mass-spring model", applied to velocities as in Bridson, Fedkiw
/// and Anderson 2002, section 4.2. End positions within all upper limits form a convex set, which contains the unmoved
/// cloth. The filter finds its closest point in the mass norm, by Dykstra's method (Boyle and Dykstra 1986). This
/// lowers, spring by spring,
///   φ(p) = ½ ‖δ‖²_M + Σ pₖ·dₖ + Σ Lₖ ‖pₖ‖,   M δ the sum of the springs' impulses pₖ at each vertex, times h,
/// where dₖ joins the ends of a spring at the end of the step and Lₖ is its limit. Later changes of its neighbours can
/// reduce an impulse again. A sweep updates each spring, then solves each string of pulling springs together, which
/// carries a load across the cloth at once. Between sweeps, impulses are extrapolated along their last change (Nesterov
/// 1983). The extrapolation is undone if φ has risen (O'Donoghue and Candès 2015).
///
/// The closest point has impulses along the springs' final directions, which change the angular momentum Σ m x × v.
/// Early sweeps therefore use the directions at the start of the step, which conserves both momenta to rounding. A
/// spring drops this restriction for the rest of the step in three cases. It turns by more than 25°, its load on pins
/// would make it swing up, or other springs have not settled after the early sweeps.
///
/// The impulses of the last step, in State::restraint, are the initial guess. φ is convex in them with its minimum at
/// the closest point, so any guess works. Sweeps end only when every pulling spring is at its upper limit and every
/// pushing one at its lower, within the tolerance. So the filter holds no more than needed.
///
/// Sweeps cover only springs that have had an impulse. Springs that share a vertex with these are checked after every
/// second sweep and before the filter converges; no other spring has moved. Few springs may be beyond the limits, as at
/// a pin under a large load. Then a sweep ends with several passes over these and their neighbours only.
class StrainFilter final : public MotionFilter {
 public:
  StrainFilter(const StrainLimit& limits, const Cloth& cloth);

  void begin(const State& state, double time) override;
  void apply(const Vertices& x, double time, double h, Vertices& v) override;
  bool adjust(const Vertices& x, double time, double h, Vertices& v) override;
  [[nodiscard]] const Restraint* restraint() const override { return &restraint_; }
  [[nodiscard]] double tolerated_gain() const override;
  [[nodiscard]] bool done() const override { return converged_; }

 private:
  using Index = std::size_t;
  // Data checked for every spring in every step, in compact form.
  struct Range {
    int i, j;
    double least, most;  // squared lengths [m²]
  };
  struct Pull {
    Index limited;
    double tension;  // [N]
  };
  enum class Stage : unsigned char { still, watched, active, unconverged };
  struct Limited {
    int i, j;
    double weight;             // sum of 1/m of both ends [1/kg]
    double longest, shortest;  // [m]
    bool joined;               // its i is the j of the previous spring
    Stage stage = Stage::still;
    bool straight = true;  // impulses are along the direction at the start of the step
    // Vector from j to i at the end of the step without impulses [m], and unit direction of the last impulse. That is
    // the direction at the start of the step while `straight`, then the one at its end.
    Eigen::Vector3d end = Eigen::Vector3d::Zero(), direction = end;
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero(), last = impulse;  // on i, times h, now and one sweep ago [kg·m]
    double push = 0;  // last impulse along `direction`; negative: it pulls
  };

  void forget();
  void relax_from(const Vertices& x, double h, Vertices& v, int most_sweeps);
  void find_beyond(const Vertices& x, double h, const Vertices& v);
  [[nodiscard]] Eigen::Vector3d end_of(const Limited& s) const {
    return s.end + (change_[Index(s.i)] - change_[Index(s.j)]);
  }
  void activate(Index k, const Vertices& x);
  bool look_around(const Vertices& x, bool early);
  void relax_all(bool early);
  void relax(Limited& s, bool early);
  void settle(bool early);
  void pull_strings();
  void pull_string(Index first, Index count);
  void set_impulse(Limited& s, double push) {
    s.push = push;
    const Eigen::Vector3d impulse = push * s.direction, more = impulse - s.impulse;
    s.impulse = impulse;
    change_[Index(s.i)] += weight_[s.i] * more;
    change_[Index(s.j)] -= weight_[s.j] * more;
  }
  [[nodiscard]] bool holds(const Limited& s, const Eigen::Vector3d& end) const;
  [[nodiscard]] double assess();
  void extrapolate(double value);
  void undo_extrapolation();

  StrainLimit limits_;
  bool free_;                                          // without pins, so that angular momentum is conserved
  Eigen::VectorXd weight_;                             // 1/m, 0 for a pin [1/kg]
  std::vector<Limited> limited_;                       // sorted by string
  std::vector<Range> ranges_;                          // one per entry of limited_
  Vertices target_;                                    // positions at the end of the step without impulses [m]
  std::vector<Eigen::Vector3d> change_, last_change_;  // displacement by the impulses [m]
  std::vector<int> moved_;                             // vertices with a displacement
  std::vector<Eigen::Index> spring_;                   // number in the cloth of each entry of limited_
  std::vector<Pull> expected_;                         // from the last step, in the order of limited_
  Restraint restraint_;
  std::vector<char> is_moved_;
  std::vector<Index> active_, watched_, merged_, unconverged_;
  std::vector<std::vector<Index>> springs_at_;  // per vertex
  std::vector<Tension> string_;
  double pace_ = 1, ahead_ = 0;  // Nesterov's t, and the extrapolated fraction of the last change
  double last_value_ = 0;        // φ one sweep ago
  bool converged_ = true;
};

}  // namespace drape
