#include "study/accuracy_runs.hpp"

#include <gtest/gtest.h>

#include "study/accuracy_report.hpp"
#include "tests/study/invented_study.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

using test::SceneFolder;

class Runs : public testing::Test {
 protected:
  /// Returns the error of a file with this text.
  std::string problem(const std::string& text) {
    folder_.write(runs_name, text);
    return test::usage_error([&] { read_runs(folder_.path()); });
  }

  SceneFolder folder_;
  std::string whole_ = runs_csv(test::invented_study());
};

TEST_F(Runs, HoldAllThatTheReportIsMadeOf) {
  const AccuracyStudy study = test::invented_study();
  folder_.write(runs_name, whole_);
  const AccuracyStudy again = read_runs(folder_.path());
  EXPECT_EQ(runs_csv(again), whole_);
  const StudyReport before = accuracy_report(study), after = accuracy_report(again);
  EXPECT_EQ(to_page(after), to_page(before));
  EXPECT_EQ(to_markdown(after), to_markdown(before));
  EXPECT_EQ(to_text(after), to_text(before));
  EXPECT_NE(to_page(after).find("an abacus, 10 rows"), std::string::npos);
}

// A user may have sorted the table.
TEST_F(Runs, MayHaveTheRowsOfAThingInAnyOrder) {
  const std::string two =
      "a,asked,implicit,backward-euler,0.001,1,estimate,0.001\n"
      "a,asked,implicit,backward-euler,0.001,2,estimate,0.001\n";
  const std::size_t at = whole_.find(two);
  ASSERT_NE(at, std::string::npos);
  const std::string row = two.substr(0, two.size() / 2);
  std::string moved = whole_;
  moved.erase(at, row.size());
  moved.insert(at + row.size(), row);
  folder_.write(runs_name, moved);
  EXPECT_EQ(runs_csv(read_runs(folder_.path())), whole_);
}

TEST_F(Runs, ThatAreCutAreSeenToBe) {
  const std::size_t half = whole_.find('\n', whole_.size() / 2) + 1;
  EXPECT_NE(problem(whole_.substr(0, half)).find("the file is cut: it ends without its last row"), std::string::npos);
  EXPECT_NE(problem(whole_.substr(0, half + 3)).find("the file is cut"), std::string::npos);
  std::string without = whole_;
  without.erase(half, whole_.find('\n', half) + 1 - half);
  EXPECT_NE(problem(without).find("rows before this, as it says"), std::string::npos);
  // Truncated anywhere: reported in one line, and never accepted as complete.
  for (std::size_t size = 0; size < whole_.size(); size += 997) {
    const std::string said = problem(whole_.substr(0, size));
    EXPECT_FALSE(said.empty()) << size;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST_F(Runs, OfAnotherKindAreRefusedWithTheirLine) {
  EXPECT_NE(problem("a,b\n1,2\n").find("runs.csv:1: expected the runs of a study"), std::string::npos);
  EXPECT_NE(problem("").find("runs.csv:1: expected"), std::string::npos);
  const auto changed = [this](const std::string& from, const std::string& to) {
    std::string text = whole_;
    text.replace(text.find(from), from.size(), to);
    return problem(text);
  };
  EXPECT_NE(changed("study,,,,,format,2", "study,,,,,format,7").find("format 2, found 7"), std::string::npos);
  EXPECT_NE(changed("solve_apart", "solve_aparts").find("'solve_apart' is missing"), std::string::npos);
  EXPECT_NE(changed(",estimate,0.001", ",estimate,many").find("expected a number, found 'many'"), std::string::npos);
  EXPECT_NE(changed(",asked,", ",askd,").find("did you mean 'asked'"), std::string::npos);
  EXPECT_NE(changed("asked,implicit", "asked,implicitly").find("did you mean 'implicit'"), std::string::npos);
  EXPECT_NE(changed(",1,estimate,", ",3,estimate,").find("of 'estimate'"), std::string::npos);
  const std::string line = changed(",estimate,0.001", ",estimate,many");
  EXPECT_NE(line.find("runs.csv:"), std::string::npos) << line;
  EXPECT_NE(test::usage_error([&] { read_runs(folder_.path() / "none"); }).find("runs.csv"), std::string::npos);
}

// Four of the invented steps end before the cloth buckles at 0.1 s, and one of these errs by four times its estimate.
TEST(EstimateCheck, CountsStepsBeforeAndAfterTheClothBuckles) {
  const SceneAccuracy scene = test::invented_scene("a");
  const EstimateCheck check = check_estimates(scene, scene.asked.front());
  EXPECT_EQ(check.judged, 4U);
  EXPECT_EQ(check.close, 3U);
  EXPECT_DOUBLE_EQ(check.worst_before, 4);
  EXPECT_EQ(check.after, 6U);
  EXPECT_DOUBLE_EQ(check.worst_after, 20);
  EXPECT_EQ(check.missed, 1U);
  EXPECT_EQ(check.unreported, 1U);
  SceneAccuracy reported = scene;
  reported.asked.front().converged.back() = 0;
  EXPECT_EQ(check_estimates(reported, reported.asked.front()).unreported, 0U);
  reported.asked.front().local_unknown.assign(10, 1);
  EXPECT_EQ(check_estimates(reported, reported.asked.front()).unknown, 10U);
}

}  // namespace
}  // namespace drape
