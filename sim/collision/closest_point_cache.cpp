#include "sim/collision/closest_point_cache.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drape {
namespace {

using Index = std::size_t;

// Distance that a point may move before its triangles are searched again, as a multiple of the reach. It is shorter if
// there are many triangles.
constexpr double walk = 0.5;
// Difference of distances that count as equal, as a multiple of the reach: far above rounding.
constexpr double nearly_equal = 1e-6;
// Number of queries before the cached triangles are measured again.
constexpr int patience = 16;

/// Returns the square of a distance, reduced to allow for rounding; −1 if the distance is not positive.
double square_of_part(double distance) { return distance > 0 ? (1 - 1e-9) * distance * distance : -1; }

}  // namespace

ClosestPointCache::ClosestPointCache(std::size_t points, double reach) : reach_(reach), known_(points), near_(points) {}

bool ClosestPointCache::find_beyond_cache(const PlacedMesh& mesh, std::size_t k, const Point& point,
                                          ClosestPoint& closest) {
  Known& known = known_[k];
  Near& near = near_[k];
  // Upper bound on the change of every distance.
  const auto since = [&](const Point& place, double travel) {
    return (point - place).norm() + std::abs(mesh.travel() - travel);
  };
  const double gone = since(known.point, known.travel);
  if (gone * gone < known.clear_squared) return false;
  double moved = since(near.point, near.travel);
  if (!covers(near, moved)) {
    search(mesh, point, known, near);
    if (near.count == 0 || known.clear_squared > 0) return false;
    moved = 0;
  } else if (++near.asked > patience) {
    remeasure(mesh, point, moved, nearly_equal * reach_, near);
    moved = 0;
  }
  if (covers(near, moved)) return find_among(mesh, point, moved, known, near, closest);
  // More triangles are equally near than the list holds.
  closest = mesh.find(point, reach_, known.triangle).value_or(ClosestPoint{.distance = reach_});
  return closest.distance < reach_;
}

bool ClosestPointCache::covers(const Near& near, double moved) const {
  return near.count > 0 && near.nearest + 2 * moved + nearly_equal * reach_ < near.all_within;
}

bool ClosestPointCache::find_among(const PlacedMesh& mesh, const Point& point, double moved, Known& known,
                                   const Near& near, ClosestPoint& closest) const {
  int triangle = known.triangle;
  Nearest best = mesh.nearest_on(triangle, point);
  // Lower bounds on the other distances, from tested triangles at the new position and the rest at the old one.
  double second = std::numeric_limits<double>::infinity(), not_compared = near.all_within;
  const double may_be_nearest = near.nearest + 2 * moved + nearly_equal * reach_;
  for (Index j = 0; j < Index(near.count); ++j) {
    if (near.least[j] > may_be_nearest) {
      not_compared = std::min(not_compared, near.least[j]);
      break;
    }
    const int other = near.triangles[j];
    if (other == known.triangle) continue;
    const double least = mesh.least_squared(other, point);
    if (least > best.squared) {
      second = std::min(second, least);
      continue;
    }
    const Nearest there = mesh.nearest_on(other, point);
    if (there.squared < best.squared || (there.squared == best.squared && other < triangle)) {
      second = std::min(second, best.squared);
      best = there;
      triangle = other;
    } else {
      second = std::min(second, there.squared);
    }
  }
  const double runner_up = std::min(std::sqrt(second), not_compared - moved);
  closest = mesh.closest_point(point, triangle, best);
  known = {.point = point,
           .travel = mesh.travel(),
           .clear_squared = square_of_part(closest.distance - reach_),
           .same_triangle_squared = square_of_part((runner_up - std::sqrt(best.squared) - nearly_equal * reach_) / 2),
           .triangle = triangle};
  return closest.distance < reach_;
}

void ClosestPointCache::search(const PlacedMesh& mesh, const Point& point, Known& known, Near& near) const {
  known = {.point = point, .travel = mesh.travel()};
  near.point = point;
  near.travel = mesh.travel();
  near.count = near.asked = 0;
  const double far = 2 * reach_, away = mesh.tree().bounds().exteriorDistance(point);
  if (away > far) {
    known.clear_squared = square_of_part(away - reach_);
    return;
  }
  // One entry more than the list holds bounds the distances of omitted triangles.
  std::array<double, most + 1> least;
  std::array<int, most + 1> triangles;
  Index count = 0;
  int nearest = -1;
  double within = mesh.solid() ? std::numeric_limits<double>::infinity() : far, limit = within * within;
  double best = limit;
  mesh.tree().for_nearest(point, limit, [&](int t) {
    const double squared = mesh.least_squared(t, point);
    if (squared >= limit) return;
    const double distance = std::sqrt(squared);
    if (squared <= best) {
      const double exactly = mesh.nearest_on(t, point).squared;
      if (exactly < best) {
        best = exactly;
        nearest = t;
      }
    }
    Index at = std::min(count, most);
    for (; at > 0 && least[at - 1] > distance; --at) {
      least[at] = least[at - 1];
      triangles[at] = triangles[at - 1];
    }
    least[at] = distance;
    triangles[at] = t;
    count = std::min(count + 1, most + 1);
    within = std::min(within, std::sqrt(best) + 2 * walk * reach_);
    if (count > most) within = std::min(within, least[most]);
    limit = within * within;
  });
  if (nearest < 0) {
    known.clear_squared = square_of_part(far - reach_);
    return;
  }
  near.nearest = std::sqrt(best);
  near.count = static_cast<int>(std::min(count, most));
  near.all_within = within;
  std::copy_n(least.begin(), near.count, near.least.begin());
  std::copy_n(triangles.begin(), near.count, near.triangles.begin());
  known.triangle = nearest;
  known.clear_squared =
      square_of_part(mesh.closest_point(point, nearest, mesh.nearest_on(nearest, point)).distance - reach_);
}

void ClosestPointCache::remeasure(const PlacedMesh& mesh, const Point& point, double moved, double rounding,
                                  Near& near) {
  near.point = point;
  near.travel = mesh.travel();
  near.asked = 0;
  near.all_within -= moved + rounding;
  double best = std::numeric_limits<double>::infinity();
  for (Index j = 0; j < Index(near.count); ++j) {
    const int triangle = near.triangles[j];
    const double squared = mesh.least_squared(triangle, point), distance = std::sqrt(squared);
    if (squared <= best) best = std::min(best, mesh.nearest_on(triangle, point).squared);
    Index at = j;
    for (; at > 0 && near.least[at - 1] > distance; --at) {
      near.least[at] = near.least[at - 1];
      near.triangles[at] = near.triangles[at - 1];
    }
    near.least[at] = distance;
    near.triangles[at] = triangle;
  }
  near.nearest = std::sqrt(best);
}

}  // namespace drape
