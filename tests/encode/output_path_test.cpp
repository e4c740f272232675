#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drape/core/error.hpp"
#include "output/registry.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

using namespace drape;
using drape::test::usage_error;

namespace {

std::string expanded(const std::string& text, int frame = 7, int width = 3) {
  return PathTemplate(text).path("flag", frame, width);
}

TEST(PathTemplate, ReplacesTheScenesName) { EXPECT_EQ(expanded("out/{scene}/{scene}.gif"), "out/flag/flag.gif"); }

TEST(PathTemplate, PadsFrameNumbersWithZeros) {
  EXPECT_EQ(expanded("{frame:04}.png"), "0007.png");
  EXPECT_EQ(expanded("{frame:4}.png"), "0007.png");
  EXPECT_EQ(expanded("{frame:2}.png", 12345), "12345.png");
  EXPECT_EQ(expanded("{frame}.png"), "007.png");
}

TEST(PathTemplate, WritesDoubledBracesOnce) { EXPECT_EQ(expanded("{{{scene}}}.gif"), "{flag}.gif"); }

TEST(PathTemplate, NamesTheValidPlaceholders) {
  EXPECT_EQ(
      usage_error([] { PathTemplate("out/{sceen}.gif"); }),
      "unknown placeholder '{sceen}' in the output path out/{sceen}.gif; did you mean '{scene}'? the valid ones are "
      "{scene}, {frame} and {frame:04}");
  EXPECT_EQ(usage_error([] { PathTemplate("{}.gif"); }),
            "unknown placeholder '{}' in the output path {}.gif; the valid ones are {scene}, {frame} and {frame:04}");
}

TEST(PathTemplate, RefusesWhatIsNoNumberOfDigits) {
  for (const std::string width : {"", "x", "0", "-3", "4x", "99", "04.2"}) {
    const std::string text = "{frame:" + width + "}.png";
    EXPECT_EQ(usage_error([&] { PathTemplate{text}; }),
              "'{frame:" + width + "}' in the output path " + text + ": expected a number of digits, as in {frame:04}");
  }
}

TEST(PathTemplate, RefusesSingleBraces) {
  EXPECT_EQ(usage_error([] { PathTemplate("{scene.gif"); }), "a '}' is missing in the output path {scene.gif");
  EXPECT_EQ(usage_error([] { PathTemplate("a}.gif"); }),
            "a '}' without '{' in the output path a}.gif; write '}}' for a brace");
}

/// Returns file names for all formats, of films and sequences.
std::vector<std::string> every_name() {
  std::vector<std::string> names;
  for (const OutputFormat& format : output_formats()) {
    if (format.of_steps()) continue;  // written by the run itself
    names.push_back("x" + format.extension);
    if (format.file_per_frame()) names.push_back("{frame}" + format.extension);
  }
  return names;
}

class MakeSink : public drape::test::InScratchFolder {
 protected:
  [[nodiscard]] std::string error(const std::string& name, double fps = 25) const {
    return usage_error([&] { make_sink(path(name), {.scene = "flag", .fps = fps}); });
  }
};

TEST_F(MakeSink, NamesTheValidExtensions) {
  const std::string valid =
      "the valid ones are '.gif', '.webp', '.apng', '.png', '.mp4', '.webm', '.avi', '.obj', '.ply', '.npz', "
      "'.usda', '.pvd', '.vtp', '.pc2', '.glb', '.html', '.drape'";
  EXPECT_EQ(error("x.gfi"),
            "the output " + path("x.gfi") + " has the unknown extension '.gfi'; did you mean '.gif'? " + valid);
  EXPECT_EQ(error("x"), "the output " + path("x") + " has no extension; " + valid);
  EXPECT_EQ(file_count(), 0u);
}

TEST_F(MakeSink, TakesExtensionsInCapitals) { EXPECT_EQ(error("X.GIF"), "(no error)"); }

TEST_F(MakeSink, RefusesFrameNumbersForOneFile) {
  const std::string message = error("{frame}.gif");
  EXPECT_NE(message.find("a .gif holds all frames; one file per frame make '.png', '.obj', '.ply', '.vtp'"),
            std::string::npos)
      << message;
}

TEST_F(MakeSink, RefusesAGifFasterThanBrowsersPlay) {
  const std::string message = error("x.gif", 60);
  EXPECT_NE(message.find("a GIF can play at most 50"), std::string::npos) << message;
  EXPECT_EQ(error("x.gif", 50), "(no error)");
  EXPECT_EQ(error("x.mp4", 60), "(no error)");
}

TEST_F(MakeSink, RefusesRatesThatAreNoRates) {
  for (const double fps : {0.0, -1.0, std::nan(""), 1e-9}) {
    for (const std::string name : {"x.gif", "x.mp4"}) EXPECT_NE(error(name, fps), "(no error)") << name << " " << fps;
  }
}

TEST_F(MakeSink, FailsBeforeTheFirstFrameWhereItCannotWrite) {
  put(path("file"), "");
  for (const std::string& name : every_name()) {
    EXPECT_THROW(make_sink(path("file/" + name), {.scene = "flag"}), OutputError) << name;
    EXPECT_THROW(make_sink("/proc/" + name, {.scene = "flag"}), OutputError) << name;
  }
}

TEST_F(MakeSink, LeavesNothingIfDestroyedAtOnce) {
  for (const std::string& name : every_name()) {
    make_sink(path(name), {.scene = "flag"});
    EXPECT_EQ(file_count(), 0u) << name;
  }
}

TEST_F(MakeSink, WritesNothingWithoutFrames) {
  for (const std::string& name : every_name()) {
    const AnySink any = make_sink(path(name), {.scene = "flag"});
    EXPECT_TRUE(std::visit([](const auto& sink) { return sink->finish().empty(); }, any)) << name;
  }
  EXPECT_EQ(file_count(), 0u);
}

TEST_F(MakeSink, TakesAFileAsItIsWhereItIsGivenAFormat) {
  for (const OutputFormat& format : output_formats()) {
    if (format.of_steps()) continue;
    try_format(format, path("{scene} {frame}" + format.extension));
    EXPECT_TRUE(std::filesystem::exists(path("{scene} {frame}" + format.extension)));
  }
}

}  // namespace
