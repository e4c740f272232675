#include "sim/collision/self_contact.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

#include "sim/collision/impact.hpp"

namespace drape {
namespace {

using Index = std::size_t;

// How far a vertex may go from where it was expected before candidates are searched anew, in thicknesses. More finds
// more pairs that never touch, less searches more often.
constexpr double slack = 0.25;
// How much further apart than the thickness everything has to be for a search to be left out: far more than rounding.
constexpr double clearly_apart = 1.001;
// After so many rounds all zones are joined: then it ends in as many rounds as there are vertices left outside.
constexpr int most_zone_rounds = 50;

/// The largest number of x + h·v; not a number if one is not.
double largest_after(const Threads& threads, const Vertices& x, double h, const Vertices& v) {
  const auto largest = [&](Eigen::Index first, Eigen::Index count) {
    const auto of = [&](const Vertices& all) { return Eigen::Map<const Eigen::ArrayXd>(all.data() + first, count); };
    return (of(x) + h * of(v)).abs().maxCoeff<Eigen::PropagateNaN>();
  };
  const auto larger = [](double a, double b) { return a >= b || std::isnan(a) ? a : b; };
  return reduce(threads, x.size(), largest, larger, numbers_worth_dividing);
}

}  // namespace

SelfContact::SelfContact(const SelfCollision& values, const Cloth& cloth, const Threads& threads)
    : ImpulseFilter(cloth, 0, threads),
      values_(values),
      cloth_(cloth),
      candidates_(cloth, threads),
      sheet_(cloth, threads) {}

void SelfContact::apply(const Vertices& x, double, double h, Vertices& v) {
  converged_ = true;
  const double largest = largest_after(threads_, x, h, v);                    // [m]
  if (!std::isfinite(largest) && (!x.allFinite() || !v.allFinite())) return;  // diverged: nothing to keep apart
  const double rounding = largest * std::numeric_limits<double>::epsilon();
  if (rounding > values_.thickness) {  // far from the origin layers cannot be told apart, and everything would touch
    converged_ = false;
    return;
  }
  // Then there would be pairs to look at, perhaps, but no contact and no impact among them.
  if (rounding < (clearly_apart - 1) / 100 * values_.thickness &&
      sheet_.stays_apart(x, h, v, clearly_apart * values_.thickness)) {
    return;
  }
  load(x, h, v);
  find_candidates();
  if (candidates_.pairs().empty()) return;
  repel();
  stop_impacts();
  if (!impacts_.empty()) make_rigid();
  for_all(threads_, v.rows(), [&](Eigen::Index i) {
    if (is_free(static_cast<int>(i))) v.row(i) = moving_.velocities[Index(i)].transpose();
  });
}

void SelfContact::load(const Vertices& x, double h, const Vertices& v) {
  h_ = h;
  for_all(threads_, x.rows(), [&](Eigen::Index i) {
    x_[Index(i)] = x.row(i).transpose();
    moving_.velocities[Index(i)] = v.row(i).transpose();
    target_[Index(i)] = x_[Index(i)] + h * moving_.velocities[Index(i)];
  });
}

void SelfContact::find_candidates() {
  look_at_stop();
  // Reaches as far as two targets can move towards each other before the candidates are found anew.
  candidates_.find(x_, target_, (1 + 2 * slack) * values_.thickness);
  found_for_ = target_;
  std::fill(changed_.begin(), changed_.end(), 1);
}

void SelfContact::move_targets() {
  const bool far = change_targets(
      std::ssize(x_), [&](Index i) { return (target_[i] - found_for_[i]).norm() > slack * values_.thickness; });
  if (far) find_candidates();
}

double SelfContact::rest_distance(const FeaturePair& pair) const {
  FourPoints rest;
  for (Index i = 0; i < 4; ++i) rest[i] = cloth_.rest.row(pair.vertices[i]).transpose();
  return std::sqrt(nearest(pair.feature, rest).squared);
}

void SelfContact::add_contact(const FeaturePair& pair, std::vector<Contact>& contacts) const {
  const FourPoints p = gather(x_, pair.vertices);
  const Nearest near = nearest(pair.feature, p);
  const double distance = std::sqrt(near.squared);
  if (!(distance > 0)) return;
  const Point difference = near.difference(p);
  Point relative = Point::Zero();
  for (Index i = 0; i < 4; ++i) relative += near.weights[i] * moving_.velocity(pair.vertices[i]);
  const double end = distance + h_ * relative.dot(difference) / distance;
  if (end >= values_.thickness) return;
  // Neighbours are nearer than the thickness where the mesh is finer than that.
  const double gap = distance - std::min(values_.thickness, rest_distance(pair));
  const double speed = gap < 0 ? -gap * std::min(values_.repulsion, 1 / h_) : -gap / h_;
  contacts.emplace_back(pair, near.weights, difference, speed, moving_);
}

void SelfContact::repel() {
  contacts_.fill(
      threads_, std::ssize(candidates_.pairs()),
      [&](Eigen::Index k, std::vector<Contact>& contacts) { add_contact(candidates_.pairs()[Index(k)], contacts); },
      pairs_worth_dividing);
  for (int pass = 0; pass < values_.iterations; ++pass) {
    look_at_stop();
    contacts_.for_each([&](Contact& contact) { contact.apply(values_.friction, moving_); });
  }
  move_targets();
}

void SelfContact::find_impacts() {
  look_at_stop();
  const auto find = [&](Eigen::Index k, std::vector<Impact>& impacts) {
    const FeaturePair& pair = candidates_.pairs()[Index(k)];
    if (!changed(pair)) return;
    const auto time = time_of_impact(pair.feature, gather(x_, pair.vertices), moves(pair));
    if (time) impacts.push_back({pair, *time});
  };
  found_.fill(threads_, std::ssize(candidates_.pairs()), find, pairs_worth_dividing);
  impacts_.clear();
  found_.append_to(impacts_);
  std::fill(changed_.begin(), changed_.end(), 0);
}

void SelfContact::stop_impacts() {
  find_impacts();
  for (int pass = 0; pass < values_.iterations && !impacts_.empty(); ++pass) {
    for (const Impact& impact : impacts_) {
      FourPoints p = gather(x_, impact.pair.vertices);
      for (const int i : impact.pair.vertices) changed_[Index(i)] = 1;
      for (Index i = 0; i < 4; ++i) p[i] += impact.time * h_ * moving_.velocity(impact.pair.vertices[i]);
      const Nearest near = nearest(impact.pair.feature, p);
      if (!(near.squared > 0)) continue;
      Contact(impact.pair, near.weights, near.difference(p), 0, moving_).apply(values_.friction, moving_);
    }
    move_targets();
    find_impacts();
  }
}

void SelfContact::make_rigid() {
  zones_.begin(moving_.velocities);
  for (int round = 0; !impacts_.empty(); ++round) {
    for (const Impact& impact : impacts_) zones_.join(impact.pair.vertices);
    if (round >= most_zone_rounds) zones_.join_all();
    converged_ = zones_.apply(x_, moving_);
    move_targets();
    find_impacts();
    std::erase_if(impacts_, [&](const Impact& impact) { return zones_.together(impact.pair.vertices); });
  }
}

}  // namespace drape
