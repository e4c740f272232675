#include "sim/contact/mesh_contacts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "sim/collision/distance.hpp"

namespace drape {
namespace {

using Index = std::size_t;

constexpr double impact_share = 0.5;   // least gap on the path, as a fraction of the distance at the end
constexpr double target_slack = 0.25;  // largest deviation from the predicted end of a step, in distances
constexpr int vertex_kind = -1;        // kind of vertex-body contacts, sorted before those of pairs
constexpr int passed_kind = 2;         // kind of contacts that bring back features that have passed through
constexpr int through_kind = 3;        // kind of contacts that bring edges out of a solid
constexpr double touch_reach = 1.25;   // largest gap of touching features, in distances
constexpr int most_steps_ahead = 8;    // steps that one search of self-collision covers
constexpr double way_ahead = 1.5;      // longest way of a vertex in these steps, in distances
constexpr double path_slack = 0.35;    // largest deviation from it, in distances
constexpr double least_gap = 1e-6;     // a smaller gap must not shrink, since rounding could close it, in distances
constexpr double kept_shrink = 1e-4;   // decrease of such a gap that counts as rounding, as a fraction of it
constexpr double resolved = 1e-9;      // least length of a difference with a direction, as a fraction of the distance

Point plane_normal(Feature feature, const FourPoints& p) {
  const bool edges = feature == Feature::edge_edge;
  const Point first = edges ? p[1] - p[0] : p[2] - p[1], second = edges ? p[3] - p[2] : p[3] - p[1];
  const Point normal = first.cross(second);
  return normal.norm() > 1e-9 * first.norm() * second.norm() ? normal.normalized() : Point(Point::Zero());
}

bool inside(const std::array<double, 4>& weights, Feature feature) {
  const auto first = feature == Feature::vertex_triangle ? weights.begin() + 1 : weights.begin();
  return std::none_of(first, weights.end(), [](double w) { return w == 0; });
}

/// Returns the unit normal of the plane between features whose closest points lie inside both, from the second to the
/// first. Zero if one of the points is at an end or rim, or if the features have no such plane.
Point normal_between(Feature feature, const Nearest& near, const FourPoints& p) {
  if (!inside(near.weights, feature)) return Point::Zero();
  const Point plane = plane_normal(feature, p);
  return plane.dot(near.difference(p)) < 0 ? Point(-plane) : plane;
}

ContactKey key_of(const FeaturePair& pair, int source) {
  return {source, static_cast<int>(pair.feature), pair.vertices};
}

bool is_held(const std::vector<ContactConstraint>& held, const ContactKey& key) {
  const auto at = std::ranges::lower_bound(held, key, {}, &ContactConstraint::key);
  return at != held.end() && at->key == key;
}

/// Returns the triangles of a body with indices behind those of the cloth's points.
std::vector<Triangle> numbered_after(int cloth_count, std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) {
    for (int& vertex : triangle) vertex += cloth_count;
  }
  return triangles;
}

/// Returns the signed distance from its triangle of a vertex that has passed, negative [m].
double passed_distance(const Entanglement::Passed& passed, const std::vector<Point>& x) {
  return passed.normal.dot(x[Index(passed.vertex)] - x[Index(passed.triangle[0])]);
}

std::array<double, 4> passed_weights(const Entanglement::Passed& passed) {
  return {1, -passed.weights[0], -passed.weights[1], -passed.weights[2]};
}

std::array<int, 4> passed_vertices(const Entanglement::Passed& passed) {
  return {passed.vertex, passed.triangle[0], passed.triangle[1], passed.triangle[2]};
}

}  // namespace

std::optional<Touch> find_touch(const FeaturePaths& paths, double distance, bool held) {
  const auto& [feature, from, to, before] = paths;
  if (!(before > 0)) return std::nullopt;
  if (before < least_gap * distance) {
    const Nearest near = nearest(feature, from);
    const Point between = normal_between(feature, near, from);
    if (!between.isZero(0) && !kept_apart(feature, between, from, to, (1 - kept_shrink) * before))
      return Touch{near.weights, between, true};
  }
  FourPoints move;
  for (Index i = 0; i < 4; ++i) move[i] = to[i] - from[i];
  if (const auto time = time_of_impact(feature, from, move, impact_share * distance)) {
    FourPoints p = from;
    for (Index i = 0; i < 4; ++i) p[i] += *time * move[i];
    const Nearest near = nearest(feature, p);
    if (near.squared > 0) return Touch{near.weights, near.difference(p).normalized(), true};
    return std::nullopt;
  }
  const Nearest near = nearest(feature, to);
  if (!held && near.squared >= 1.5 * distance * distance) return std::nullopt;
  const bool within = inside(near.weights, feature);
  // Vertex-triangle pairs cover the ends of edges.
  if (feature == Feature::edge_edge && !within) return std::nullopt;
  if (!within && !(std::sqrt(near.squared) > resolved * distance)) return std::nullopt;
  const Point between = normal_between(feature, near, to);
  return Touch{near.weights, between.isZero(0) ? Point(near.difference(to).normalized()) : between, false};
}

SelfContacts::SelfContacts(const ContactTerms& terms, const Cloth& cloth, const Threads& threads,
                           Eigen::MatrixXd frictions)
    : terms_(terms),
      cloth_(cloth),
      pieces_(pieces_of_vertices(cloth)),
      frictions_(std::move(frictions)),
      seams_(cloth, terms.distance),
      candidates_(cloth, threads) {
  x_.resize(static_cast<Index>(cloth.vertex_count()));
  target_ = way_ = ahead_ = x_;
  if (terms.separate) entanglement_.emplace(std::vector<std::vector<Triangle>>{cloth.triangles}, x_.size(), cloth.pins);
}

void SelfContacts::begin(const Vertices& x, double start, double end) {
  duration_ = end - start;
  ++steps_since_;
  for (Index i = 0; i < x_.size(); ++i) x_[i] = x.row(static_cast<Eigen::Index>(i)).transpose();
  if (!sheet_) sheet_.emplace(cloth_, touch_reach * terms_.distance);
  sheet_->begin(x_);
  if (entanglement_) entanglement_->find(x_);
}

bool SelfContacts::go_as_expected() const {
  if (steps_since_ >= steps_ahead_) return false;
  const double before = steps_since_, after = before + 1, most = path_slack * terms_.distance;
  for (Index i = 0; i < x_.size(); ++i) {
    const Point from = found_at_[i] + before * way_[i], to = found_at_[i] + after * way_[i];
    if (!((x_[i] - from).squaredNorm() <= most * most && (target_[i] - to).squaredNorm() <= most * most)) return false;
  }
  return true;
}

void SelfContacts::find_candidates() {
  Point together = Point::Zero();
  for (Index i = 0; i < x_.size(); ++i) {
    way_[i] = target_[i] - x_[i];
    together += way_[i] / static_cast<double>(x_.size());
  }
  double longest = 0;
  for (const Point& way : way_) longest = std::max(longest, (way - together).norm());
  found_at_ = x_;
  steps_since_ = 0;
  steps_ahead_ = 1;
  while (steps_ahead_ < most_steps_ahead && (steps_ahead_ + 1) * longest <= way_ahead * terms_.distance) ++steps_ahead_;
  for (Index i = 0; i < x_.size(); ++i) ahead_[i] = x_[i] + steps_ahead_ * way_[i];
  candidates_.find(x_, ahead_, (touch_reach + 2 * path_slack) * terms_.distance);
}

double SelfContacts::rest_distance(const FeaturePair& pair) const {
  const double across = seams_.across(pair);
  if (!pieces_.empty() && pieces_[Index(pair.vertices[0])] != pieces_[Index(pair.vertices[3])]) return across;
  FourPoints rest;
  for (Index i = 0; i < 4; ++i) rest[i] = cloth_.rest.row(pair.vertices[i]).transpose();
  return std::min(across, std::sqrt(nearest(pair.feature, rest).squared));
}

double SelfContacts::friction(const FeaturePair& pair) const {
  if (pieces_.empty() || frictions_.size() == 0) return terms_.friction;
  return frictions_(pieces_[Index(pair.vertices[0])], pieces_[Index(pair.vertices[3])]);
}

bool SelfContacts::is_pair_of_cloth(const ContactKey& key) const {
  const auto is_vertex = [&](int i) { return i >= 0 && static_cast<Index>(i) < x_.size(); };
  return key.kind >= 0 && key.kind < passed_kind && std::ranges::all_of(key.features, is_vertex);
}

void SelfContacts::find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
                        std::vector<ContactConstraint>& contacts) {
  for (Index i = 0; i < x_.size(); ++i) target_[i] = target.row(static_cast<Eigen::Index>(i)).transpose();
  const bool apart = sheet_->stays_apart(target_);
  if (!apart && !go_as_expected()) find_candidates();
  const auto first = static_cast<std::ptrdiff_t>(contacts.size());
  // Contacts that bear a force may have left the candidates.
  for (const ContactConstraint& contact : held) {
    if (!is_pair_of_cloth(contact.key)) continue;
    add({static_cast<Feature>(contact.key.kind), contact.key.features}, source, true, contacts);
  }
  if (!apart) {
    filter_.set(x_, target_);
    candidates_.for_near(filter_, touch_reach * terms_.distance, [&](const FeaturePair& pair) {
      if (!is_held(held, key_of(pair, source))) add(pair, source, false, contacts);
    });
  }
  if (entanglement_) bring_back(source, contacts);
  std::ranges::sort(contacts.begin() + first, contacts.end(), {}, &ContactConstraint::key);
}

void SelfContacts::add(const FeaturePair& pair, int source, bool held, std::vector<ContactConstraint>& contacts) const {
  if (entanglement_ && entanglement_->any_astray(pair.vertices)) return;
  const FourPoints from = gather(x_, pair.vertices), to = gather(target_, pair.vertices);
  if (!held && kept_apart(pair.feature, from, to, terms_.distance)) return;
  const double before = std::sqrt(nearest(pair.feature, from).squared);
  if (seams_.across(pair) == 0) return;
  const double kept = std::min(terms_.distance, rest_distance(pair));
  const double distance = distance_at_end(before, kept, duration_);
  const auto touch = find_touch({pair.feature, from, to, before}, distance, held);
  if (!touch) return;
  ContactConstraint contact = make(pair.vertices, touch->weights, touch->normal);
  contact.key = key_of(pair, source);
  contact.before = before;
  contact.distance = distance;
  contact.friction = friction(pair);
  contact.collides = touch->collides;
  contacts.push_back(contact);
}

ContactConstraint SelfContacts::make(const std::array<int, 4>& vertices, const std::array<double, 4>& weights,
                                     const Point& normal) const {
  ContactConstraint contact;
  contact.count = 4;
  contact.vertices = vertices;
  contact.weights = weights;
  contact.normal = normal;
  contact.offset = contact.carried = contact.start = Eigen::Vector3d::Zero();
  for (Index i = 0; i < 4; ++i) contact.start += weights[i] * x_[Index(vertices[i])];
  return contact;
}

void SelfContacts::bring_back(int source, std::vector<ContactConstraint>& contacts) const {
  for (const Entanglement::Passed& passed : entanglement_->passed()) {
    ContactConstraint contact = make(passed_vertices(passed), passed_weights(passed), passed.normal);
    contact.key = {source, passed_kind, contact.vertices};
    contact.distance = distance_at_end(passed_distance(passed, x_), terms_.distance, duration_);
    contacts.push_back(contact);
  }
}

BodyContacts::BodyContacts(std::shared_ptr<const MovingBody> body, const ContactTerms& terms, const Cloth& cloth,
                           const Threads& threads)
    : body_(std::move(body)),
      terms_(terms),
      cloth_(cloth),
      threads_(threads),
      cloth_count_(cloth.vertex_count()),
      closest_(static_cast<Index>(cloth.vertex_count()), 2 * terms.distance),
      start_closest_(closest_) {}

void BodyContacts::prepare() {
  const Index corners = start_.mesh->points().size();
  candidates_.emplace(body_->topology(), static_cast<int>(corners), cloth_, terms_.distance, threads_);
  x_.resize(static_cast<Index>(cloth_count_) + corners);
  target_ = x_;
  copy_shape();
  if (!terms_.separate) return;
  std::vector<Triangle> triangles = numbered_after(cloth_count_, body_->topology().triangles);
  entanglement_.emplace(std::vector{cloth_.triangles, std::move(triangles)}, x_.size(), cloth_.pins);
  inside_.assign(Index(cloth_count_), 0);
}

void BodyContacts::begin(const Vertices& x, double start, double end) {
  duration_ = end - start;
  searched_ = false;
  world_ = &x;
  start_ = body_->at(start);
  end_ = body_->at(end);
  if (!candidates_) prepare();
  for (int i = 0; i < cloth_count_; ++i) x_[Index(i)] = start_.pose.to_body(x.row(i).transpose());
  if (body_->deforms()) copy_shape();
  if (entanglement_) find_astray();
}

void BodyContacts::copy_shape() {
  std::ranges::copy(start_.mesh->points(), x_.begin() + cloth_count_);
  std::ranges::copy(end_.mesh->points(), target_.begin() + cloth_count_);
}

void BodyContacts::find_astray() {
  entanglement_->find(x_);
  if (!start_.mesh->solid()) return;
  for (Index i = 0; i < inside_.size(); ++i) {
    ClosestPoint closest;
    inside_[i] = start_closest_.find(*start_.mesh, i, x_[i], closest) && closest.distance < 0 ? 1 : 0;
  }
  find_through();
}

void BodyContacts::find_through() {
  through_.clear();
  const auto crossings = entanglement_->crossings();
  for (Index k = 0; k < crossings.size();) {
    const Edge edge = crossings[k].edge;
    const Point &from = x_[Index(edge[0])], &to = x_[Index(edge[1])];
    double share = 0, count = 0;
    for (; k < crossings.size() && crossings[k].edge == edge; ++k, ++count) {
      const Triangle& t = crossings[k].triangle;
      const Point& corner = x_[Index(t[0])];
      const Point normal = (x_[Index(t[1])] - corner).cross(x_[Index(t[2])] - corner);
      share += normal.dot(corner - from) / normal.dot(to - from);
    }
    share /= count;
    if (edge[1] >= cloth_count_ || inside_[Index(edge[0])] != 0 || inside_[Index(edge[1])] != 0) continue;
    const auto closest = start_.mesh->find(from + share * (to - from), 0);
    if (closest && closest->distance < 0) through_.push_back({edge, share, *closest});
  }
}

void BodyContacts::bring_out(int source, std::vector<ContactConstraint>& contacts) const {
  for (const Through& through : through_) {
    const Triangle& t = body_->topology().triangles[Index(through.closest.triangle)];
    Point from = Point::Zero(), to = Point::Zero();
    for (Index c = 0; c < 3; ++c) {
      const Index corner = Index(cloth_count_) + Index(t[c]);
      from += through.closest.weights[static_cast<Eigen::Index>(c)] * start_.pose.to_world(x_[corner]);
      to += through.closest.weights[static_cast<Eigen::Index>(c)] * end_.pose.to_world(target_[corner]);
    }
    ContactConstraint contact;
    contact.key = {source, through_kind, {through.edge[0], through.edge[1], -1, -1}};
    contact.count = 2;
    contact.vertices = {through.edge[0], through.edge[1], 0, 0};
    contact.weights = {1 - through.share, through.share, 0, 0};
    contact.normal = end_.pose.rotation * through.closest.normal;
    contact.offset = -to;
    contact.carried = from - to;
    contact.start = contact.gather(*world_) - from;
    contact.distance = distance_at_end(through.closest.distance, kept_part * terms_.distance, duration_);
    contacts.push_back(contact);
  }
}

bool BodyContacts::is_astray(const FeaturePair& pair) const {
  if (!entanglement_) return false;
  const std::array<int, 4>& vertices = pair.vertices;
  const auto passes = [&](Index i, Index j) {
    const auto [low, high] = std::minmax({vertices[i], vertices[j]});
    return std::ranges::binary_search(through_, Edge{low, high}, {}, &Through::edge);
  };
  const bool edges = pair.feature == Feature::edge_edge;
  if (passes(2, 3) || (edges ? passes(0, 1) : passes(1, 2) || passes(1, 3))) return true;
  const bool solid = start_.mesh->solid();
  return std::ranges::any_of(vertices, [&](int vertex) {
    if (solid && vertex < cloth_count_) return inside_[Index(vertex)] != 0;
    return entanglement_->is_astray(vertex);
  });
}

void BodyContacts::bring_back(int source, std::vector<ContactConstraint>& contacts) const {
  for (const Entanglement::Passed& passed : entanglement_->passed()) {
    const std::array<int, 4> vertices = passed_vertices(passed);
    // Vertices inside a solid are brought out by the nearest way.
    const auto by_itself = [&](int vertex) {
      return vertex < cloth_count_ && (vertex == passed.vertex || inside_[Index(vertex)] != 0);
    };
    if (start_.mesh->solid() && std::ranges::any_of(vertices, by_itself)) continue;
    ContactConstraint contact = make(vertices, passed_weights(passed), passed.normal);
    contact.key = {source, passed_kind, vertices};
    contact.distance = distance_at_end(passed_distance(passed, x_), kept_part * terms_.distance, duration_);
    contact.friction = contact.restitution = 0;
    contacts.push_back(contact);
  }
  bring_out(source, contacts);
}

bool BodyContacts::is_clear(const Vertices& target) const {
  const auto turned = [](const Vertices& all, const Pose& pose) -> Box {
    const Point low = all.colwise().minCoeff().transpose(), high = all.colwise().maxCoeff().transpose();
    const Point middle = pose.to_body((low + high) / 2),
                half = pose.rotation.transpose().cwiseAbs() * ((high - low) / 2);
    return {middle - half, middle + half};
  };
  const Box from = turned(*world_, start_.pose), to = turned(target, end_.pose);
  const Box way = larger(from.merged(to), 2 * terms_.distance);
  return !way.intersects(start_.mesh->tree().bounds().merged(end_.mesh->tree().bounds()));
}

void BodyContacts::find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
                        std::vector<ContactConstraint>& contacts) {
  if (is_clear(target)) return;
  bool astray = !searched_;
  for (int i = 0; i < cloth_count_; ++i) {
    target_[Index(i)] = end_.pose.to_body(target.row(i).transpose());
    if (!astray) astray = (target_[Index(i)] - found_for_[Index(i)]).norm() > target_slack * terms_.distance;
  }
  if (astray) {
    candidates_->find({x_, target_, *start_.mesh, *end_.mesh}, (kept_part + 2 * target_slack) * terms_.distance);
    found_for_ = target_;
    searched_ = true;
  }
  const auto before = static_cast<std::ptrdiff_t>(contacts.size());
  find_vertices(source, held, contacts);
  const auto first = static_cast<std::ptrdiff_t>(contacts.size());
  find_pairs(source, held, contacts);
  if (entanglement_) bring_back(source, contacts);
  std::ranges::sort(contacts.begin() + first, contacts.end(), {}, &ContactConstraint::key);
  leave_wrong_sides(contacts, before, first);
}

void BodyContacts::leave_wrong_sides(std::vector<ContactConstraint>& contacts, std::ptrdiff_t begin,
                                     std::ptrdiff_t pairs) {
  std::vector<ContactConstraint> passing;  // vertices that pass through triangles
  std::copy_if(contacts.begin() + pairs, contacts.end(), std::back_inserter(passing),
               [](const ContactConstraint& contact) { return contact.collides && contact.count == 1; });
  if (passing.empty()) return;
  const auto wrong = [&](const ContactConstraint& contact) {
    return std::any_of(passing.begin(), passing.end(), [&](const ContactConstraint& one) {
      return one.vertices[0] == contact.vertices[0] && one.normal.dot(contact.normal) < 0;
    });
  };
  contacts.erase(std::remove_if(contacts.begin() + begin, contacts.begin() + pairs, wrong), contacts.begin() + pairs);
}

void BodyContacts::find_vertices(int source, const std::vector<ContactConstraint>& held,
                                 std::vector<ContactConstraint>& contacts) {
  auto known = held.begin();
  for (int i = 0; i < cloth_count_; ++i) {
    const ContactKey key{source, vertex_kind, {i, -1, -1, -1}};
    while (known != held.end() && known->key < key) ++known;
    const bool bears = known != held.end() && known->key == key;
    if (entanglement_ && !start_.mesh->solid() && entanglement_->is_astray(i)) continue;
    ClosestPoint closest;
    if (!closest_.find(*end_.mesh, Index(i), target_[Index(i)], closest)) {
      if (!bears) continue;
      const auto far = end_.mesh->find(target_[Index(i)], 100 * terms_.distance);
      if (!far) continue;
      closest = *far;
    }
    if (!bears && closest.distance >= 2 * terms_.distance) continue;
    ClosestPoint before;
    const bool was_near = start_closest_.find(*start_.mesh, Index(i), x_[Index(i)], before);
    const Triangle& t = body_->topology().triangles[Index(closest.triangle)];
    ContactConstraint contact =
        make({i, cloth_count_ + t[0], cloth_count_ + t[1], cloth_count_ + t[2]},
             {1, -closest.weights[0], -closest.weights[1], -closest.weights[2]}, closest.normal);
    contact.key = key;
    contact.distance = was_near ? distance_at_end(before.distance, terms_.distance, duration_) : terms_.distance;
    contacts.push_back(contact);
  }
}

void BodyContacts::find_pairs(int source, const std::vector<ContactConstraint>& held,
                              std::vector<ContactConstraint>& contacts) {
  const double kept = kept_part * terms_.distance;
  for (const BodyPair& met : candidates_->pairs()) {
    const FeaturePair& pair = met.pair;
    const ContactKey key{source, static_cast<int>(pair.feature), pair.vertices};
    if (is_astray(pair)) continue;
    const FourPoints from = gather(x_, pair.vertices), to = gather(target_, pair.vertices);
    const double distance = distance_at_end(met.before, kept, duration_);
    const bool bears = is_held(held, key);
    if (!bears && kept_apart(pair.feature, from, to, distance)) continue;
    const auto touch = find_touch({pair.feature, from, to, met.before}, distance, bears);
    if (!touch) continue;
    ContactConstraint contact = make(pair.vertices, touch->weights, touch->normal);
    contact.key = key;
    contact.before = met.before;
    contact.distance = distance;
    contact.collides = touch->collides;
    contacts.push_back(contact);
  }
}

ContactConstraint BodyContacts::make(const std::array<int, 4>& vertices, const std::array<double, 4>& weights,
                                     const Point& normal) const {
  ContactConstraint contact;
  contact.count = 0;
  contact.normal = end_.pose.rotation * normal;
  contact.offset = contact.carried = contact.start = Eigen::Vector3d::Zero();
  for (Index i = 0; i < 4; ++i) {
    const int vertex = vertices[i];
    if (vertex < cloth_count_) {
      contact.vertices[Index(contact.count)] = vertex;
      contact.weights[Index(contact.count++)] = weights[i];
      contact.start += weights[i] * world_->row(vertex).transpose();
      continue;
    }
    const Eigen::Vector3d from = start_.pose.to_world(x_[Index(vertex)]),
                          to = end_.pose.to_world(target_[Index(vertex)]);
    contact.offset += weights[i] * to;
    contact.carried += weights[i] * (to - from);
    contact.start += weights[i] * from;
  }
  contact.friction = terms_.friction;
  contact.restitution = terms_.restitution;
  return contact;
}

}  // namespace drape
