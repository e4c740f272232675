// A USD file read in pieces gives the same as its text in memory, wherever a piece ends.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/usd_texts.hpp"

namespace drape {
namespace {

class UsdPieces : public test::InScratchFolder {
 protected:
  /// Returns all data that a reader takes from a stage, or its error.
  static std::string read(const SourceText& source) {
    std::string text;
    const std::string error = test::usage_error([&] {
      const UsdStage stage(source, {.moving_points = true, .located_points = true});
      const UsdMovingMesh moving(stage);
      for (const Triangle& t : moving.mesh().triangles) text += fmt::format("{} {} {}; ", t[0], t[1], t[2]);
      for (std::size_t i = 0; i < moving.times().size(); ++i) {
        const Vertices x = moving.points(i);
        text += fmt::format("t = {}:", moving.times()[i]);
        for (const auto& p : x.rowwise()) text += fmt::format(" ({}, {}, {})", p[0], p[1], p[2]);
      }
      for (const UnresolvedReference& gap : stage.gaps()) text += gap.reason;
    });
    return text + " " + error;
  }

  /// Expects the same of a text in memory and of its file.
  /// @returns the common result
  std::string expect_same(const std::string& text) {
    const std::filesystem::path file = put(path("a.usda"), text);
    std::string whole, pieces;
    std::string unreadable = test::usage_error([&] { whole = read(SourceText::read(file)); });
    EXPECT_EQ(test::usage_error([&] { pieces = read(SourceText::open(file)); }), unreadable);
    EXPECT_EQ(pieces, whole);
    if (whole.empty()) return unreadable;
    return whole;
  }
};

const std::string faces = "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n";
const std::string samples =
    "point3f[] points.timeSamples = {\n  0: [(0, 0, 0), (1, 0, 0), (0, 1, 0)],\n"
    "  24: [(-0.125, 1.5e-3, 1), (1, 0, 1), (0, 1, 1)], # and a comment\n"
    "  48: [(0, 0, 2), (1, 0, 2), (0, 1, 2)],\n}\n";

TEST_F(UsdPieces, MayEndAnywhere) {
  const std::string words =
      "def Mesh \"a mesh\" (\n  doc = \"\"\"a \"long\" text\"\"\"\n  references = @none/of/that.usda@</There>\n)\n{\n" +
      faces + "/* a comment\nof lines */ custom string note = 'it\\'s' // and another\nrel skel:skeleton = </a/b>\n" +
      samples + "}\n";
  const std::string whole = expect_same(test::usd_header + words);
  EXPECT_NE(whole.find("t = 2: (0, 0, 2)"), std::string::npos) << whole;
  // Moves the end of a piece through all of it.
  const std::size_t before = SourceText::piece_bytes - test::usd_header.size();
  for (std::size_t k = 0; k <= words.size(); ++k) {
    const std::string padding(before - k - 2, ' ');
    EXPECT_EQ(expect_same(test::usd_header + padding + "#\n" + words), whole) << k;
    if (HasFailure()) return;
  }
}

TEST_F(UsdPieces, HoldTokensAndCommentsOfAnyLength) {
  const std::string many(5 * SourceText::piece_bytes, 'x');
  const std::string mesh = "def Mesh \"m\" {\n" + faces + samples + "}\n";
  const std::string whole = expect_same(test::usd_header + mesh);
  EXPECT_NE(whole.find("t = 2: (0, 0, 2)"), std::string::npos) << whole;
  for (const std::string& before :
       {"# " + many + "\n", "/* " + many + " */", "def Xform \"" + many + "\" {}\n",
        "def Xform \"p\" ( doc = '''" + many + "\n" + many + "''' ) {}\n",
        "def Xform \"p\" { rel r = </" + many + "> }\n", "def Xform \"p\" { asset a = @" + many + "@ }\n",
        "def " + many + " \"p\" {}\n", "def Xform \"p\" ( " + many + " = 1 ) {}\n"}) {
    EXPECT_EQ(expect_same(test::usd_header + before + mesh), whole) << before.substr(0, 20);
  }
}

TEST_F(UsdPieces, HaveTheSameErrorsAtTheSamePlaces) {
  const std::string mesh = "def Mesh \"m\" {\n" + faces + samples + "}\n";
  for (const std::size_t padding : {std::size_t{0}, SourceText::piece_bytes - 100, 3 * SourceText::piece_bytes}) {
    const std::string before = test::usd_header + std::string(padding / 2, '\n') + std::string(padding / 2, ' ');
    const auto change = [&](const std::string& from, const std::string& to) {
      std::string text = mesh;
      text.replace(text.find(from), from.size(), to);
      const std::string found = expect_same(before + text);
      EXPECT_NE(found.find("a.usda:"), std::string::npos) << found;
    };
    change("(0, 1, 2)],\n}", "(0, 1, x)],\n}");  // in a sample that is only located
    change("(0, 1, 2)],\n}", "(0, 1, 2)],\n");   // the end is missing
    change("(0, 1, 2)],\n}", "(0, 1, 2)],\n]");
    change("24: [(-0.125,", "24: [(\"ü\", 1), (-0.125,");
    change("48: [", "48: [(1, 1, 1), ");
    change("48:", "24:");
    change("\"m\"", "\"m");
    change("# and", "/* and");
    change("faceVertexIndices = [0, 1, 2]", "faceVertexIndices = [0, 1, 3]");
    change("def", "deaf");
    change("def", "\x01");
  }
  EXPECT_NE(expect_same("#usd").find("a.usda:1:1: expected '#usda 1.0'"), std::string::npos);
  EXPECT_NE(expect_same("").find("expected '#usda 1.0'"), std::string::npos);
  EXPECT_NE(expect_same("PXR-USDC").find("binary USD file"), std::string::npos);
  EXPECT_NE(expect_same("\xFF\xFE").find("UTF-16"), std::string::npos);
}

TEST_F(UsdPieces, BeginBehindAByteOrderMark) {
  const std::string mesh = "def Mesh \"m\" {\n" + faces + samples + "}\n";
  EXPECT_EQ(expect_same("\xEF\xBB\xBF" + test::usd_header + mesh), expect_same(test::usd_header + mesh));
  EXPECT_NE(expect_same("\xEF\xBB\xBF" + test::usd_header + "deaf").find("a.usda:4:1"), std::string::npos);
}

TEST_F(UsdPieces, AreRefusedWhereTheyAreNoText) {
  const std::filesystem::path file =
      put(path("a.usda"), test::usd_header + std::string(2 * SourceText::piece_bytes, ' ') + std::string(1, '\0'));
  EXPECT_NE(read(SourceText::open(file)).find("a.usda: this is a binary file, not a text"), std::string::npos);
  EXPECT_NE(test::usage_error([&] { SourceText::open(path("missing.usda")); }).find("no such file"), std::string::npos);
  EXPECT_NE(test::usage_error([&] { SourceText::open(path()); }).find("this is a folder"), std::string::npos);
}

}  // namespace
}  // namespace drape
