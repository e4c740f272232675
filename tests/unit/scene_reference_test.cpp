#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "drape/sim/cloth.hpp"
#include "scene/tables.hpp"
#include "scene/values.hpp"
#include "tests/support/files.hpp"

namespace drape {
namespace {

constexpr const char* page_file = DRAPE_SOURCE_DIR "/docs/reference/scene-format.md";

/// Expects the page's part between the markers of this name to equal the program's text.
void expect_page(const std::string& name, const std::string& expected) {
  const std::string text = test::content(page_file);
  const std::string begin = "<!-- " + name + ": begin -->\n", end = "<!-- " + name + ": end -->";
  const std::size_t from = text.find(begin) + begin.size(), to = text.find(end);
  ASSERT_NE(text.find(begin), std::string::npos);
  ASSERT_NE(to, std::string::npos);
  if (std::getenv("DRAPE_UPDATE_DOCS") != nullptr) {
    std::ofstream(page_file, std::ios::binary) << text.substr(0, from) + "\n" + expected + text.substr(to);
  } else {
    EXPECT_EQ(text.substr(from, to - from), "\n" + expected)
        << page_file << " is out of date: run this test with DRAPE_UPDATE_DOCS=1 and look at what changes";
  }
}

TEST(SceneReference, ThePageHasTheProgramsOwnDescriptionOfItsKeys) { expect_page("reference", format_reference()); }

/// Returns the page's table of fabrics.
std::string fabrics_table() {
  std::string text =
      "| `material` | sample | density, kg/m² | modulus E₁, E₂, N/m | rigidity D₁, D₂, N·m | source |\n"
      "|---|---|---|---|---|---|\n";
  const auto both = [](const WarpWeft& value, double unit, const char* suffix) {
    std::string shown = fmt::format("{:g}{}", value.warp / unit, suffix);
    return value.isotropic() ? shown : shown + fmt::format(", {:g}{}", value.weft / unit, suffix);
  };
  for (const Fabric& f : fabrics()) {
    text += fmt::format("| `\"{}\"` | {} | {} | {} | {} | {} |\n", f.name, f.sample, f.density, both(f.modulus, 1, ""),
                        both(f.rigidity, 1e-6, "e-6"), f.measured ? "Wang et al. 2011" : "estimate");
  }
  return text + "\n";
}

TEST(SceneReference, ThePageHasEveryFabric) {
  expect_page("fabrics", fabrics_table());
  EXPECT_TRUE(std::ranges::is_sorted(fabrics(), {}, &Fabric::name));
  for (const Fabric& f : fabrics()) {
    EXPECT_TRUE(f.density > 0 && f.modulus.warp > 0 && f.modulus.weft > 0) << f.name;
    EXPECT_TRUE(f.rigidity.warp > 0 && f.rigidity.weft > 0) << f.name;
  }
}

TEST(SceneReference, EveryKeyAndEffectHasARow) {
  const std::string reference = format_reference();
  ClothTable cloth;
  SeamTable seam;
  Scene scene;
  for (const TableType& table : scene_tables(cloth, seam, scene)) {
    EXPECT_NE(reference.find("### `[" + table.name + "]`"), std::string::npos) << table.name;
    for (const Key& key : table.keys.all()) {
      EXPECT_NE(reference.find("\n- `" + key.name + "`: "), std::string::npos) << key.name;
      EXPECT_FALSE(key.help.empty()) << key.name;
    }
  }
  for (const EffectType& type : effect_types()) {
    EXPECT_NE(reference.find("### `[effects." + std::string(type.name) + "]`"), std::string::npos) << type.name;
  }
}

TEST(SceneReference, ThePageNamesEveryNamedColour) {
  const std::string text = test::content(page_file);
  for (const std::string& name : color_names()) EXPECT_NE(text.find("`\"" + name + "\"`"), std::string::npos) << name;
}

}  // namespace
}  // namespace drape
