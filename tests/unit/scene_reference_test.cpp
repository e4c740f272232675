#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "scene/color.hpp"
#include "scene/tables.hpp"
#include "tests/support/files.hpp"

namespace drape {
namespace {

constexpr const char* page_file = DRAPE_SOURCE_DIR "/docs/scene-format.md";

TEST(SceneReference, ThePageHasTheProgramsOwnDescriptionOfItsKeys) {
  const std::string text = test::content(page_file);
  const std::string begin = "<!-- reference: begin -->\n\n", end = "<!-- reference: end -->";
  const std::size_t from = text.find(begin) + begin.size(), to = text.find(end);
  ASSERT_NE(text.find(begin), std::string::npos);
  ASSERT_NE(to, std::string::npos);
  if (std::getenv("DRAPE_UPDATE_DOCS") != nullptr) {
    std::ofstream(page_file, std::ios::binary) << text.substr(0, from) + format_reference() + text.substr(to);
  } else {
    EXPECT_EQ(text.substr(from, to - from), format_reference())
        << page_file << " is out of date: run this test with DRAPE_UPDATE_DOCS=1 and look at what changes";
  }
}

TEST(SceneReference, EveryKeyAndEffectHasARow) {
  const std::string reference = format_reference();
  ClothTable cloth;
  Scene scene;
  for (const TableType& table : scene_tables(cloth, scene)) {
    EXPECT_NE(reference.find("### `[" + table.name + "]`"), std::string::npos) << table.name;
    for (const Key& key : table.keys.all()) {
      EXPECT_NE(reference.find("\n| `" + key.name + "` | "), std::string::npos) << key.name;
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
