#include "sim/collision/body_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/collision/impact.hpp"

namespace drape {
namespace {

using Index = std::size_t;

// How far a vertex may go from where it was expected before candidates are searched anew, in thicknesses.
constexpr double search_slack = 0.25;
constexpr int solver_sweeps = 8;   // over all contacts, each time some are added
constexpr int impact_passes = 10;  // with impulses, before what collides goes with the body
constexpr int most_hold_rounds = 50;
// The least of a contact's weight on the cloth that has to be on free vertices: they go as many times as fast as it as
// this goes into one.
constexpr double least_free_share = 0.25;

bool opposite(const FeaturePair& pair, const std::array<double, 4>& weights) {
  const Index first = pair.feature == Feature::vertex_triangle ? 1 : 0;
  return std::none_of(weights.begin() + first, weights.end(), [](double w) { return w == 0; });
}

}  // namespace

BodyContact::BodyContact(std::shared_ptr<const MovingBody> body, const BodyLaw& law, const Cloth& cloth)
    : body_(std::move(body)),
      law_(law),
      cloth_count_(cloth.vertex_count()),
      cloth_patches_(make_patches(cloth.triangles, 0, cloth.vertex_count())),
      end_(body_->at(0)) {
  const Index body_count = end_.mesh->points().size(), count = Index(cloth_count_) + body_count;
  body_patches_ = make_patches(body_->topology().triangles, cloth_count_, static_cast<int>(body_count));
  for (Eigen::Index i = 0; i < cloth.masses.size(); ++i) moving_.inverse_masses.push_back(1 / cloth.masses[i]);
  for (const int pin : cloth.pins) moving_.inverse_masses[Index(pin)] = 0;
  moving_.inverse_masses.resize(count, 0);
  moving_.velocities.resize(count, Point::Zero());
  x_.resize(count);
  target_.resize(count);
  found_for_.resize(count);
  changed_.resize(count);
  moved_.resize(count);
  held_.resize(count);
  boxes_ = end_.mesh->boxes();
  tree_.build(boxes_);
  start_ = end_;
  for (Eigen::Index i = 0; i < cloth.rest.rows(); ++i) x_[Index(i)] = target_[Index(i)] = cloth.rest.row(i).transpose();
  for (const Patch& patch : cloth_patches_) cloth_boxes_.push_back(swept_box(patch, x_, target_, 0));
  cloth_tree_.build(cloth_boxes_);
}

void BodyContact::apply(const Vertices& x, double time, double h, Vertices& v) {
  converged_ = true;
  if (!x.allFinite() || !v.allFinite()) return;  // diverged: nothing to keep apart
  load(x, time, h, v);
  if (!resolved()) {
    converged_ = false;
    return;
  }
  find_candidates();
  if (pairs_.empty()) return;
  repel();
  stop_impacts();
  if (!impacts_.empty()) go_with_body();
  store(x, v);
}

void BodyContact::load(const Vertices& x, double time, double h, const Vertices& v) {
  h_ = h;
  std::ranges::fill(moved_, 0);
  start_ = body_->at(time);
  end_ = body_->at(time + h);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const Point from = x.row(i).transpose(), to = from + h * v.row(i).transpose();
    x_[Index(i)] = start_.pose.in(from);
    target_[Index(i)] = end_.pose.in(to);
  }
  std::ranges::copy(start_.mesh->points(), x_.begin() + cloth_count_);
  std::ranges::copy(end_.mesh->points(), target_.begin() + cloth_count_);
  for (Index i = 0; i < x_.size(); ++i) moving_.velocities[i] = (target_[i] - x_[i]) / h;
}

bool BodyContact::resolved() const {
  double largest = 0;
  for (int i = 0; i < cloth_count_; ++i) largest = std::max(largest, target_[Index(i)].cwiseAbs().maxCoeff());
  return largest * std::numeric_limits<double>::epsilon() <= law_.thickness;
}

void BodyContact::store(const Vertices& x, Vertices& v) const {
  for (int i = 0; i < cloth_count_; ++i) {
    if (moved_[Index(i)] == 0) continue;
    v.row(i) = (end_.pose.out(target_[Index(i)]).transpose() - x.row(i)) / h_;
  }
}

void BodyContact::find_candidates() {
  look_at_stop();
  if (body_->deforms()) {
    for (Index t = 0; t < boxes_.size(); ++t) boxes_[t] = swept_box(body_patches_[t], x_, target_, 0);
    tree_.refit(boxes_);
  }
  pairs_.clear();
  const double reach = (kept_part + search_slack) * law_.thickness;
  for (Index k = 0; k < cloth_patches_.size(); ++k) cloth_boxes_[k] = swept_box(cloth_patches_[k], x_, target_, reach);
  cloth_tree_.refit(cloth_boxes_);
  cloth_tree_.for_overlapping(tree_, [&](int k, int t) {
    const Patch& patch = cloth_patches_[Index(k)];
    if (cloth_boxes_[Index(k)].overlaps(boxes_[Index(t)]) && !apart(patch, t, reach)) add_pairs(patch, t);
  });
  found_for_ = target_;
  std::ranges::fill(changed_, 1);
}

bool BodyContact::apart(const Patch& cloth, int triangle, double reach) const {
  const Point& axis = start_.mesh->face_normal(triangle);
  const Triangle &a = cloth.corners, &b = body_patches_[Index(triangle)].corners;
  double above = std::numeric_limits<double>::infinity(), below = above;
  for (const std::vector<Point>* at : {&x_, &target_}) {
    const auto height = [&](int i) { return axis.dot((*at)[Index(i)]); };
    const double a0 = height(a[0]), a1 = height(a[1]), a2 = height(a[2]);
    const double b0 = height(b[0]), b1 = height(b[1]), b2 = height(b[2]);
    above = std::min(above, std::min({a0, a1, a2}) - std::max({b0, b1, b2}));
    below = std::min(below, std::min({b0, b1, b2}) - std::max({a0, a1, a2}));
  }
  return std::max(above, below) > reach;
}

void BodyContact::add_pairs(const Patch& cloth, int triangle) {
  const Patch& body = body_patches_[Index(triangle)];
  const auto &a = cloth.corners, &b = body.corners;
  for (Index c = 0; c < 3; ++c) {
    if (cloth.own_vertex[c]) add({{Feature::vertex_triangle, {a[c], b[0], b[1], b[2]}}, triangle, -1});
    if (body.own_vertex[c]) {
      add({{Feature::vertex_triangle, {b[c], a[0], a[1], a[2]}}, triangle, static_cast<int>(c)});
    }
    if (!cloth.own_edge[c]) continue;
    for (Index d = 0; d < 3; ++d) {
      if (!body.own_edge[d]) continue;
      add({{Feature::edge_edge, {a[c], a[(c + 1) % 3], b[d], b[(d + 1) % 3]}}, triangle, static_cast<int>(d)});
    }
  }
}

void BodyContact::add(const BodyPair& met) {
  const auto& v = met.pair.vertices;
  if (std::none_of(v.begin(), v.end(), [&](int i) { return is_free(i); })) return;
  const double reach = (kept_part + search_slack) * law_.thickness;
  if (may_come_near(met.pair.feature, gather(x_, v), gather(target_, v), reach)) pairs_.push_back(met);
}

FourPoints BodyContact::moves(const FeaturePair& pair) const {
  FourPoints move;
  for (Index i = 0; i < 4; ++i) move[i] = h_ * moving_.velocity(pair.vertices[i]);
  return move;
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
  const FourPoints start = gather(x_, pair.vertices), move = moves(pair);
  FourPoints p = start;
  for (Index i = 0; i < 4; ++i) p[i] += time * move[i];
  const std::array<double, 4> weights = nearest(pair.feature, p).weights;
  if (is_at_pin(pair, weights) || (near && !opposite(pair, weights))) return std::nullopt;
  Point before = Point::Zero(), change = Point::Zero();
  for (Index i = 0; i < 4; ++i) {
    before += weights[i] * (start[i] - start[2]);
    change += weights[i] * move[i];
  }
  const bool is_edge = pair.feature == Feature::edge_edge;
  const Point first = is_edge ? p[1] - p[0] : p[2] - p[1], second = is_edge ? p[3] - p[2] : p[3] - p[1];
  Point normal = first.cross(second);
  if (normal.norm() <= 1e-6 * first.norm() * second.norm()) normal = before;  // parallel edges
  if (normal.isZero(0)) return std::nullopt;
  normal.normalize();
  const Point out = outwards(met);
  if ((out.isZero(0) ? before : out).dot(normal) < 0) normal = -normal;
  const double gap = before.dot(normal), kept = kept_part * law_.thickness;
  if (gap < 0 || (near && gap + change.dot(normal) >= kept)) return std::nullopt;
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
  contacts_.clear();
  for (const BodyPair& met : pairs_) {
    if (const auto found = contact(met, 0, true)) contacts_.push_back(*found);
  }
  if (!contacts_.empty()) solve();
}

void BodyContact::move_targets() {
  bool far = false;
  for (Index i = 0; i < Index(cloth_count_); ++i) {
    const Point target = x_[i] + h_ * moving_.velocities[i];
    if (!is_free(static_cast<int>(i)) || target == target_[i]) continue;
    target_[i] = target;
    changed_[i] = moved_[i] = 1;
    far |= (target - found_for_[i]).norm() > search_slack * law_.thickness;
  }
  if (far) find_candidates();
}

void BodyContact::find_impacts() {
  look_at_stop();
  impacts_.clear();
  for (const BodyPair& met : pairs_) {
    const FeaturePair& pair = met.pair;
    if (std::ranges::none_of(pair.vertices, [&](int i) { return changed_[Index(i)] != 0; })) continue;
    const double widest = 0.5 * kept_part * law_.thickness;
    const auto time = time_of_impact(pair.feature, gather(x_, pair.vertices), moves(pair), widest);
    if (!time) continue;
    if (const auto found = contact(met, *time, false)) impacts_.push_back({met, *found});
  }
  std::ranges::fill(changed_, 0);
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
