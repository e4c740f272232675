#include "render/camera_path.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "drape/sim/mesh.hpp"

namespace drape {
namespace {

constexpr double aspect = 1.2;
constexpr double rate = 10;  // frames per second

/// A film in memory.
struct Film {
  Mesh mesh;
  std::vector<Frame> frames;
  Look look;

  explicit Film(Mesh cloth) : mesh(std::move(cloth)) {}
  Frame& add(const Vertices& positions) {
    frames.push_back({.index = static_cast<int>(frames.size()), .positions = positions, .colliders = {}});
    return frames.back();
  }
  [[nodiscard]] KnownFilm known() const {
    const auto pass = [this](const auto& visit) { std::for_each(frames.begin(), frames.end(), visit); };
    return {.aspect = aspect,
            .fps = rate,
            .count = static_cast<int>(frames.size()),
            .triangles = mesh.triangles,
            .start = mesh.positions,
            .look = look,
            .pass = pass};
  }
  [[nodiscard]] std::vector<View> views(const Camera& camera) const {
    const CameraPath path = camera_path(camera, known());
    std::vector<View> all;
    for (const Frame& frame : frames) all.push_back(path.at(frame.index));
    return all;
  }
  [[nodiscard]] Eigen::Vector3d direction(const Camera& camera) const {
    return distant_view(well_placed(camera, known())).position;
  }
};

/// Makes a film of a cloth that swings, shakes in every frame, and is thrown far away half-way; and of a rolling ball.
Film wild_film() {
  Film film(make_grid(4, 4));
  for (int k = 0; k < 60; ++k) {
    const double shake = k % 2 == 0 ? 0.05 : -0.05, far = k < 30 ? 0 : 0.1 * (k - 30);
    Vertices x = (1 + 0.5 * std::sin(0.3 * k)) * film.mesh.positions;
    x.rowwise() += Eigen::RowVector3d(far + shake, std::cos(0.2 * k), 0.5 * far - shake);
    film.add(x).colliders = {SphereShape{{0.02 * k, -1, -1}, 0.3, 0.3}, GroundShape{}};
  }
  return film;
}

Eigen::Vector2d project(const View& view, const Eigen::Vector3d& p) {
  const Eigen::Vector4d clip = view.projection_matrix(aspect, {0.1, 100}) * view.view_matrix() * p.homogeneous();
  EXPECT_GT(clip[3], 0) << "behind the camera";
  return clip.head<2>() / clip[3];
}

/// Returns the outermost point's distance from the middle of the picture, whose border is at 1.
double reach(const View& view, const Frame& frame) {
  double most = 0;
  const auto see = [&](const Eigen::Vector3d& p) { most = std::max(most, project(view, p).cwiseAbs().maxCoeff()); };
  for (Eigen::Index i = 0; i < frame.positions.rows(); ++i) see(frame.positions.row(i));
  for (const Collider& collider : frame.colliders) {
    const auto* sphere = std::get_if<SphereShape>(&collider);
    for (int k = 0; sphere != nullptr && k < 400; ++k) {
      const double z = (k + 0.5) / 200 - 1, turn = 2.4 * k, flat = std::sqrt(1 - z * z);
      see(sphere->center + sphere->radius * Eigen::Vector3d(flat * std::cos(turn), flat * std::sin(turn), z));
    }
  }
  return most;
}

std::vector<Camera> moving_cameras() {
  std::vector<Camera> cameras(4);
  cameras[0].follow = true;
  cameras[1].orbit = 360;
  cameras[2].follow = true;
  cameras[2].orbit = -200;
  cameras[3].orbit = 90;
  cameras[3].target = Eigen::Vector3d(1, 1, 0);
  for (Camera& camera : cameras) camera.margin = 0.1;
  return cameras;
}

TEST(CameraPath, HasEverythingInViewInEveryFrame) {
  const Film film = wild_film();
  for (const Camera& camera : moving_cameras()) {
    const std::vector<View> views = film.views(camera);
    double most = 0;
    for (const Frame& frame : film.frames) {
      const double here = reach(views[static_cast<std::size_t>(frame.index)], frame);
      EXPECT_LE(here, 1 - 2 * camera.margin + 1e-9) << "frame " << frame.index << ", orbit " << camera.orbit;
      most = std::max(most, here);
    }
    EXPECT_GT(most, 0.95 * (1 - 2 * camera.margin)) << "and as large as that allows";
  }
}

TEST(CameraPath, ThatFollowsHasNoJerks) {
  const Film film = wild_film();
  Camera camera;
  camera.follow = true;
  const std::vector<View> views = film.views(camera);
  std::vector<Eigen::Vector3d> targets;
  std::vector<double> distances;
  for (const View& view : views) {
    targets.push_back(view.target);
    distances.push_back((view.position - view.target).norm());
  }
  // The bounds follow from the weights: a triangle of a second on both sides, in frames.
  const double bound = 2 / (11.0 * 11.0);
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
  for (const Frame& frame : film.frames) {
    low = low.cwiseMin(Eigen::Vector3d(frame.positions.colwise().minCoeff()));
    high = high.cwiseMax(Eigen::Vector3d(frame.positions.colwise().maxCoeff()));
  }
  const double farthest = *std::max_element(distances.begin(), distances.end());
  for (std::size_t k = 1; k + 1 < views.size(); ++k) {
    EXPECT_LE((targets[k - 1] - 2 * targets[k] + targets[k + 1]).norm(), bound * (high - low).norm()) << k;
    EXPECT_LE(std::abs(distances[k - 1] - 2 * distances[k] + distances[k + 1]), bound * farthest) << k;
  }
  EXPECT_GT((targets.back() - targets.front()).norm(), 1.5) << "it follows";
}

TEST(CameraPath, ThatFollowsIsAsNearAsTheClothIsSmall) {
  // A cloth pulled to one side, into a third of its width.
  Film film(make_grid(4, 4));
  for (int k = 0; k < 80; ++k) {
    Vertices x = film.mesh.positions;
    const double part = 1 - 2.0 / 3 * std::clamp(k / 30.0, 0.0, 1.0);
    x.col(0) = (x.col(0).array() - 1) * part + 1;
    x.col(2) = x.col(1) * part;
    x.col(1).setZero();
    film.add(x);
  }
  Camera camera;
  camera.azimuth = -90;
  camera.elevation = 0;
  const Frame& last = film.frames.back();
  EXPECT_LT(reach(camera_path(camera, film.known()).at(0), last), 0.89);
  const double still = (film.views(camera).back().position - film.views(camera).back().target).norm();
  camera.follow = true;
  const View view = film.views(camera).back();
  EXPECT_NEAR(reach(view, last), 1 - 2 * camera.margin, 1e-6);
  EXPECT_LT((view.position - view.target).norm(), 0.4 * still);
}

TEST(CameraPath, ThatGoesRoundTurnsByExactlyItsAngle) {
  const Film film = wild_film();
  for (const bool placed : {false, true}) {
    for (const double degrees : {360.0, -90.0}) {
      Camera camera;
      camera.orbit = degrees;
      if (placed) camera.position = Eigen::Vector3d(5, 4, 3);
      const std::vector<View> views = film.views(camera);
      const auto turned = [&](const View& from, const View& to) {
        const Eigen::Vector3d a = from.position - from.target, b = to.position - to.target;
        EXPECT_NEAR(a.norm(), b.norm(), 1e-9);
        EXPECT_NEAR(a.z(), b.z(), 1e-9);
        return std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y()) * 180 / std::numbers::pi;
      };
      const double each = degrees / static_cast<double>(views.size());
      for (std::size_t k = 1; k < views.size(); ++k) {
        EXPECT_NEAR(turned(views[k - 1], views[k]), each, 1e-9);
        EXPECT_TRUE(views[k].target.isApprox(views[0].target, 1e-12));
      }
      // A repeated film turns on evenly: the last frame is one turn step before the first.
      if (degrees == 360) {
        EXPECT_NEAR(turned(views.back(), views.front()), each, 1e-9);
      }
    }
  }
}

TEST(CameraPath, StaysWhereNothingMoves) {
  Film film(make_grid(4, 4));
  for (int k = 0; k < 25; ++k) film.add(film.mesh.positions * (1 / 3.0));
  Camera camera;
  camera.follow = true;
  const std::vector<View> views = film.views(camera);
  for (const View& view : views) {
    EXPECT_EQ(view.position, views[0].position);  // all bits equal: a picture must not flicker
    EXPECT_EQ(view.target, views[0].target);
    EXPECT_EQ(view.up, views[0].up);
  }
}

/// Makes a film of an upright square cloth with its front towards +y.
Film upright_film(bool with_ball) {
  Film film(make_grid(6, 6));
  for (int k = 0; k < 5; ++k) {
    Vertices x = film.mesh.positions;
    x.col(2) = x.col(1);
    x.col(0) *= -1;
    x.col(1).setZero();
    Frame& frame = film.add(x);
    if (with_ball) frame.colliders = {SphereShape{{0, -0.6, 0}, 0.3, 0.3}};
  }
  return film;
}

TEST(WellPlaced, LooksAtTheClothsFront) {
  EXPECT_GT(upright_film(false).direction({}).y(), 0);  // opposite to the default
}

TEST(WellPlaced, LooksAtASphereAndNotAtWhatHidesIt) {
  EXPECT_LT(upright_film(true).direction({}).y(), 0);
  Film other = upright_film(true);
  for (Frame& frame : other.frames) std::get<SphereShape>(frame.colliders[0]).center.y() = 0.6;
  EXPECT_GT(other.direction({}).y(), 0);
}

TEST(WellPlaced, KeepsWhatIsGiven) {
  const Film film = upright_film(true);
  Camera camera;
  camera.azimuth = 77;
  EXPECT_EQ(well_placed(camera, film.known()).azimuth, 77);
  EXPECT_TRUE(well_placed(camera, film.known()).elevation.has_value());
  camera = {};
  camera.elevation = -40;
  EXPECT_EQ(well_placed(camera, film.known()).elevation, -40);
  EXPECT_LT(film.direction(camera).y(), 0);
}

TEST(WellPlaced, LooksFromAboveGroundsAndUpwardsIsUp) {
  Film film = upright_film(false);
  const GroundShape slope{Eigen::Vector3d(0, -0.8, 0.6), -1, 0};
  for (Frame& frame : film.frames) frame.colliders = {slope};
  EXPECT_GT(film.direction({}).dot(slope.normal), 0);

  // The same in a world with y up.
  Film lying(make_grid(6, 6));
  for (int k = 0; k < 5; ++k) lying.add(lying.mesh.positions);
  Camera camera;
  camera.up = Eigen::Vector3d::UnitY();
  const double sine = lying.direction(camera).y();
  EXPECT_GT(sine, 0.2);
  EXPECT_LT(sine, 0.7);
}

}  // namespace
}  // namespace drape
