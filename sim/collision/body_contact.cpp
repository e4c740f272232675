#include "sim/collision/body_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "sim/collision/impact.hpp"

namespace drape {
namespace {

using Index = std::size_t;

// How far a vertex may go from where it was expected before candidates are searched anew, in thicknesses.
constexpr double search_slack = 0.1;
constexpr double clearly = 1 + 1e-6;  // more than rounding
constexpr double impact_part = 0.5;   // of what is kept free: how near something may come on its way
constexpr int solver_sweeps = 8;      // over all contacts, each time some are added
constexpr int impact_passes = 10;     // with impulses, before what collides goes with the body
constexpr int most_hold_rounds = 50;
constexpr std::size_t usual_impacts = 64;  // in a step
constexpr double margin = 1;  // how far the cloth goes before what is near is searched anew, in thicknesses
// The least of a contact's weight on the cloth that has to be on free vertices: they go as many times as fast as it as
// this goes into one.
constexpr double least_free_share = 0.25;

bool opposite(const FeaturePair& pair, const std::array<double, 4>& weights) {
  const Index first = pair.feature == Feature::vertex_triangle ? 1 : 0;
  return std::none_of(weights.begin() + first, weights.end(), [](double w) { return w == 0; });
}

}  // namespace

double BodyContact::reach() const { return (kept_part + search_slack) * law_.thickness; }

BodyContact::BodyContact(std::shared_ptr<const MovingBody> body, const BodyLaw& law, const Cloth& cloth,
                         const Threads& threads)
    : ImpulseFilter(cloth, body->at(0).mesh->points().size(), threads),
      body_(std::move(body)),
      law_(law),
      cloth_count_(cloth.vertex_count()),
      start_(body_->at(0)),
      end_(start_),
      candidates_(body_->topology(), static_cast<int>(end_.mesh->points().size()), cloth, margin * law.thickness,
                  threads) {
  moved_.resize(x_.size());
  impacts_.reserve(usual_impacts);
  far_.resize(x_.size());
  held_.resize(x_.size());
  place_body();
}

void BodyContact::apply(const Vertices& x, double time, double h, Vertices& v) {
  converged_ = true;
  if (!x.allFinite() || !v.allFinite()) return;  // diverged: nothing to keep apart
  start_ = body_->at(time);
  end_ = body_->at(time + h);
  if (clear(x, h, v)) return;
  load(x, h, v);
  if (!resolved()) {
    converged_ = false;
    return;
  }
  look_at_stop();
  candidates_.find({x_, target_, *start_.mesh, *end_.mesh}, reach());
  if (candidates_.pairs().empty()) return;
  found_for_ = target_;
  std::ranges::fill(changed_, 1);
  for_all(threads_, std::ssize(x_),
          [&](Eigen::Index i) { moving_.velocities[Index(i)] = (target_[Index(i)] - x_[Index(i)]) / h; });
  std::ranges::fill(moved_, 0);
  repel();
  stop_impacts();
  if (!impacts_.empty()) go_with_body();
  store(x, v);
}

bool BodyContact::clear(const Vertices& x, double h, const Vertices& v) const {
  Box before{x.colwise().minCoeff().transpose(), x.colwise().maxCoeff().transpose()}, after = before;
  after.low += h * v.colwise().minCoeff().transpose();
  after.high += h * v.colwise().maxCoeff().transpose();
  // A box around the turned box: no farther from its middle than all of the sides together.
  const auto turned = [](const Box& box, const Pose& pose) -> Box {
    const Point middle = pose.in((box.low + box.high) / 2);
    const Point half = pose.turn.transpose().cwiseAbs() * ((box.high - box.low) / 2);
    return {middle - half, middle + half};
  };
  const Box from = turned(before, start_.pose), to = turned(after, end_.pose);
  const double reach = law_.thickness;
  const Box way{from.low.cwiseMin(to.low).array() - reach, from.high.cwiseMax(to.high).array() + reach};
  const Box &body = start_.mesh->tree().bounds(), &moved = end_.mesh->tree().bounds();
  return !way.overlaps({body.low.cwiseMin(moved.low), body.high.cwiseMax(moved.high)});
}

void BodyContact::load(const Vertices& x, double h, const Vertices& v) {
  h_ = h;
  for_all(threads_, x.rows(), [&](Eigen::Index i) {
    const Point from = x.row(i).transpose(), to = from + h * v.row(i).transpose();
    x_[Index(i)] = start_.pose.in(from);
    target_[Index(i)] = end_.pose.in(to);
  });
  if (body_->deforms()) place_body();
}

void BodyContact::place_body() {
  std::ranges::copy(start_.mesh->points(), x_.begin() + cloth_count_);
  std::ranges::copy(end_.mesh->points(), target_.begin() + cloth_count_);
}

bool BodyContact::resolved() const {
  double largest = 0;
  for (int i = 0; i < cloth_count_; ++i) largest = std::max(largest, target_[Index(i)].cwiseAbs().maxCoeff());
  return largest * std::numeric_limits<double>::epsilon() <= law_.thickness;
}

void BodyContact::store(const Vertices& x, Vertices& v) const {
  for_all(threads_, cloth_count_, [&](Eigen::Index i) {
    if (moved_[Index(i)] != 0) v.row(i) = (end_.pose.out(target_[Index(i)]).transpose() - x.row(i)) / h_;
  });
}

Point BodyContact::outwards(const BodyPair& met) const {
  if (!start_.mesh->solid()) return Point::Zero();
  Point weights = Point::Constant(1.0 / 3);
  const int c = met.corner;
  const bool is_edge = met.pair.feature == Feature::edge_edge, is_corner = !is_edge && c >= 0;
  if (is_edge) weights[(c + 2) % 3] = 0;
  if (is_corner) weights[(c + 1) % 3] = weights[(c + 2) % 3] = 0;
  const Point out = start_.mesh->normal_at(met.triangle, weights);
  return is_corner ? Point(-out) : out;
}

bool BodyContact::is_at_pin(const FeaturePair& pair, const std::array<double, 4>& weights) const {
  double share = 0;
  for (Index i = 0; i < 4; ++i) {
    if (pair.vertices[i] < cloth_count_ && is_free(pair.vertices[i])) share += std::abs(weights[i]);
  }
  return share < least_free_share;
}

std::optional<Contact> BodyContact::contact(const BodyPair& met, double time, bool near) const {
  const FeaturePair& pair = met.pair;
  if (near && (!opposite(pair, met.before.weights) || is_at_pin(pair, met.before.weights))) return std::nullopt;
  const FourPoints start = gather(x_, pair.vertices), move = moves(pair);
  FourPoints p = start;
  for (Index i = 0; i < 4; ++i) p[i] += time * move[i];
  const std::array<double, 4> weights = near ? met.before.weights : nearest(pair.feature, p).weights;
  if (!near && is_at_pin(pair, weights)) return std::nullopt;
  Point before = Point::Zero(), change = Point::Zero();
  for (Index i = 0; i < 4; ++i) {
    before += weights[i] * (start[i] - start[2]);
    change += weights[i] * move[i];
  }
  const double kept = kept_part * law_.thickness;
  // Most are not too near at the end however they move: for these no normal is needed.
  if (near && std::sqrt(met.before.squared) - change.norm() > clearly * kept) return std::nullopt;
  const bool is_edge = pair.feature == Feature::edge_edge;
  const Point first = is_edge ? p[1] - p[0] : p[2] - p[1], second = is_edge ? p[3] - p[2] : p[3] - p[1];
  Point normal = first.cross(second);
  if (normal.norm() <= 1e-6 * first.norm() * second.norm()) normal = before;  // parallel edges
  if (normal.isZero(0)) return std::nullopt;
  normal.normalize();
  const Point out = outwards(met);
  if ((out.isZero(0) ? before : out).dot(normal) < 0) normal = -normal;
  const double gap = before.dot(normal);
  if (gap < 0 || (near && gap + change.dot(normal) >= kept)) return std::nullopt;
  // Across the normal they may miss each other. Then they are a pair or not as the search has it.
  if (near && before.norm() > reach() && !comes_within(pair.feature, start, move, reach())) return std::nullopt;
  const double speed = gap < kept ? (kept - gap) * std::min(law_.rate, 1 / h_) : (kept - gap) / h_;
  return Contact(pair, weights, normal, speed, moving_);
}

void BodyContact::solve() {
  for (int sweep = 0; sweep < solver_sweeps; ++sweep) {
    look_at_stop();
    for (Contact& contact : contacts_) contact.apply(law_.friction, moving_);
  }
  move_targets();
}

void BodyContact::repel() {
  near_.fill(
      threads_, std::ssize(candidates_.pairs()),
      [&](Eigen::Index k, std::vector<Contact>& contacts) {
        if (const auto found = contact(candidates_.pairs()[Index(k)], 0, true)) contacts.push_back(*found);
      },
      pairs_worth_dividing);
  contacts_.clear();
  near_.append_to(contacts_);
  if (!contacts_.empty()) solve();
}

void BodyContact::move_targets() {
  std::ranges::fill(far_, 0);
  const bool any_far = change_targets(cloth_count_, [&](Index i) {
    moved_[i] = 1;
    if (astray(i) <= search_slack * law_.thickness) return false;
    found_for_[i] = target_[i];
    far_[i] = 1;
    return true;
  });
  if (any_far) candidates_.find_again({x_, found_for_, *start_.mesh, *end_.mesh}, reach(), far_);
}

double BodyContact::astray(std::size_t i) const {
  const Point to = target_[i] - x_[i], way = found_for_[i] - x_[i];
  const double squared = way.squaredNorm();
  // What stops earlier on its way meets nothing else, unless the body comes.
  const double part = body_->deforms() || !(squared > 0) ? 1 : std::clamp(to.dot(way) / squared, 0.0, 1.0);
  return (to - part * way).norm();
}

void BodyContact::find_impacts() {
  look_at_stop();
  found_.fill(
      threads_, std::ssize(candidates_.pairs()),
      [&](Eigen::Index k, std::vector<Impact>& impacts) { add_impact(candidates_.pairs()[Index(k)], impacts); },
      pairs_worth_dividing);
  impacts_.clear();
  found_.append_to(impacts_);
  std::ranges::fill(changed_, 0);
}

void BodyContact::add_impact(const BodyPair& met, std::vector<Impact>& impacts) const {
  const FeaturePair& pair = met.pair;
  if (!changed(pair)) return;
  const double widest = impact_part * kept_part * law_.thickness;
  // Most stay on their sides of a plane across the line between them.
  const FourPoints from = gather(x_, pair.vertices), to = gather(target_, pair.vertices);
  const double gap = std::min(kept_gap * std::sqrt(met.before.squared), widest);
  if (kept_apart(pair.feature, met.before.difference(from), from, to, 2 * gap)) return;
  const auto time = time_of_impact(pair.feature, from, moves(pair), widest);
  if (!time) return;
  if (const auto found = contact(met, *time, false)) impacts.push_back({met, *found});
}

void BodyContact::stop_impacts() {
  find_impacts();
  for (int pass = 0; pass < impact_passes && !impacts_.empty(); ++pass) {
    for (const Impact& impact : impacts_) {
      for (const int i : impact.met.pair.vertices) changed_[Index(i)] = 1;
      contacts_.push_back(impact.contact);
    }
    solve();
    find_impacts();
  }
}

void BodyContact::go_with_body() {
  std::ranges::fill(held_, 0);
  const auto is_body = [&](int i) { return i >= cloth_count_; };
  for (int round = 0; !impacts_.empty() && round < most_hold_rounds; ++round) {
    for (const Impact& impact : impacts_) {
      Point velocity = Point::Zero();
      double count = 0;
      for (const int i : impact.met.pair.vertices) {
        if (!is_body(i)) continue;
        velocity += moving_.velocity(i);
        ++count;
      }
      for (const int i : impact.met.pair.vertices) {
        if (is_body(i) || !is_free(i) || held_[Index(i)] != 0) continue;
        moving_.velocities[Index(i)] = velocity / count;
        held_[Index(i)] = 1;
      }
    }
    move_targets();
    find_impacts();
    // What is held already can do no more, and pins go where they are told to.
    std::erase_if(impacts_, [&](const Impact& impact) {
      const auto& v = impact.met.pair.vertices;
      if (std::ranges::any_of(v, [&](int i) { return is_free(i) && held_[Index(i)] == 0; })) return false;
      converged_ = converged_ && std::ranges::any_of(v, [&](int i) { return !is_body(i) && !is_free(i); });
      return true;
    });
  }
  converged_ = converged_ && impacts_.empty();
}

}  // namespace drape
