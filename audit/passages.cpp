#include "audit/passages.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include "audit/box_tree.hpp"
#include "audit/predicates.hpp"
#include "audit/touches.hpp"

namespace drape::audit {
namespace {

constexpr double unit = 0x1p-53;
constexpr int rounded_depth = 30;  // bisections in doubles; the error bounds below are valid up to here
constexpr int exact_depth = 80;    // bisections in expansions, see exact_range::grid

/// A polynomial on a part of the step as Bernstein coefficients, each with an error of at most `error`.
template <class Number, std::size_t size>
struct Polynomial {
  std::array<Number, size> c;
  double error = 0;  // 0 for exact numbers
};

template <class Number>
using Linear = std::array<Polynomial<Number, 2>, 3>;  // vector with coordinates linear in time
template <class Number>
using Quadratic = std::array<Polynomial<Number, 3>, 3>;
template <class Number>
using Cubic = Polynomial<Number, 4>;
using Signs = std::array<int, 3>;  // signs of a vector's coordinates; 0: zero or undecided

int sign_of(double value, double error) { return static_cast<int>(value > error) - static_cast<int>(value < -error); }
int sign_of(const Expansion& value, double /*error*/) { return value.sign(); }
double mean(double a, double b) { return 0.5 * (a + b); }
Expansion mean(const Expansion& a, const Expansion& b) { return (a + b).half(); }
double estimate(double value) { return value; }
double estimate(const Expansion& value) { return value.estimate(); }
template <class Number>
Number difference(double a, double b) {
  if constexpr (std::is_same_v<Number, double>) return a - b;
  if constexpr (std::is_same_v<Number, Expansion>) return Expansion::difference(a, b);
}

/// Returns the common sign of all coefficients, which is the polynomial's sign everywhere; 0 if they differ.
template <class Number, std::size_t size>
int sign_throughout(const Polynomial<Number, size>& p) {
  const int first = sign_of(p.c[0], p.error);
  for (std::size_t i = 1; first != 0 && i < size; ++i) {
    if (sign_of(p.c[i], p.error) != first) return 0;
  }
  return first;
}

/// Splits at the middle (de Casteljau): `p` becomes the first half; returns the second.
template <class Number, std::size_t size>
Polynomial<Number, size> split(Polynomial<Number, size>& p) {
  Polynomial<Number, size> second = p;
  for (std::size_t level = 1; level < size; ++level) {
    for (std::size_t i = 0; i + level < size; ++i) second.c[i] = mean(second.c[i], second.c[i + 1]);
    p.c[level] = second.c[0];
  }
  return second;
}

/// Returns the larger magnitude of both ends; unused for exact numbers.
double magnitude(const Polynomial<double, 2>& p) { return std::max(std::abs(p.c[0]), std::abs(p.c[1])); }
double magnitude(const Polynomial<Expansion, 2>& /*p*/) { return 0; }

/// Returns to − from at both ends of the step. Rounding: at most 31 units, 1 for the difference and 1 per bisection.
template <class Number>
Linear<Number> between(const Way& from, const Way& to) {
  Linear<Number> v;
  for (int axis = 0; axis < 3; ++axis) {
    auto& p = v[static_cast<std::size_t>(axis)];
    p.c = {difference<Number>(to.from[axis], from.from[axis]), difference<Number>(to.to[axis], from.to[axis])};
    p.error = 64 * unit * magnitude(p);
  }
  return v;
}

/// Returns coordinate (i, j) of v×w at ends of the step.
template <class Number>
Number minor(const Linear<Number>& v, std::size_t v_end, const Linear<Number>& w, std::size_t w_end, std::size_t i,
             std::size_t j) {
  return v[i].c[v_end] * w[j].c[w_end] - v[j].c[v_end] * w[i].c[w_end];
}

/// Returns 2 v×w. Rounding, if m bounds a coordinate of v×w: 3 units of m for each product, 3 sums of up to 2m: 12
/// units in total. Each bisection adds 2 sums of up to 2m, at most 120 units.
template <class Number>
Quadratic<Number> cross(const Linear<Number>& v, const Linear<Number>& w) {
  Quadratic<Number> product;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
    const Number first = minor(v, 0, w, 0, i, j), last = minor(v, 1, w, 1, i, j);
    product[axis].c = {first + first, minor(v, 0, w, 1, i, j) + minor(v, 1, w, 0, i, j), last + last};
    product[axis].error = 512 * unit * (magnitude(v[i]) * magnitude(w[j]) + magnitude(v[j]) * magnitude(w[i]));
  }
  return product;
}

template <class Number>
Number determinant(const Linear<Number>& u, std::size_t u_end, const Linear<Number>& v, std::size_t v_end,
                   const Linear<Number>& w, std::size_t w_end) {
  return u[0].c[u_end] * minor(v, v_end, w, w_end, 1, 2) + u[1].c[u_end] * minor(v, v_end, w, w_end, 2, 0) +
         u[2].c[u_end] * minor(v, v_end, w, w_end, 0, 1);
}

/// Returns 3 det(u, v, w). Rounding, if m bounds a determinant: 8 units of m for each, 30 for three of them. Each
/// bisection adds 3 sums of up to 3m, at most 270 units.
template <class Number>
Cubic<Number> volume(const Linear<Number>& u, const Linear<Number>& v, const Linear<Number>& w) {
  const auto det = [&](std::size_t i, std::size_t j, std::size_t k) { return determinant(u, i, v, j, w, k); };
  const Number first = det(0, 0, 0), last = det(1, 1, 1);
  double bound = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
    bound += magnitude(u[axis]) * (magnitude(v[i]) * magnitude(w[j]) + magnitude(v[j]) * magnitude(w[i]));
  }
  return {{first + first + first, det(1, 0, 0) + det(0, 1, 0) + det(0, 0, 1),
           det(0, 1, 1) + det(1, 0, 1) + det(1, 1, 0), last + last + last},
          1024 * unit * bound};
}

/// Two features in a part of the step: the vectors between their vertices (3 for a vertex and a triangle, 4 for two
/// edges); the areas that locate coplanar features; and the volume, which is zero if they are coplanar.
template <class Number, std::size_t count>
struct Features {
  std::array<Linear<Number>, count> vectors;
  std::array<Quadratic<Number>, count> areas;
  Cubic<Number> volume;
};

template <std::size_t count>
using SignTable = std::array<Signs, count>;

/// Returns the signs that hold throughout the part of the step.
template <class Polynomials>
auto signs_throughout(const Polynomials& vectors) {
  SignTable<std::tuple_size_v<Polynomials>> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) table[i][axis] = sign_throughout(vectors[i][axis]);
  }
  return table;
}

/// Returns the signs at an end of the part.
template <class Polynomials>
auto signs_at(const Polynomials& vectors, bool last) {
  SignTable<std::tuple_size_v<Polynomials>> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& p = vectors[i][axis];
      table[i][axis] = sign_of(last ? p.c.back() : p.c.front(), p.error);
    }
  }
  return table;
}

/// Returns true if a plane across an axis separates the features: all vectors point to the same side.
template <std::size_t count>
bool separated(const SignTable<count>& vectors) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int sign = vectors[0][axis];
    if (sign != 0 && std::ranges::all_of(vectors, [&](const Signs& s) { return s[axis] == sign; })) return true;
  }
  return false;
}

bool opposite(const Signs& a, const Signs& b) { return a[0] * b[0] < 0 || a[1] * b[1] < 0 || a[2] * b[2] < 0; }
bool same(const Signs& a, const Signs& b) { return a[0] * b[0] > 0 || a[1] * b[1] > 0 || a[2] * b[2] > 0; }

/// Returns true if coplanar features with these areas have no common point. Areas of coplanar features are parallel.
/// The areas of a vertex's sub-triangles add up to the triangle's; outside of it, two of them are opposite. For a
/// triangle of zero area they add up to zero, and two are opposite unless the vertex is on its line.
bool apart(const SignTable<3>& areas) {
  return opposite(areas[0], areas[1]) || opposite(areas[1], areas[2]) || opposite(areas[2], areas[0]);
}
/// Returns true for disjoint edges: both ends of one are on the same side of the other.
bool apart(const SignTable<4>& areas) { return same(areas[0], areas[1]) || same(areas[2], areas[3]); }

/// Returns true if coplanar features with these areas have a common point.
bool together(const SignTable<3>& areas) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (areas[0][axis] * areas[1][axis] > 0 && areas[1][axis] * areas[2][axis] > 0) return true;
  }
  return false;
}
bool together(const SignTable<4>& areas) { return opposite(areas[0], areas[1]) && opposite(areas[2], areas[3]); }

/// Returns true if the features have a common point at an end of the part. The tests are complete: if there is no
/// common point, one of them proves it.
template <std::size_t count>
bool touch_at(const Features<Expansion, count>& f, bool last) {
  const Expansion& volume = last ? f.volume.c.back() : f.volume.c.front();
  return volume.sign() == 0 && !separated(signs_at(f.vectors, last)) && !apart(signs_at(f.areas, last));
}

/// Finds the zero of a volume with opposite signs at low and high, to double precision.
template <class Number>
double root(const Cubic<Number>& volume, double low, double high) {
  std::array<double, 4> c;
  std::ranges::transform(volume.c, c.begin(), [](const Number& n) { return estimate(n); });
  double begin = 0, end = 1;
  for (int i = 0; i < 50; ++i) {
    const double t = 0.5 * (begin + end), s = 1 - t;
    const double value = s * s * (s * c[0] + 3 * t * c[1]) + t * t * (3 * s * c[2] + t * c[3]);
    ((value > 0) == (c[0] > 0) ? begin : end) = t;
  }
  return low + end * (high - low);
}

enum class Answer { no, yes, unknown };
struct Decision {
  Answer answer = Answer::no;
  Meeting meeting = {};
};

template <class Number, std::size_t count>
Features<Number, count> second_half(Features<Number, count>& f) {
  Features<Number, count> second;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      second.vectors[i][axis] = split(f.vectors[i][axis]);
      second.areas[i][axis] = split(f.areas[i][axis]);
    }
  }
  second.volume = split(f.volume);
  return second;
}

template <class Number, std::size_t count>
Decision decide(Features<Number, count>& f, double low, double high, int depth) {
  constexpr bool exact = std::is_same_v<Number, Expansion>;
  if (sign_throughout(f.volume) != 0 || separated(signs_throughout(f.vectors))) return {};
  const auto areas = signs_throughout(f.areas);
  if (apart(areas)) return {};
  if (sign_of(f.volume.c.front(), f.volume.error) * sign_of(f.volume.c.back(), f.volume.error) < 0 && together(areas)) {
    return {Answer::yes, {root(f.volume, low, high), false}};
  }
  if constexpr (exact) {
    for (const bool last : {false, true}) {
      if (touch_at(f, last)) return {Answer::yes, {last ? high : low, true}};
    }
  }
  if (depth == (exact ? exact_depth : rounded_depth)) return {exact ? Answer::yes : Answer::unknown, {low, true}};
  const double middle = 0.5 * (low + high);
  Features<Number, count> second = second_half(f);
  const Decision first = decide(f, low, middle, depth + 1);
  return first.answer != Answer::no ? first : decide(second, middle, high, depth + 1);
}

template <class Number>
Decision decide(const Way& vertex, const std::array<Way, 3>& triangle) {
  Features<Number, 3> f;
  for (std::size_t i = 0; i < 3; ++i) f.vectors[i] = between<Number>(vertex, triangle[i]);
  if (separated(signs_throughout(f.vectors))) return {};
  const auto& [a, b, c] = f.vectors;
  f.volume = volume(a, b, c);
  if (sign_throughout(f.volume) != 0) return {};
  f.areas = {cross(a, b), cross(b, c), cross(c, a)};
  return decide(f, 0, 1, 0);
}

template <class Number>
Decision decide(const std::array<Way, 2>& first, const std::array<Way, 2>& second) {
  Features<Number, 4> f;
  for (std::size_t i = 0; i < 4; ++i) f.vectors[i] = between<Number>(first[i / 2], second[i % 2]);
  if (separated(signs_throughout(f.vectors))) return {};
  const auto& [ac, ad, bc, bd] = f.vectors;
  f.volume = volume(ac, bc, ad);  // det(ac − bc, ac, ad) up to its sign; ac − bc is the first edge
  if (sign_throughout(f.volume) != 0) return {};
  f.areas = {cross(ac, ad), cross(bc, bd), cross(ac, bc), cross(ad, bd)};
  return decide(f, 0, 1, 0);
}

template <class First, class Second>
std::optional<Meeting> meet(const First& first, const Second& second) {
  Decision decision = decide<double>(first, second);
  if (decision.answer == Answer::unknown) decision = decide<Expansion>(first, second);
  return decision.answer == Answer::no ? std::nullopt : std::optional(decision.meeting);
}

}  // namespace

std::optional<Meeting> vertex_meets_triangle(const Way& vertex, const std::array<Way, 3>& triangle) {
  return meet(vertex, triangle);
}

std::optional<Meeting> edges_meet(const std::array<Way, 2>& first, const std::array<Way, 2>& second) {
  return meet(first, second);
}

namespace {

/// A mesh in a step, with positions for exact predicates and its broad phase.
struct Swept {
  Owner owner;
  const Topology& topology;
  Vertices from, to;
  BoxTree vertices, edges, triangles;

  [[nodiscard]] Way way(int v) const { return {from.row(v).transpose(), to.row(v).transpose()}; }
};

/// Returns the mean displacement of all vertices.
Eigen::RowVector3d common_way(const SurfaceMotion& motion) {
  if (motion.from.rows() == 0 || motion.from.rows() != motion.to.rows()) return Eigen::RowVector3d::Zero();
  return motion.to.colwise().mean() - motion.from.colwise().mean();
}

/// @param common displacement of the frame in which boxes are swept, equal for both meshes: common motion sweeps no
///               volume. Boxes include the rounding errors of the frame.
Swept sweep(Owner owner, const SurfaceMotion& motion, const Eigen::RowVector3d& common) {
  if (motion.from.rows() != motion.to.rows()) {
    throw std::invalid_argument(fmt::format("a step needs as many vertices at its end as at its start, found {} and {}",
                                            motion.to.rows(), motion.from.rows()));
  }
  check_vertices(motion.topology.triangles, motion.from);
  const Vertices from = exact_positions(motion.from), to = exact_positions(motion.to);
  const Vertices relative = to.rowwise() - common;
  const Vertices below = relative.unaryExpr([](double x) { return std::nextafter(x, -HUGE_VAL); });
  const Vertices above = relative.unaryExpr([](double x) { return std::nextafter(x, HUGE_VAL); });
  std::vector<std::array<int, 1>> vertices(static_cast<std::size_t>(from.rows()));
  for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = {static_cast<int>(v)};
  return {owner,
          motion.topology,
          from,
          to,
          BoxTree(boxes_around(vertices, {&from, &below, &above})),
          BoxTree(boxes_around(motion.topology.edges, {&from, &below, &above})),
          BoxTree(boxes_around(motion.topology.triangles, {&from, &below, &above}))};
}

void add_vertices_in_triangles(const Swept& a, const Swept& b, std::vector<Passage>& found) {
  a.vertices.for_pairs_with(b.triangles, [&](int v, int t) {
    const Triangle& triangle = b.topology.triangles[static_cast<std::size_t>(t)];
    if (&a == &b && share_vertex(a.topology, std::array{v}, triangle)) return;
    const auto meeting = vertex_meets_triangle(a.way(v), {b.way(triangle[0]), b.way(triangle[1]), b.way(triangle[2])});
    if (!meeting) return;
    found.push_back({Passage::Kind::vertex_triangle,
                     a.owner,
                     b.owner,
                     {v, triangle[0], triangle[1], triangle[2]},
                     meeting->time,
                     meeting->touch});
  });
}

void add_edges(const Swept& a, const Swept& b, std::vector<Passage>& found) {
  const auto visit = [&](int i, int j) {
    const Edge& first = a.topology.edges[static_cast<std::size_t>(i)];
    const Edge& second = b.topology.edges[static_cast<std::size_t>(j)];
    if (&a == &b && share_vertex(a.topology, first, second)) return;
    const auto meeting = edges_meet({a.way(first[0]), a.way(first[1])}, {b.way(second[0]), b.way(second[1])});
    if (!meeting) return;
    found.push_back({Passage::Kind::edge_edge,
                     a.owner,
                     b.owner,
                     {first[0], first[1], second[0], second[1]},
                     meeting->time,
                     meeting->touch});
  };
  if (&a == &b) {
    a.edges.for_pairs(visit);
  } else {
    a.edges.for_pairs_with(b.edges, visit);
  }
}

void sort(std::vector<Passage>& found) {
  std::ranges::sort(found, {}, [](const Passage& p) { return std::tuple(p.kind, p.first_owner, p.vertices); });
}

void resolve_touches(const Swept& cloth, const Swept* body, Touches* touches, std::vector<Passage>& found) {
  const SurfaceMotion own{cloth.topology, cloth.from, cloth.to};
  Touches of_this_step;
  if (touches == nullptr) touches = &of_this_step;
  if (body == nullptr) return touches->resolve(own, nullptr, found);
  const SurfaceMotion other{body->topology, body->from, body->to};
  touches->resolve(own, &other, found);
}

}  // namespace

std::string describe(const Passage& passage) {
  const std::size_t split = passage.kind == Passage::Kind::vertex_triangle ? 1 : 2;
  const auto middle = passage.vertices.begin() + static_cast<std::ptrdiff_t>(split);
  return fmt::format("{} {} {} at {:.6g} of the step",
                     describe(passage.first_owner, {passage.vertices.begin(), middle}),
                     passage.touch ? "touches" : "meets",
                     describe(passage.second_owner, {middle, passage.vertices.end()}), passage.time);
}

std::vector<Passage> find_passages(const SurfaceMotion& cloth, Touches* touches) {
  const Swept swept = sweep(Owner::cloth, cloth, common_way(cloth));
  std::vector<Passage> found;
  add_vertices_in_triangles(swept, swept, found);
  add_edges(swept, swept, found);
  sort(found);
  resolve_touches(swept, nullptr, touches, found);
  return found;
}

std::vector<Passage> find_passages(const SurfaceMotion& cloth, const SurfaceMotion& body, Touches* touches) {
  const Eigen::RowVector3d common = common_way(cloth);
  const Swept swept_cloth = sweep(Owner::cloth, cloth, common), swept_body = sweep(Owner::body, body, common);
  std::vector<Passage> found;
  add_vertices_in_triangles(swept_cloth, swept_body, found);
  add_vertices_in_triangles(swept_body, swept_cloth, found);
  add_edges(swept_cloth, swept_body, found);
  sort(found);
  resolve_touches(swept_cloth, &swept_body, touches, found);
  return found;
}

}  // namespace drape::audit
