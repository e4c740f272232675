#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "output/mesh_writers.hpp"
#include "output/npz_writer.hpp"
#include "output/usd_writer.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape::test {

/// Frames of a cloth with random positions, and a static or moving collider.
struct RandomMotion {
  Cloth cloth;
  std::vector<std::array<float, 2>> uvs;
  std::vector<Frame> frames;
  double step = 0;  ///< between frames [s]

  explicit RandomMotion(std::uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < 20; ++i) random.number();  // generators of nearby seeds begin alike
    const Mesh grid = make_grid(1 + random.below(4), 1 + random.below(4));
    cloth = make_cloth(grid, grid, 1, 10, {});
    uvs = grid.uvs;
    step = random.between(0.001, 0.1);
    const int count = 2 + random.below(6);
    const Mesh box = make_grid(1, 1);
    const auto triangles = std::make_shared<const std::vector<Triangle>>(box.triangles);
    const bool body = random.below(2) == 1, moves = random.below(2) == 1, ball = random.below(2) == 1;
    for (int k = 0; k < count; ++k) {
      Frame frame{.index = k, .time = k * step, .positions = shaken(grid, random), .velocities = shaken(grid, random)};
      frame.energies = Energies{random.number(), random.between(-1, 1), random.number()};
      if (ball) {
        const double size = moves ? 0.3 + 0.05 * k : 0.3;
        frame.colliders.emplace_back(
            SphereShape{.center = {0, moves ? 0.1 * k : 0.5, 1}, .radius = size, .reach = size});
      }
      if (body) {
        MeshShape shape{.triangles = triangles, .positions = box.positions};
        if (moves) shape.positions.col(2).array() += 0.05 * k;
        frame.colliders.emplace_back(std::move(shape));
      }
      frames.push_back(std::move(frame));
    }
    // Comes last, so that existing seeds keep their motions.
    if (random.below(2) == 0) return;
    const Eigen::Vector3d normal = random.below(2) == 0 ? Eigen::Vector3d::UnitZ() : random_point(random).normalized();
    const GroundShape ground{.normal = normal, .height = random.between(-3, 3)};
    for (Frame& frame : frames) frame.colliders.emplace_back(ground);
  }

  [[nodiscard]] FilmInfo info() const {
    FilmInfo film;
    film.seconds_per_frame = step;
    film.expected_frames = static_cast<int>(frames.size());
    film.cloth = &cloth;
    film.uvs = &uvs;
    return film;
  }

  /// Writes the motion with a sink of one file.
  template <class Writer>
  void write_film(const std::string& file) const {
    Writer writer(file, info());
    for (const Frame& frame : frames) writer.add(frame);
    writer.finish(Ending::complete);
  }

  /// Writes the motion to one file per frame, NAME-0000.EXT.
  void write_frames(const std::string& before, const std::string& ending,
                    const std::function<std::string(const Frame&)>& bytes) const {
    for (const Frame& frame : frames) {
      const std::string number = std::to_string(frame.index);
      ScratchFolder::put(before + std::string(4 - number.size(), '0') + number + ending, bytes(frame));
    }
  }

 private:
  static Vertices shaken(const Mesh& grid, Random& random) {
    Vertices x = grid.positions;
    for (Eigen::Index v = 0; v < x.rows(); ++v) x.row(v) += 0.3 * random_point(random).transpose();
    return x;
  }
};

}  // namespace drape::test
