#pragma once

#include <vector>

#include "sim/effects/spring_strings.hpp"
#include "sim/effects/strain_limit.hpp"
#include "sim/system.hpp"

namespace drape {

/// Changes the velocities by impulses along the springs until no spring ends the step outside its limits (Provot 1995,
/// "Deformation constraints in a mass-spring model", on velocities as in Bridson, Fedkiw and Anderson 2002, section
/// 4.2). What ends the step within all upper limits is a convex set, with a cloth that stays where it is in it, and
/// what is looked for is its nearest point, by mass: Dykstra's method (Boyle and Dykstra 1986), which lowers
///   φ(p) = ½ ‖δ‖²_M + Σ pₖ·dₖ + Σ Lₖ ‖pₖ‖,   M δ the sum of the springs' impulses pₖ at each vertex, times h,
/// spring by spring, dₖ from one end to the other as the step would end and Lₖ the limit, so that what its neighbours
/// do can take an impulse back. A sweep gives each spring what it needs, and then all springs that pull one after
/// another in a string the tensions that they need together, which carries a load across the cloth at once. From sweep
/// to sweep the impulses go on in the direction in which they have changed (Nesterov 1983), and back where φ has risen
/// by that (O'Donoghue and Candès 2015).
///
/// Impulses that point along the springs as they end the step, as the nearest point has them, change the angular
/// momentum Σ m x × v. So at first they are kept along the springs as they are when the step starts, which keeps both
/// momenta to rounding; a spring for which that does not do, since it turns by more than 25° in the step, bears a load
/// on pins that would swing up by it, or the others have not settled after the early sweeps, gives up this restriction,
/// and nothing else, for the rest of the step.
///
/// It begins with the impulses that the last step ended with, as State::restraint has them: φ is convex in them, and
/// has its least value where they lead to the nearest point, wherever they begin. So that they do not hold more than
/// that, the sweeps end only where every spring that pulls is at its upper limit, to the tolerance, and every one that
/// pushes at its lower.
///
/// Only springs that have had an impulse are swept over. Those that have an end in common with one of these are looked
/// at after every second sweep, and before the limits are said to hold; the ends of all others are not moved. Where the
/// springs that are still beyond the limits are few, as at a pin that a large load hangs on, a sweep ends with some
/// over these and those around them alone.
class StrainFilter final : public MotionFilter {
 public:
  StrainFilter(const StrainLimit& limits, const Cloth& cloth);

  void begin(const State& state, double time) override;
  void apply(const Vertices& x, double time, double h, Vertices& v) override;
  bool adjust(const Vertices& x, double time, double h, Vertices& v) override;
  [[nodiscard]] const Restraint* restraint() const override { return &restraint_; }
  [[nodiscard]] bool done() const override { return converged_; }

 private:
  using Index = std::size_t;
  // What is looked at of every spring in every step, close together.
  struct Range {
    int i, j;
    double least, most;  // squared lengths [m²]
  };
  struct Pull {
    Index limited;
    double tension;  // [N]
  };
  enum class Stage : unsigned char { still, watched, active, restless };
  struct Limited {
    int i, j;
    double weight;             // 1/m of both [1/kg]
    double longest, shortest;  // [m]
    bool joined;               // its i is the j of the one before it
    Stage stage = Stage::still;
    bool straight = true;  // impulses are along its direction at the start
    // From j to i at the end of the step as it would be without any impulse [m], and, of length 1, where the impulse
    // that it was last given is along: at its start while straight, and then at its end.
    Eigen::Vector3d end = Eigen::Vector3d::Zero(), direction = end;
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero(), last = impulse;  // on i, times h, now and a sweep ago [kg·m]
    double push = 0;  // that it was last given, along that: negative where it pulls
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
  void give(Limited& s, double push) {
    s.push = push;
    const Eigen::Vector3d impulse = push * s.direction, more = impulse - s.impulse;
    s.impulse = impulse;
    change_[Index(s.i)] += weight_[s.i] * more;
    change_[Index(s.j)] -= weight_[s.j] * more;
  }
  [[nodiscard]] bool holds(const Limited& s, const Eigen::Vector3d& end) const;
  [[nodiscard]] double assess();
  void go_on(double value);
  void go_back();

  StrainLimit limits_;
  bool free_;                                          // without pins: has its angular momentum to keep
  Eigen::VectorXd weight_;                             // 1/m, 0 for a pin [1/kg]
  std::vector<Limited> limited_;                       // in strings
  std::vector<Range> ranges_;                          // of each of these
  Vertices target_;                                    // where the step would end without any impulse [m]
  std::vector<Eigen::Vector3d> change_, last_change_;  // by how much the impulses change that, as Limited has them [m]
  std::vector<int> moved_;                             // the vertices for which they do
  std::vector<Eigen::Index> spring_;                   // of each of limited_, its number in the cloth
  std::vector<Pull> expected_;                         // by the last step, in the order of limited_
  Restraint restraint_;
  std::vector<char> is_moved_;
  std::vector<Index> active_, watched_, merged_, restless_;
  std::vector<std::vector<Index>> springs_at_;  // of each vertex
  std::vector<Tension> string_;
  double pace_ = 1, ahead_ = 0;  // Nesterov's t, and what part of the last change a sweep has gone on by
  double last_value_ = 0;        // φ a sweep ago
  bool converged_ = true;
};

}  // namespace drape
