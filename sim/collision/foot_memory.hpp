#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sim/collision/placed_mesh.hpp"

namespace drape {

/// Finds where points are beside a mesh, and remembers which triangles were near each of them: while a point and the
/// mesh move little, only those of them are looked at that can be the nearest. It saves time and changes nothing about
/// what is found. Points and mesh are in the mesh's coordinates. What is kept is of each point by itself: threads may
/// ask for different ones at once.
class FootMemory {
 public:
  /// @param reach within which feet are asked for [m]
  FootMemory(std::size_t points, double reach);

  /// The foot of a point, as PlacedMesh::find says it, if it is nearer than the reach.
  bool find(const PlacedMesh& mesh, std::size_t k, const Point& point, Foot& foot) {
    const Known& known = known_[k];
    // Number by number: the point has just been computed so, and would have to go through memory.
    const double x = point[0] - known.point[0], y = point[1] - known.point[1], z = point[2] - known.point[2];
    const double squared = x * x + y * y + z * z;
    if (mesh.travel() == known.travel && squared < known.clear_squared) return false;
    if (mesh.travel() != known.travel || !(squared < known.alone_squared)) return find_slowly(mesh, k, point, foot);
    foot = mesh.foot(point, known.triangle, mesh.nearest_on(known.triangle, point));
    return foot.distance < reach_;
  }

 private:
  static constexpr std::size_t most = 8;
  /// Of a point what is enough if it has moved little, and the mesh not at all.
  struct Known {
    Point point = Point::Zero();
    double travel = 0;          // of the mesh when the point was there
    double clear_squared = -1;  // how far it may go from there with no foot, squared; negative: not at all [m²]
    double alone_squared = -1;  // how far with its foot on the same triangle, likewise
    int triangle = -1;
  };
  /// The triangles that were near it.
  struct Near {
    Point point = Point::Zero();
    double travel = 0;                    // of the mesh when the point was there
    int count = 0, asked = 0;             // since then
    double nearest = 0;                   // distance [m]
    double all_within = 0;                // every triangle that was nearer than this is among them
    std::array<double, most> least = {};  // how far they were at least, increasing
    std::array<int, most> triangles = {};
  };
  bool find_slowly(const PlacedMesh& mesh, std::size_t k, const Point& point, Foot& foot);
  /// Searches what is near a point.
  void look(const PlacedMesh& mesh, const Point& point, Known& known, Near& near) const;
  /// Measures how near it is from where the point is now, which is `moved` from where it was measured [m].
  static void look_again(const PlacedMesh& mesh, const Point& point, double moved, double rounding, Near& near);
  bool find_among(const PlacedMesh& mesh, const Point& point, double moved, Known& known, const Near& near,
                  Foot& foot) const;
  /// Whether the nearest triangle is one of those, however the distances have changed by so much [m].
  [[nodiscard]] bool covers(const Near& near, double moved) const;

  double reach_;
  std::vector<Known> known_;
  std::vector<Near> near_;
};

}  // namespace drape
