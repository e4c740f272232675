// Motions written by drape are read back: with all bits if the format can hold them, otherwise to its precision.

#include <gtest/gtest.h>

#include <cstring>

#include "motion/import/import_motion.hpp"
#include "motion/reader.hpp"
#include "scene/mesh_value.hpp"
#include "sim/system.hpp"
#include "tests/import/random_motion.hpp"
#include "tests/support/files.hpp"

namespace drape::test {
namespace {

enum class Precision { exact, nine_digits, single };

void expect_near(const Vertices& found, const Vertices& expected, Precision precision) {
  ASSERT_EQ(found.rows(), expected.rows());
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    const double a = found.data()[i], b = expected.data()[i];
    if (precision == Precision::exact) {
      EXPECT_EQ(a, b);
    } else if (precision == Precision::single) {
      EXPECT_EQ(static_cast<float>(a), static_cast<float>(b));
    } else {
      EXPECT_NEAR(a, b, 6e-9 * std::max(0.1, std::abs(b)));
    }
  }
}

class RoundTrip : public InScratchFolder {
 protected:
  /// Imports a file and compares it with the written motion.
  void expect_back(const RandomMotion& motion, const std::string& name, Precision precision, bool with_velocities,
                   std::optional<double> fps = {}) {
    SCOPED_TRACE(name);
    const std::string file = path("back.drape");
    Progress progress;
    import_motion({.cloths = {path(name)}, .fps = fps}, file, {}, progress);
    MotionReader reader(file);
    const MotionScene folder(reader);
    EXPECT_TRUE(reader.header().imported);
    ASSERT_EQ(reader.states(), motion.frames.size());
    EXPECT_EQ(folder.scene().simulation.cloth.triangles, motion.cloth.triangles);
    for (std::size_t k = 0; k < reader.states(); ++k) {
      const State& state = reader.state(k);
      EXPECT_EQ(state.step, static_cast<std::int64_t>(k));
      expect_near(state.x, motion.frames[k].positions, precision);
      if (!with_velocities) continue;
      expect_near(state.v, motion.frames[k].velocities, precision);
      EXPECT_EQ(reader.row(state.step).energies.kinetic, motion.frames[k].energies->kinetic);
      EXPECT_EQ(static_cast<double>(state.step) * reader.header().step, motion.frames[k].time);
    }
    std::filesystem::remove(file);
  }

  /// Writes a random motion in all formats, and expects it back from each.
  void expect_all_back(std::uint64_t seed) {
    SCOPED_TRACE(seed);
    const RandomMotion motion(seed);
    const double fps = 1 / motion.step;
    motion.write_film<NpzWriter>(path("a.npz"));
    motion.write_film<PvdWriter>(path("a.pvd"));
    motion.write_film<UsdWriter>(path("a.usda"));
    motion.write_film<Pc2Writer>(path("cache.pc2"));
    motion.write_frames(path("v/"), ".vtp", vtp_writer(motion.info()));
    motion.write_frames(path("p/"), ".ply", ply_writer(motion.info()));
    motion.write_frames(path("o/"), ".obj", obj_writer(motion.info()));
    expect_back(motion, "a.npz", Precision::exact, true);
    expect_back(motion, "a.pvd", Precision::exact, true);
    expect_back(motion, "v/{frame:04}.vtp", Precision::exact, true);
    expect_back(motion, "p/{frame:04}.ply", Precision::exact, false);
    expect_back(motion, "o/{frame:04}.obj", Precision::nine_digits, false);
    expect_back(motion, "a.usda", Precision::single, false);
    expect_back(motion, "cache.pc2", Precision::single, false, fps);
    for (const char* folder : {"v", "p", "o", "a"}) std::filesystem::remove_all(path(folder));
  }
};

TEST_F(RoundTrip, OfAnyMotionInAnyFormatKeepsWhatTheFormatHolds) {
  for (std::uint64_t seed = 1; seed <= 6 && !HasFailure(); ++seed) expect_all_back(1000 + 77 * seed);
}

/// Fifty more motions.
class RoundTripOf : public RoundTrip, public testing::WithParamInterface<int> {};

TEST_P(RoundTripOf, AnyMotionInAnyFormatKeepsWhatTheFormatHolds) {
  expect_all_back(2000 + 91 * static_cast<std::uint64_t>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Nightly, RoundTripOf, testing::Range(0, 50));

/// Returns the colliders of a kind in their order.
template <class Shape>
std::vector<Shape> shapes_of(const std::vector<Collider>& colliders) {
  std::vector<Shape> shapes;
  for (const Collider& collider : colliders) {
    if (const auto* shape = std::get_if<Shape>(&collider)) shapes.push_back(*shape);
  }
  return shapes;
}

/// Expects spheres, grounds and bodies back.
/// @param rounding rounding error of a coordinate [m]
/// @param tilted   rounding error of the numbers of a tilted ground
template <class Writer>
void expect_things_back(const std::string& name, const std::string& file, double rounding, double tilted) {
  int bodies = 0, balls = 0, grounds = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMotion motion(31 * seed);
    motion.write_film<Writer>(name);
    Progress progress;
    import_motion({.cloths = {name}}, file, {}, progress);
    MotionReader reader(file);
    const MotionScene folder(reader);
    const System system = make_system(folder.scene().simulation);
    for (const Frame& frame : motion.frames) {
      const std::vector<Collider> found = system.colliders_at(frame.time);
      ASSERT_EQ(found.size(), frame.colliders.size());
      const auto spheres = shapes_of<SphereShape>(frame.colliders), found_spheres = shapes_of<SphereShape>(found);
      ASSERT_EQ(found_spheres.size(), spheres.size());
      for (std::size_t i = 0; i < spheres.size(); ++i, ++balls) {
        EXPECT_LT((found_spheres[i].center - spheres[i].center).norm(), rounding);
        EXPECT_EQ(found_spheres[i].radius, spheres[i].radius);
      }
      const auto planes = shapes_of<GroundShape>(frame.colliders), found_planes = shapes_of<GroundShape>(found);
      ASSERT_EQ(found_planes.size(), planes.size());
      for (std::size_t i = 0; i < planes.size(); ++i, ++grounds) {
        const double allowed = planes[i].normal == Eigen::Vector3d::UnitZ() ? 0 : tilted;
        EXPECT_LE((found_planes[i].normal - planes[i].normal).norm(), allowed);
        EXPECT_LE(std::abs(found_planes[i].height - planes[i].height), 10 * allowed);
      }
      const auto meshes = shapes_of<MeshShape>(frame.colliders), found_meshes = shapes_of<MeshShape>(found);
      ASSERT_EQ(found_meshes.size(), meshes.size());
      for (std::size_t i = 0; i < meshes.size(); ++i, ++bodies) {
        EXPECT_LT((found_meshes[i].positions - meshes[i].positions).cwiseAbs().maxCoeff(), 10 * rounding);
      }
    }
    std::filesystem::remove(file);
  }
  EXPECT_GT(bodies, 10);
  EXPECT_GT(balls, 10);
  EXPECT_GT(grounds, 10);
}

TEST_F(RoundTrip, OfNumpyArraysKeepsSpheresGroundsAndBodies) {
  expect_things_back<NpzWriter>(path("a.npz"), path("a.drape"), 1e-15, 1e-15);
}

TEST_F(RoundTrip, OfUsdKeepsSpheresGroundsAndBodies) {
  expect_things_back<UsdWriter>(path("a.usda"), path("a.drape"), 1e-7, 1e-15);
}

TEST_F(RoundTrip, OfParaviewsFilesKeepsSpheresGroundsAndBodies) {
  expect_things_back<PvdWriter>(path("a.pvd"), path("a.drape"), 1e-15, 1e-15);
}

TEST_F(RoundTrip, TurnsAndScalesAndTakesVelocitiesFromDifferences) {
  const RandomMotion motion(5);
  motion.write_frames(path("p/"), ".ply", ply_writer(motion.info()));
  Progress progress;
  import_motion({.cloths = {path("p/{frame:04}.ply")}, .axes = {.y_up = true, .scale = 0.5}, .fps = 10},
                path("a.drape"), {}, progress);
  MotionReader reader(path("a.drape"));
  for (std::size_t k = 0; k < reader.states(); ++k) {
    const Vertices& x = motion.frames[k].positions;
    EXPECT_EQ(reader.state(k).x.col(0), 0.5 * x.col(0));
    EXPECT_EQ(reader.state(k).x.col(1), -0.5 * x.col(2));
    EXPECT_EQ(reader.state(k).x.col(2), 0.5 * x.col(1));
  }
  const Vertices first = reader.state(0).x;
  const Vertices second = reader.state(1).x;
  EXPECT_LT((reader.state(0).v - 10 * (second - first)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(RoundTrip, OfAnObjWithWhatTheClothMayTouchIsTheClothOfAScene) {
  int with_others = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RandomMotion motion(31 * seed);
    motion.write_frames(path("o/"), ".obj", obj_writer(motion.info()));
    const Mesh mesh = read_mesh(path("o/0001.obj"));
    EXPECT_EQ(mesh.triangles, motion.cloth.triangles);
    EXPECT_EQ(mesh.uvs.size(), motion.uvs.size());
    expect_near(mesh.positions, motion.frames[1].positions, Precision::nine_digits);
    with_others += motion.frames[1].colliders.empty() ? 0 : 1;
  }
  EXPECT_GT(with_others, 3);
}

/// Returns the vertices' cloths by name, read from a .ply by its header.
std::vector<std::string> cloths_of(const std::string& ply, std::size_t vertices) {
  const std::string before = "property double z\nproperty int cloth\nelement face", end = "end_header\n";
  EXPECT_NE(ply.find(before), std::string::npos);
  const std::size_t data = ply.find(end) + end.size(), size = 3 * sizeof(double) + sizeof(std::int32_t);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < vertices; ++i) {
    std::int32_t number = 0;
    std::memcpy(&number, ply.data() + data + (i + 1) * size - sizeof number, sizeof number);
    const std::string comment = "comment cloth " + std::to_string(number) + " is ";
    const std::size_t name = ply.find(comment) + comment.size();
    names.push_back(ply.substr(name, ply.find('\n', name) - name));
  }
  return names;
}

TEST_F(RoundTrip, OfAPlyWithSeveralClothsKeepsVerticesAndNames) {
  RandomMotion motion(11);
  const Cloth one = motion.cloth;
  Cloth both;
  append("shirt", one, both);
  append("skirt", one, both);
  motion.cloth = both;
  motion.uvs.insert(motion.uvs.end(), motion.uvs.begin(), motion.uvs.end());
  for (Frame& frame : motion.frames) {
    const Vertices x = frame.positions;
    frame.positions.resize(2 * x.rows(), 3);
    frame.positions << x, x.rowwise() + Eigen::RowVector3d(1, 2, 3);
  }
  motion.write_frames(path("p/"), ".ply", ply_writer(motion.info()));
  expect_back(motion, "p/{frame:04}.ply", Precision::exact, false);
  const std::vector<std::string> names =
      cloths_of(content(path("p/0001.ply")), static_cast<std::size_t>(both.vertex_count()));
  for (int i = 0; i < both.vertex_count(); ++i) {
    EXPECT_EQ(names[static_cast<std::size_t>(i)], i < one.vertex_count() ? "shirt" : "skirt") << i;
  }
}

TEST_F(RoundTrip, JoinsSeveralClothsIntoOneMesh) {
  const RandomMotion motion(9);
  motion.write_film<NpzWriter>(path("a.npz"));
  motion.write_frames(path("p/"), ".ply", ply_writer(motion.info()));
  Progress progress;
  const ImportedMotion found =
      import_motion({.cloths = {path("a.npz"), path("p/{frame:04}.ply")}}, path("a.drape"), {}, progress);
  EXPECT_EQ(found.vertices, 2 * motion.cloth.vertex_count());
  MotionReader reader(path("a.drape"));
  const Vertices x = reader.state(1).x;
  EXPECT_EQ(x.topRows(motion.cloth.vertex_count()), x.bottomRows(motion.cloth.vertex_count()));
}

}  // namespace
}  // namespace drape::test
