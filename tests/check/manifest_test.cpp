#include "check/manifest.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

Golden recorded() {
  Golden golden;
  golden.scene_digest = "0123456789abcdef";
  golden.size = {32, 24};
  golden.step = 0.02;
  golden.step_count = 100;
  golden.vertex_count = 2;
  golden.seconds_per_frame = 0.04;
  GoldenWindow window;
  window.frame = 3;
  window.time = 0.12;
  window.start = {Vertices::Zero(2, 3), Vertices::Zero(2, 3), 6};
  window.steps.push_back({0, Vertices::Zero(2, 3), {.kinetic = 1.0 / 3, .gravity = -2, .elastic = 0}});
  golden.windows = {window};
  return golden;
}

/// What is wrong with a manifest; empty if nothing is.
std::string manifest_refusal(const std::string& text) {
  try {
    read_manifest(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

/// The same of the manifest of recorded() with another value in a place, "/camera/margin".
std::string manifest_with(const std::string& place, const Json& value) {
  Json json = Json::parse(manifest_text(recorded()));
  json.at(Json::json_pointer(place)) = value;
  return manifest_refusal(json.dump());
}

TEST(Manifest, SummarizesTheWindows) {
  const Manifest read = read_manifest(manifest_text(recorded()));
  ASSERT_EQ(read.windows.size(), 1u);
  EXPECT_EQ(read.windows[0], summary_of(recorded().windows[0]));
  EXPECT_EQ(read.windows[0].last_step, 7);
}

TEST(Manifest, RefusesValuesThatMakeNoSense) {
  EXPECT_EQ(manifest_with("/quantum", 1e-6), "");
  for (const double quantum : {0.0, -1e-7, 5e-324, 1e-11}) {
    EXPECT_EQ(manifest_with("/quantum", quantum).find("'quantum': expected a number from 1e-10 on, found "), 0u)
        << quantum;
  }
  EXPECT_EQ(manifest_with("/vertices", 0), "'vertices': expected a whole number from 1 to 2147483647");
  EXPECT_NE(manifest_with("/vertices", 1e300), "");
  EXPECT_NE(manifest_with("/vertices", 1ULL << 63), "");
  EXPECT_NE(manifest_with("/steps", -1), "");
  EXPECT_NE(manifest_with("/step", 0), "");
  EXPECT_NE(manifest_with("/seconds_per_frame", -0.04), "");
  EXPECT_EQ(manifest_with("/size", {0, 24}), "'size': expected a whole number from 16 to 8192");
  EXPECT_NE(manifest_with("/size", {32, 100000}), "");
  EXPECT_EQ(manifest_with("/size", {32}), "'size': expected 2 numbers");
  EXPECT_EQ(manifest_with("/view/position", {0, 0, nullptr}), "'view.position': expected a number");
  EXPECT_NE(manifest_with("/view/position", {0, 0, 0}), "");  // where the target is
  EXPECT_NE(manifest_with("/view/up", {0, 0, 0}), "");
  EXPECT_NE(manifest_with("/view/field_of_view", 180), "");
  EXPECT_EQ(manifest_with("/camera/margin", "none"), "'camera.margin': expected a number");
  EXPECT_EQ(manifest_with("/machine", 7), "'machine.' is no JSON object");
  EXPECT_EQ(manifest_with("/windows/0/last_step", 101),
            "'windows[0].last_step': expected a whole number from 6 to 100");
  EXPECT_NE(manifest_with("/windows/0/frame", -1), "");
  EXPECT_NE(manifest_with("/format", 2), "");
}

TEST(Manifest, NeedsEveryValue) {
  const Json whole = Json::parse(manifest_text(recorded()));
  std::size_t values = 0;
  const Json flat = whole.flatten();
  for (const auto& [place, value] : flat.items()) {
    if (place.find("energies") != std::string::npos) continue;  // a window without steps has none
    Json json = whole;
    const Json::json_pointer pointer(place);
    if (!json.at(pointer.parent_pointer()).is_object()) continue;
    json.at(pointer.parent_pointer()).erase(pointer.back());
    EXPECT_NE(manifest_refusal(json.dump()).find("is missing"), std::string::npos) << place;
    ++values;
  }
  EXPECT_GT(values, 20u);
}

TEST(Manifest, RefusesDeepNesting) {
  const std::string text = manifest_text(recorded());
  for (const auto& [open, close] : {std::pair{"[", "]"}, std::pair{"{\"a\":", "}"}}) {
    std::string nested;
    for (int i = 0; i < 200'000; ++i) nested += open;
    EXPECT_NE(manifest_refusal(nested), "");
    nested += "0";
    for (int i = 0; i < 200'000; ++i) nested += close;
    EXPECT_EQ(manifest_refusal(nested), "is nested more than 8 deep");
    EXPECT_EQ(manifest_refusal("{\"x\": " + nested + "," + text.substr(1)), "is nested more than 8 deep");
  }
}

TEST(Manifest, SaysWhereItIsNoJson) {
  EXPECT_EQ(manifest_refusal(""), "is no JSON: something else is expected in line 1");
  EXPECT_EQ(manifest_refusal("{\n\"a\": 1,\n]"), "is no JSON: something else is expected in line 3");
  EXPECT_EQ(manifest_refusal("{\"a\": 1e999}"), "holds a number that is too large");
  EXPECT_EQ(manifest_refusal("[]"), "is no JSON object");
  std::string latin = manifest_text(recorded());
  latin.insert(latin.find("0123456789abcdef"), "\xE4");
  EXPECT_EQ(manifest_refusal(latin).find("is no JSON"), 0u);
}

}  // namespace
}  // namespace drape
