#include "scene/usd/stage.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "scene/mesh_value.hpp"
#include "scene/usd/mesh.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"
#include "tests/unit/usd_texts.hpp"

namespace drape::usd_stage {
namespace {

using test::usage_error;
using test::usd_error;
using test::usd_header;
using test::usd_mesh;
using test::usd_triangle;

TEST(UsdStage, TakesTheMeshThatIsNamed) {
  const auto prim = [](const std::string& name, const std::string& inside) {
    return "def Xform \"" + name + "\" {\n" + inside + "}\n";
  };
  const std::string cloth = "def Mesh \"cloth\" {\n" + usd_triangle + "}\n";
  const std::string file = usd_header + prim("a", cloth) + prim("b", "def Mesh \"sheet\" {\n" + usd_triangle + "}\n");
  const auto error = [&](const std::string& name) {
    return usage_error([&] { read_usd_mesh(SourceText("cloth.usda", file), name); });
  };
  for (const char* name : {"/a/cloth", "/a", "/b"}) EXPECT_EQ(error(name), "(no error)") << name;
  EXPECT_EQ(error("/a/clot"), "cloth.usda: there is no prim '/a/clot' in the file; did you mean '/a/cloth'?");
  EXPECT_EQ(error("/somewhere/else/still"),
            "cloth.usda: there is no prim '/somewhere/else/still' in the file; it has /a/cloth (3 vertices, 1 "
            "triangles, 1 × 1 × 0 m), /b/sheet (3 vertices, 1 triangles, 1 × 1 × 0 m)");
  EXPECT_EQ(
      usage_error([&] { read_usd_mesh(SourceText("cloth.usda", file + "def Xform \"c\" {}\n"), "/c"); }).substr(0, 63),
      "cloth.usda:18:1: '/c' is no Mesh and has none below it; the fil");
}

// Asset files keep meshes outside the scene, for others to refer to.
TEST(UsdStage, ReadsWhatIsNoPartOfTheSceneWhereNothingElseIs) {
  const std::string mesh = "def Mesh \"m\" {\n" + usd_triangle + "}\n";
  EXPECT_EQ(usd_mesh(usd_header + "over \"model\" {\n" + mesh + "}\n").positions.rows(), 3);
  EXPECT_EQ(usd_mesh(usd_header + "def \"a\" {}\nclass" + mesh.substr(3)).positions.rows(), 3);
  const std::string two = "variantSet \"lod\" = {\n\"low\" {\n" + mesh + "}\n\"high\" {\ndef Mesh \"h\" {}\n}\n}\n";
  EXPECT_EQ(usd_mesh(usd_header + "def \"a\" {\n" + two + "}\n").positions.rows(), 3) << "the first of a set";
  const std::string part = "def Mesh \"part\" {\n" + usd_triangle + "float3 xformOp:translate = (0, 0, 5)\n" +
                           "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n";
  EXPECT_EQ(usd_mesh(usd_header + "def \"a\" {\n" + two + "}\nover \"b\" {\n" + mesh + "}\n" + part).positions(0, 2), 5)
      << "the one that is";
}

TEST(UsdStage, ReadsTheVariantThatIsSelected) {
  const std::string variants = "variantSet \"lod\" = {\n\"low\" { def Mesh \"l\" {} }\n\"high\" {\ndef Mesh \"m\" {\n" +
                               usd_triangle + "}\n}\n}\n";
  const std::string selects = " (\nvariants = { string lod = \"high\" }\nprepend variantSets = \"lod\"\n)";
  EXPECT_EQ(usd_mesh(usd_header + "def \"a\"" + selects + " {\n" + variants + "}\n").positions.rows(), 3);
  EXPECT_EQ(usd_mesh(usd_header + "def \"a\" {\n" + variants +
                     "}\ndef \"b\" (\nreferences = </a>\nvariants = { string lod = "
                     "\"high\" }\n) {}\n")
                .positions.rows(),
            3)
      << "and where something refers to it";
}

TEST(UsdStage, ReadsWhatAPrimRefersTo) {
  const test::ScratchFolder folder;
  const auto put = [&](const std::string& name, const std::string& text) {
    return folder.put(folder.path() / name, text);
  };
  put("part.usda", "#usda 1.0\n( defaultPrim = \"m\" )\ndef Mesh \"m\" {\n" + usd_triangle + "}\n");
  // The nearer definition wins: transforms, units and up axis of the file itself.
  const std::string move =
      "{\nfloat3 xformOp:translate = (0, 0, 7)\nuniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n";
  for (const std::string arc : {"references = @part.usda@", "prepend references = [@./part.usda@</m>]",
                                "payload = @part.usda@", "append payload = @part.usda@ (offset = 3)"}) {
    const Mesh mesh = read_mesh(put("scene.usda", usd_header + "def \"a\" (\n" + arc + "\n) " + move));
    ASSERT_EQ(mesh.positions.rows(), 3) << arc;
    EXPECT_EQ(mesh.positions.row(2), Eigen::RowVector3d(0, 1, 7)) << arc;
  }
  const Mesh sublayer = read_mesh(put(
      "scene.usda", usd_header.substr(0, usd_header.size() - 2) + "subLayers = [@part.usda@]\n)\nover \"m\" " + move));
  EXPECT_EQ(sublayer.positions.row(2), Eigen::RowVector3d(0, 1, 7));
  std::vector<std::filesystem::path> inputs;
  read_mesh(folder.path() / "scene.usda", {}, &inputs);
  EXPECT_EQ(inputs, (std::vector<std::filesystem::path>{folder.path() / "scene.usda", folder.path() / "part.usda"}));
}

TEST(UsdStage, SaysWhatItCannotFollow) {
  EXPECT_EQ(usd_error(usd_header + "def \"a\" ( references = @missing.usda@ ) {}\n"),
            "cloth.usda:4:24: there is no Mesh in the file, and what this refers to is not read: 'missing.usda' is not "
            "there");
  EXPECT_EQ(usd_error(usd_header + "def \"a\" ( references = @body.usdc@ ) {}\n"),
            "cloth.usda:4:24: there is no Mesh in the file, and what this refers to is not read: 'body.usdc' is no "
            ".usda file");
  EXPECT_EQ(
      usd_error(usd_header + "def \"a\" ( references = </b> ) {}\n"),
      "cloth.usda:4:24: there is no Mesh in the file, and what this refers to is not read: there is no prim '/b'");
  EXPECT_EQ(usd_error(usd_header + "def \"a\" ( references = </a> ) {}\n"),
            "cloth.usda:4:24: there is no Mesh in the file, and what this refers to is not read: the prim refers to "
            "itself");
}

// Two prims that refer to each other, or to each other's child, end with an error, without exhausting memory.
TEST(UsdStage, EndsWhereReferencesDoNot) {
  const auto prim = [](const std::string& name, const std::string& refers, const std::string& inside = "") {
    return "def \"" + name + "\" ( references = " + refers + " ) { " + inside + " }\n";
  };
  const auto deep = "references nested deeper than 64";
  EXPECT_NE(usd_error(usd_header + prim("a", "</b>") + prim("b", "</a>")).find(deep), std::string::npos);
  EXPECT_NE(usd_error(usd_header + prim("a", "</b/c>") + prim("b", "</a/c>")).find(deep), std::string::npos);
  EXPECT_NE(
      usd_error(usd_header + prim("a", "</b>") + "def \"b\" { " + prim("c", "</a>") + " }\n").find("nested deeper"),
      std::string::npos);
  std::string doubling = usd_header;
  for (int i = 0; i < 40; ++i) {
    const std::string next = fmt::format("</p{}>", i + 1);
    doubling += prim(fmt::format("p{}", i), fmt::format("[{}, {}]", next, next));
  }
  EXPECT_NE(usd_error(doubling + "def \"p40\" {}\n").find("references lead to more than 16384 specs of one prim"),
            std::string::npos);
}

TEST(UsdStage, LooksAtAMillionPrimsAtMost) {
#ifdef DRAPE_SANITIZED
  GTEST_SKIP() << "minutes for a million prims";
#endif
  std::string many = usd_header;  // 2000 prims, each of 2¹⁰ specs
  for (int i = 0; i < 10; ++i)
    many += fmt::format("def \"p{}\" ( references = [</p{}>, </p{}>] ) {{}}\n", i, i + 1, i + 1);
  many += "def \"p10\" {}\n";
  for (int i = 0; i < 2000; ++i) many += fmt::format("def \"q{}\" ( references = </p0> ) {{}}\n", i);
  EXPECT_NE(usd_error(many).find("references lead to more than 1048576 prims"), std::string::npos);
}

/// Returns a file of another author, which is not part of the project.
std::filesystem::path real_file(const std::string& name) {
  return std::filesystem::path(DRAPE_SOURCE_DIR "/../shared/reference/real") / name;
}

TEST(UsdStage, ReadsRealFilesWithSeveralMeshesAndWithVariants) {
  const std::filesystem::path arm = real_file("arm_with_cloth.usda"), pyramid = real_file("wg_pyramid.usda");
  if (!exists(arm) || !exists(pyramid)) GTEST_SKIP() << "no " << arm << " or no " << pyramid;
  EXPECT_EQ(usage_error([&] { read_mesh(arm); }),
            arm.string() +
                ": expected one Mesh in the file, found 2: /root/Model/Mesh/Mesh (12 vertices, 20 triangles, 1 × 1 × 4 "
                "m), /root/Grid/Grid (25 vertices, 32 triangles, 2 × 2 × 0 m); choose one by its name: { file = …, "
                "prim = \"/root/Model/Mesh/Mesh\" }");
  EXPECT_EQ(read_mesh(arm, {.prim = "/root/Grid"}).positions.rows(), 25);
  // The first of its two referenced pyramids has the stronger selection: the one with the holes.
  EXPECT_EQ(read_mesh(pyramid).triangles.size(), 4U + 12 * 2);
}

}  // namespace
}  // namespace drape::usd_stage
