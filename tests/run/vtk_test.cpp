#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <Eigen/LU>

#include "drape/sim/mesh.hpp"
#include "tests/support/written_motion.hpp"

namespace drape::vtk {
namespace {

using test::number_at;
using test::vertices_at;

std::string unpacked(const std::string& base64) {
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : base64) {
    const std::size_t digit = std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
    if (digit == std::string::npos) continue;
    group = group << 6 | static_cast<std::uint32_t>(digit);
    if ((bits += 6) >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 0xFF);
  }
  return bytes;
}

/// A PolyData file.
class PolyData {
 public:
  explicit PolyData(const std::filesystem::path& file) {
    EXPECT_EQ(document_.LoadFile(file.c_str()), tinyxml2::XML_SUCCESS) << file;
    root_ = document_.RootElement();
    EXPECT_STREQ(root_->Attribute("byte_order"), "LittleEndian");
    EXPECT_STREQ(root_->Attribute("header_type"), "UInt64");
  }

  /// @param where path of the element: "Piece/Points"
  [[nodiscard]] std::string array(const std::string& where, const std::string& name) const {
    const tinyxml2::XMLElement* element = root_->FirstChildElement("PolyData");
    std::istringstream names(where);
    for (std::string child; std::getline(names, child, '/');) element = element->FirstChildElement(child.c_str());
    for (const auto* array = element->FirstChildElement("DataArray"); array != nullptr;
         array = array->NextSiblingElement("DataArray")) {
      if (array->Attribute("Name") != name) continue;
      const std::string block = unpacked(array->GetText());
      EXPECT_EQ(number_at<std::uint64_t>(block, 0), block.size() - 8) << name;
      return block.substr(8);
    }
    return {};
  }

  [[nodiscard]] int count(const char* of) const {
    return root_->FirstChildElement("PolyData")->FirstChildElement("Piece")->IntAttribute(of);
  }

 private:
  tinyxml2::XMLDocument document_;
  const tinyxml2::XMLElement* root_ = nullptr;
};

struct DataSet {
  double time;
  int part;
  std::string file;
};

std::vector<DataSet> collection(const std::string& file) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.LoadFile(file.c_str()), tinyxml2::XML_SUCCESS);
  std::vector<DataSet> sets;
  for (const auto* set = document.RootElement()->FirstChildElement("Collection")->FirstChildElement("DataSet");
       set != nullptr; set = set->NextSiblingElement("DataSet")) {
    sets.push_back({set->DoubleAttribute("timestep"), set->IntAttribute("part"), set->Attribute("file")});
  }
  return sets;
}

TEST(Vtk, ACollectionHoldsTheMotionToTheBit) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(test::moving_scene);
  const auto [result, frames] = test::write_motion(scene, {folder.path("a & b.pvd")});
  const std::vector<DataSet> sets = collection(folder.path("a & b.pvd"));
  ASSERT_EQ(sets.size(), 2 * frames.size());  // the cloth, and the colliders
  ASSERT_EQ(result.outputs.size(), 1U);
  EXPECT_EQ(result.outputs[0].size(), 1 + 2 * frames.size());
  const VertexStretch stretch(scene.simulation.cloth.rest, scene.simulation.cloth.triangles);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Frame& frame = frames[k];
    EXPECT_EQ(sets[2 * k].time, frame.time);
    EXPECT_EQ(sets[2 * k].part, 0);
    EXPECT_EQ(sets[2 * k].file, "a & b/" + std::to_string(k) + ".vtp");
    const PolyData cloth(folder.path(sets[2 * k].file));
    EXPECT_EQ(cloth.count("NumberOfPoints"), 20);
    EXPECT_EQ(vertices_at<double>(cloth.array("Piece/Points", "points"), 0, 20), frame.positions) << k;
    EXPECT_EQ(vertices_at<double>(cloth.array("Piece/PointData", "velocity"), 0, 20), frame.velocities) << k;
    const Eigen::VectorXd expected = stretch(frame.positions);
    const std::string written = cloth.array("Piece/PointData", "stretch");
    for (Eigen::Index i = 0; i < 20; ++i) {
      EXPECT_EQ(number_at<double>(written, static_cast<std::size_t>(8 * i)), expected[i]) << k;
    }
    EXPECT_EQ(number_at<double>(cloth.array("FieldData", "TimeValue"), 0), frame.time);
    EXPECT_EQ(number_at<double>(cloth.array("FieldData", "kinetic_energy"), 0), frame.energies->kinetic);
    EXPECT_EQ(number_at<double>(cloth.array("FieldData", "spheres"), 24), 0.3);
  }
}

TEST(Vtk, HoldsTheMeshAsItIs) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(test::moving_scene);
  test::write_motion(scene, {folder.path("x.vtp")});
  const PolyData cloth(folder.path("x.vtp"));
  const std::vector<Triangle>& triangles = scene.simulation.cloth.triangles;
  EXPECT_EQ(cloth.count("NumberOfPolys"), static_cast<int>(triangles.size()));
  const std::string corners = cloth.array("Piece/Polys", "connectivity"), ends = cloth.array("Piece/Polys", "offsets"),
                    coordinates = cloth.array("Piece/PointData", "st");
  for (std::size_t i = 0; i < 3 * triangles.size(); ++i) {
    const auto vertex = number_at<std::int32_t>(corners, 4 * i);
    EXPECT_EQ(vertex, triangles[i / 3][i % 3]);
    EXPECT_EQ(number_at<float>(coordinates, 8 * static_cast<std::size_t>(vertex)), scene.uvs[i][0]);
    EXPECT_EQ(number_at<std::int32_t>(ends, 4 * (i / 3)), static_cast<int>(3 * (i / 3 + 1)));
  }
}

TEST(Vtk, HasTheSurfacesOfColliders) {
  const test::SceneFolder folder;
  const auto [result, frames] = test::write_motion(folder.load(test::moving_scene), {folder.path("x.pvd")});
  const std::vector<DataSet> sets = collection(folder.path("x.pvd"));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    EXPECT_EQ(sets.at(2 * k + 1).part, 1);
    const PolyData surface(folder.path(sets[2 * k + 1].file));
    const int count = surface.count("NumberOfPoints");
    const Vertices points = vertices_at<double>(surface.array("Piece/Points", "points"), 0, count);
    const auto& sphere = std::get<SphereShape>(frames[k].colliders[0]);
    const auto of_sphere = points.topRows(count - 4);
    EXPECT_LT(((of_sphere.rowwise() - sphere.center.transpose()).rowwise().norm().array() - 0.3).abs().maxCoeff(),
              1e-14);
    EXPECT_EQ(points.bottomRows(4).col(2), Eigen::Vector4d::Constant(-1.25));

    // Their triangles face outwards, checked by the enclosed volume. The flat ground at z = −1.25 has none and is left
    // out.
    const std::string corners = surface.array("Piece/Polys", "connectivity");
    double volume = 0;
    for (int t = 0; t < surface.count("NumberOfPolys") - 2; ++t) {
      Eigen::Matrix3d triangle;
      for (int i = 0; i < 3; ++i) {
        triangle.col(i) = points.row(
            number_at<std::int32_t>(corners, 4 * (3 * static_cast<std::size_t>(t) + static_cast<std::size_t>(i))));
      }
      volume += triangle.determinant() / 6;
    }
    EXPECT_NEAR(volume, 4 * M_PI / 3 * 0.027, 0.02 * 0.113);
  }
}

TEST(Vtk, WritesWhatRestsOnce) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(test::moving_scene, {"effects.sphere.velocity=[0,0,0]"});
  const auto [result, frames] = test::write_motion(scene, {folder.path("x.pvd")});
  EXPECT_EQ(result.outputs.at(0).size(), frames.size() + 2);
  for (const DataSet& set : collection(folder.path("x.pvd"))) {
    EXPECT_TRUE(set.part == 0 || set.file == "x/colliders-0.vtp") << set.file;
  }
}

}  // namespace
}  // namespace drape::vtk
