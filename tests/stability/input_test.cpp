// What is no finite number never gets into a simulation, wherever it is written.

#include <gtest/gtest.h>

#include "scene/tables.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::test {
namespace {

/// How a key's value looks with such a number in it; empty if it holds none.
std::string with_number(const Key& key, const std::string& number) {
  const std::string vector = "[0, " + number + ", 0]";
  if (std::holds_alternative<double*>(key.target) || std::holds_alternative<std::optional<double>*>(key.target)) {
    return number;
  }
  if (std::holds_alternative<Eigen::Vector3d*>(key.target) ||
      std::holds_alternative<std::optional<Eigen::Vector3d>*>(key.target)) {
    return vector;
  }
  if (const auto* list = std::get_if<KeyframeList>(&key.target)) {
    return "[{ time = 0, " + list->names.front() + " = " + vector + " }]";
  }
  return {};
}

void expect_refused(const test::SceneFolder& folder, const std::string& table, const Key& key) {
  for (const char* number : {"nan", "inf", "-inf", "1e999"}) {
    const std::string value = with_number(key, number);
    if (value.empty()) continue;
    const std::string problem = folder.problems(test::least_scene, {table + "." + key.name + "=" + value});
    EXPECT_NE(problem.find("--set " + table + "." + key.name), std::string::npos)
        << table << "." << key.name << ": " << problem;
  }
}

TEST(Input, ThatIsNotFiniteIsAnErrorAtEveryKey) {
  const test::SceneFolder folder;
  Scene scene;
  ClothTable cloth;
  for (const TableType& table : scene_tables(cloth, scene)) {
    for (const Key& key : table.keys.all()) expect_refused(folder, table.name, key);
  }
  for (const EffectType& type : effect_types()) {
    const auto effect = type.make();
    const TableType table = effect_table(type, *effect);
    for (const Key& key : table.keys.all()) expect_refused(folder, table.name, key);
  }
}

TEST(Input, ThatIsNotFiniteIsAnErrorInAMesh) {
  const test::SceneFolder folder;
  for (const char* number : {"nan", "inf", "-inf", "1e999"}) {
    folder.write("a.obj", std::string("v 0 0 0\nv 1 ") + number + " 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("a.usda",
                 std::string("#usda 1.0\ndef Mesh \"m\" {\n  int[] faceVertexCounts = [3]\n  int[] faceVertexIndices = "
                             "[0, 1, 2]\n  point3f[] points = [(0, 0, 0), (1, ") +
                     number + ", 0), (0, 1, 0)]\n}\n");
    for (const char* mesh : {"a.obj", "a.usda"}) {
      const std::string problem = folder.problems(test::least_scene, {std::string("cloth.mesh='") + mesh + "'"});
      EXPECT_NE(problem.find(mesh), std::string::npos) << number << ": " << problem;
    }
  }
}

}  // namespace
}  // namespace drape::test
