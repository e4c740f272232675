#include "check/manifest.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/support/hostile_names.hpp"
#include "tests/support/sample_golden.hpp"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

Golden recorded() { return test::sample_golden(2, 100, 20, {3, 8}); }

std::string manifest() { return manifest_text(recorded(), "fedcba9876543210"); }

/// Returns the error of a manifest; empty if it is valid.
std::string manifest_refusal(const std::string& text) {
  try {
    read_manifest(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

/// Returns the error of recorded()'s manifest with another value at a place such as "/camera/margin".
std::string manifest_with(const std::string& place, const Json& value) {
  Json json = Json::parse(manifest());
  json.at(Json::json_pointer(place)) = value;
  return manifest_refusal(sealed_manifest(json.dump()));
}

TEST(Manifest, GivesBackWhatWasWritten) {
  const Manifest read = read_manifest(manifest());
  EXPECT_EQ(read.motion_hash, "fedcba9876543210");
  ASSERT_EQ(read.golden.frames.size(), 2u);
  EXPECT_EQ(read.golden.frames[1].frame, 8);
  EXPECT_EQ(read.golden.frames[1].why, "the start");
  EXPECT_EQ(read.golden.quanta, recorded().quanta);
  EXPECT_EQ(sealed_manifest(manifest()), manifest());
}

TEST(Manifest, KnowsItsOwnText) {
  std::string text = manifest();
  text.replace(text.find("\"steps\": 100"), 12, "\"steps\": 101");
  EXPECT_EQ(manifest_refusal(text), "has been modified since it was recorded");
  EXPECT_EQ(manifest_refusal(manifest() + " "), "has been modified since it was recorded");
  EXPECT_EQ(manifest_refusal("{\"format\": 1}"),
            "was recorded by an older drape in format 1; this one reads formats 3 and 4");
  EXPECT_EQ(manifest_refusal("{\"format\": 5}"),
            "was recorded by a newer drape in format 5; this one reads formats 3 and 4");
}

TEST(Manifest, MayBeOfFormat3WithoutGroups) {
  Json json = Json::parse(manifest());
  json["format"] = 3;
  json.erase("groups");
  json["camera"].erase("outside");
  const Golden golden = read_manifest(sealed_manifest(json.dump())).golden;
  EXPECT_EQ(golden.group_count, 0);
  EXPECT_EQ(golden.camera.outside, 0);
}

TEST(Manifest, SaysNothingToATerminal) {
  for (const std::string& name : test::hostile_names) {
    Json json = Json::parse(manifest());
    for (auto& [key, value] : json.at("machine").items()) value = name;
    json.at("frames").at(0).at("why") = json.at("date") = name;
    const std::string text = sealed_manifest(json.dump(2, ' ', false, Json::error_handler_t::replace));
    const Golden golden = read_manifest(text).golden;
    for (const std::string& said :
         {golden.machine.drape, golden.machine.processor, golden.machine.renderer, golden.frames[0].why, golden.date}) {
      EXPECT_FALSE(test::has_controls(said)) << said;
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
  }
}

TEST(Manifest, RefusesValuesThatMakeNoSense) {
  EXPECT_EQ(manifest_with("/quanta/compared", 1e-6), "");
  for (const double quantum : {0.0, -1e-7, 5e-324, 1e-11}) {
    EXPECT_EQ(manifest_with("/quanta/compared", quantum).find("'quanta.compared': expected a number from "), 0u)
        << quantum;
  }
  EXPECT_EQ(manifest_with("/quanta/position", 0), "");
  EXPECT_EQ(manifest_with("/quanta/position", -1e-7), "'quanta.position': expected 0 or a number above it");
  EXPECT_EQ(manifest_with("/vertices", 0), "'vertices': expected a whole number from 1 to 2147483647");
  EXPECT_NE(manifest_with("/vertices", 1e300), "");
  EXPECT_NE(manifest_with("/vertices", 1ULL << 63), "");
  EXPECT_NE(manifest_with("/steps", -1), "");
  EXPECT_NE(manifest_with("/step", 0), "");
  EXPECT_NE(manifest_with("/seconds_per_frame", -0.04), "");
  EXPECT_EQ(manifest_with("/size", {0, 24}), "'size': expected a whole number from 16 to 8192");
  EXPECT_NE(manifest_with("/size", {32, 100000}), "");
  EXPECT_EQ(manifest_with("/size", {32}), "'size': expected 2 numbers");
  EXPECT_EQ(manifest_with("/frames/0/view/position", {0, 0, nullptr}), "'frames[0].view.position': expected a number");
  EXPECT_NE(manifest_with("/frames/0/view/position", {0, 0, 0}), "");  // equal to the target
  EXPECT_NE(manifest_with("/frames/0/view/up", {0, 0, 0}), "");
  EXPECT_NE(manifest_with("/frames/0/view/field_of_view", 180), "");
  EXPECT_EQ(manifest_with("/camera/margin", "none"), "'camera.margin': expected a number");
  EXPECT_EQ(manifest_with("/machine", 7), "'machine.' is not a JSON object");
  EXPECT_NE(manifest_with("/frames/0/frame", -1), "");
  EXPECT_NE(manifest_with("/frames/1/frame", 3), "");  // the same frame twice
  EXPECT_NE(manifest_with("/window_steps", 0), "");
  EXPECT_NE(manifest_with("/format", 5), "");
  EXPECT_EQ(manifest_with("/film", nullptr), "'film.' is not a JSON object");
  EXPECT_NE(manifest_with("/film/fps", 0), "");
  EXPECT_NE(manifest_with("/film/speed", -1), "");
  EXPECT_NE(manifest_with("/film/size", {0, 480}), "");
  EXPECT_EQ(manifest_with("/film/samples", 0), "'film.samples': expected a whole number from 1 to 64");
}

TEST(Manifest, KeepsTheFilmsSettings) {
  const std::optional<GoldenFilm> film = read_manifest(manifest()).golden.film;
  ASSERT_TRUE(film);
  EXPECT_EQ(film->fps, 12.5);
  EXPECT_EQ(film->speed, 0.5);
  EXPECT_EQ(film->size, Eigen::Vector2i(640, 480));
  EXPECT_EQ(film->samples, 2);
}

TEST(Manifest, KeepsTheCamera) {
  Golden golden = recorded();
  golden.camera = {.position = Eigen::Vector3d(1, 2, 3),
                   .target = Eigen::Vector3d(4, 5, 6),
                   .up = {0, 1, 0},
                   .field_of_view = 20,
                   .azimuth = 7,
                   .elevation = 8,
                   .margin = 0.1,
                   .follow = true,
                   .orbit = 9,
                   .outside = 0.25};
  const Camera read = read_manifest(manifest_text(golden, "fedcba9876543210")).golden.camera;
  EXPECT_TRUE(same_camera(read, golden.camera));
  EXPECT_EQ(read.outside, 0.25);
  Camera other = golden.camera;
  other.outside = 0;
  EXPECT_FALSE(same_camera(other, golden.camera));
}

TEST(Manifest, KeepsTheTime) {
  const std::optional<GoldenTime> time = read_manifest(manifest()).golden.time;
  ASSERT_TRUE(time);
  EXPECT_EQ(time->steps, 20);
  EXPECT_EQ(time->ratio, 123.5);
  EXPECT_NE(manifest_with("/time/steps", 0), "");
  EXPECT_NE(manifest_with("/time/steps", 101), "");  // more than the motion has
  EXPECT_NE(manifest_with("/time/ratio", 0), "");
}

TEST(Manifest, MayBeWithoutTheFilmsSettings) {
  Golden golden = recorded();
  golden.film.reset();
  const std::string text = manifest_text(golden, "fedcba9876543210");
  EXPECT_EQ(text.find("\"film\""), std::string::npos);
  EXPECT_FALSE(read_manifest(text).golden.film);
}

TEST(Manifest, NeedsEveryValue) {
  const Json whole = Json::parse(manifest());
  std::size_t values = 0;
  const Json flat = whole.flatten();
  for (const auto& [place, value] : flat.items()) {
    if (place == "/checksum" || place == "/camera/outside") continue;  // goldens of format 3 lack the latter
    Json json = whole;
    const Json::json_pointer pointer(place);
    if (!json.at(pointer.parent_pointer()).is_object()) continue;
    json.at(pointer.parent_pointer()).erase(pointer.back());
    EXPECT_NE(manifest_refusal(sealed_manifest(json.dump())).find("is missing"), std::string::npos) << place;
    ++values;
  }
  EXPECT_GT(values, 20u);
}

TEST(Manifest, RefusesDeepNesting) {
  const std::string text = manifest();
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
  EXPECT_EQ(manifest_refusal(""), "is not valid JSON: syntax error in line 1");
  EXPECT_EQ(manifest_refusal("{\n\"a\": 1,\n]"), "is not valid JSON: syntax error in line 3");
  EXPECT_EQ(manifest_refusal("{\"a\": 1e999}"), "holds a number that is too large");
  EXPECT_EQ(manifest_refusal("[]"), "is not a JSON object");
  std::string latin = manifest();
  latin.insert(latin.find("0123456789abcdef"), "\xE4");
  EXPECT_EQ(manifest_refusal(latin).find("is not valid JSON"), 0u);
}

}  // namespace
}  // namespace drape
