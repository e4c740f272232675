#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include "output/registry.hpp"
#include "tests/support/files.hpp"

namespace drape {
namespace {

constexpr const char* page_file = DRAPE_SOURCE_DIR "/docs/reference/outputs.md";

TEST(OutputReference, ThePageHasTheProgramsOwnDescriptionOfItsFormats) {
  const std::string text = test::content(page_file);
  const std::string begin = "<!-- reference: begin -->\n\n", end = "<!-- reference: end -->";
  ASSERT_NE(text.find(begin), std::string::npos);
  const std::size_t from = text.find(begin) + begin.size(), to = text.find(end);
  ASSERT_NE(to, std::string::npos);
  if (std::getenv("DRAPE_UPDATE_DOCS") != nullptr) {
    std::ofstream(page_file, std::ios::binary) << text.substr(0, from) + output_reference() + text.substr(to);
  } else {
    EXPECT_EQ(text.substr(from, to - from), output_reference())
        << page_file << " is out of date: run this test with DRAPE_UPDATE_DOCS=1 and look at what changes";
  }
}

TEST(OutputReference, EveryFormatHasAnExtensionOfItsOwnAndSaysWhatItIs) {
  std::set<std::string> extensions;
  for (const OutputFormat& format : output_formats()) {
    EXPECT_TRUE(extensions.insert(format.extension).second) << format.extension;
    EXPECT_TRUE(format.extension.starts_with(".")) << format.extension;
    EXPECT_FALSE(format.help.empty()) << format.extension;
    EXPECT_EQ(find_format("out/X" + format.extension), &format);
    EXPECT_NE(output_help(FormatKinds::all).find(format.extension), std::string::npos);
    EXPECT_EQ(output_help(FormatKinds::undrawn).find(format.extension) == std::string::npos, format.drawn())
        << format.extension;
    EXPECT_EQ(output_help(FormatKinds::drawn).find(format.extension) != std::string::npos, format.drawn())
        << format.extension;
  }
}

}  // namespace
}  // namespace drape
