#include "study/motions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "study/accuracy_runs.hpp"
#include "study/validation.hpp"
#include "study/validation_measures.hpp"
#include "tests/study/invented_study.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

/// Makes a motion with every byte in its numbers.
StudyMotion invented_motion(const std::string& label) {
  StudyMotion motion{label, "drape render 'a \"b\".toml' -o motion.html", {}};
  motion.played.description = "{\"frames\": 3,\n\"scale\": [0.1]}";
  for (int i = 0; i < 700; ++i) motion.played.data += static_cast<char>(i);
  motion.played.texture = std::string("\x89PNG\0", 5);
  motion.played.frames = 3;
  motion.played.precision = 1.0 / 3;
  motion.played.size = 2.5;
  motion.played.vertices = 81;
  motion.played.triangles = 128;
  return motion;
}

void expect_same(const StudyMotion& found, const StudyMotion& expected) {
  EXPECT_EQ(found.label, expected.label);
  EXPECT_EQ(found.command, expected.command);
  EXPECT_EQ(found.played.description, expected.played.description);
  EXPECT_EQ(found.played.data, expected.played.data);
  EXPECT_EQ(found.played.texture, expected.played.texture);
  EXPECT_EQ(found.played.frames, expected.played.frames);
  EXPECT_EQ(found.played.precision, expected.played.precision);
  EXPECT_EQ(found.played.size, expected.played.size);
  EXPECT_EQ(found.played.vertices, expected.played.vertices);
  EXPECT_EQ(found.played.triangles, expected.played.triangles);
}

class MotionsFile : public test::InScratchFolder {
 protected:
  [[nodiscard]] std::string problem(const std::string& text) const {
    put(path(motions_name), text);
    return test::usage_error([&] { read_motions(path(motions_name)); });
  }
  const std::string whole_ = motions_csv({{"a.gif", invented_motion("the reference")}, {"b", invented_motion("x,\n")}});
};

TEST_F(MotionsFile, GivesMotionsBack) {
  put(path(motions_name), whole_);
  const std::vector<ShownMotion> found = read_motions(path(motions_name));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].part, "a.gif");
  EXPECT_EQ(found[1].part, "b");
  expect_same(found[0].motion, invented_motion("the reference"));
  expect_same(found[1].motion, invented_motion("x,\n"));
}

TEST_F(MotionsFile, LeavesOutMotionsTooLargeForABrowser) {
  put(path(motions_name), motions_csv({{"a", {"none", {}, {}}}, {"a", invented_motion("one")}}));
  EXPECT_EQ(read_motions(path(motions_name)).size(), 1U);
  EXPECT_TRUE(read_motions(path("none.csv")).empty());
}

TEST_F(MotionsFile, IsRefusedIfDamaged) {
  for (std::size_t size = 0; size < whole_.size(); size += 97) {
    const std::string said = problem(whole_.substr(0, size));
    EXPECT_NE(said.find("motions.csv:"), std::string::npos) << size << ": " << said;
  }
  const auto changed = [this](const std::string& from, const std::string& to) {
    std::string text = whole_;
    text.replace(text.find(from), from.size(), to);
    return problem(text);
  };
  EXPECT_NE(changed(",frames,3", ",frames,0").find("expected frames, found 0"), std::string::npos);
  EXPECT_NE(changed(",frames,3", ",frames,many").find("expected a number, found 'many'"), std::string::npos);
  EXPECT_NE(changed(",data,AAEC", ",data,{AEC").find("'data' is no base64"), std::string::npos);
  EXPECT_NE(changed(",motion,", ",film,").find("expected the kind 'motion', found 'film'"), std::string::npos);
}

TEST_F(MotionsFile, BringsThePlayersOfAnAccuracyPageBack) {
  AccuracyStudy study = test::invented_study();
  put(path("a-by-steps.gif"), "GIF89a");
  StudyPicture picture{"a-by-steps.gif", "GIF89a", "Side by side.", "drape study accuracy a.toml"};
  picture.motions = {invented_motion("the reference"), invented_motion("the worst")};
  study.pictures.front() = {picture};
  write_runs(study, path("."));
  const AccuracyStudy again = read_runs(path("."));
  ASSERT_EQ(again.pictures.front().size(), 1U);
  ASSERT_EQ(again.pictures.front().front().motions.size(), 2U);
  expect_same(again.pictures.front().front().motions.back(), picture.motions.back());
  EXPECT_EQ(to_page(accuracy_report(again)), to_page(accuracy_report(study)));
}

/// Merged shards show the motions of all of them, in the sections of their cases.
TEST_F(MotionsFile, BringsThePlayersOfAValidationPageBack) {
  std::vector<std::filesystem::path> files;
  std::size_t recorded = 0;
  for (std::size_t k = 1; k <= 2; ++k) {
    ValidationStudy part =
        plan_validation({.cases = {"pattern-stiffness", "rolled-sheet"}, .quick = true, .shard = {k, 2}});
    part.command = "drape study validation pattern-stiffness rolled-sheet --quick";
    Progress progress;
    ASSERT_TRUE(measure_validation(part, {}, {}, progress, [] {}));
    recorded += static_cast<std::size_t>(
        std::ranges::count_if(part.runs, [](const ValidationRun& run) { return run.played.frames > 0; }));
    const std::filesystem::path folder = path(std::to_string(k));
    std::filesystem::create_directories(folder);
    put(folder / motions_name, validation_motions(part));
    files.push_back(put(folder / validation_shard_name, validation_runs(part)));
  }
  EXPECT_EQ(recorded, 2U);
  const StudyReport report = validation_report(merge_validation(files).study);
  ASSERT_EQ(report.sections.size(), 2U);
  for (const StudySection& section : report.sections) EXPECT_EQ(section.motions.size(), 1U) << section.title;
}

}  // namespace
}  // namespace drape
