// Untrusted study runs: a report is made of them, or they are refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "drape/core/error.hpp"
#include "study/accuracy_runs.hpp"
#include "study/report.hpp"
#include "tests/study/invented_study.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

class StrangersStudy : public test::InScratchFolder {
 protected:
  /// Makes the report of drape study accuracy --report-only from lines, with a correct last line about their number.
  void report_on(std::vector<std::string> lines) const {
    lines.push_back(",end,,,,,rows," + std::to_string(lines.size() - 1));
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    put(folder_ / runs_name, text);
    const StudyReport report = accuracy_report(read_runs(folder_));
    EXPECT_FALSE(to_page(report).empty() || to_markdown(report).empty() || to_text(report, 80).empty());
  }
  /// Returns all lines but the last.
  static std::vector<std::string> good_lines() {
    AccuracyStudy study = test::invented_study();
    for (SceneAccuracy& scene : study.scenes) scene.notes.clear();  // notes contain line ends
    std::vector<std::string> lines;
    std::istringstream text(runs_csv(study));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    lines.pop_back();
    return lines;
  }
};

TEST_F(StrangersStudy, HasListsThatGoTogether) {
  const std::vector<std::string> good = good_lines();
  report_on(good);
  for (const std::string quantity : {"times", "apart", "step_gained", "motion_max", "error_max", "converged",
                                     "estimate", "local_error_unknown", "microseconds_per_step"}) {
    std::vector<std::string> lines = good;
    std::erase_if(lines, [&](const std::string& line) { return line.find("," + quantity + ",") != std::string::npos; });
    ASSERT_LT(lines.size(), good.size()) << quantity;
    EXPECT_NE(test::usage_error([&] { report_on(lines); }), "(no error)") << quantity;
  }
}

TEST_F(StrangersStudy, IsReportedOrRefusedWhateverItSays) {
  test::Random random(3);
  const std::vector<std::string> good = good_lines(),
                                 values{"", "nan", "-inf", "inf", "-1", "0", "1e308", "4e-324", "x"};
  int reported = 0;
  for (int i = 0; i < test::tries(300); ++i) {
    std::vector<std::string> lines = good;
    for (int k = 0; k < 2; ++k) {
      const auto at = 1 + static_cast<std::size_t>(random.below(static_cast<int>(lines.size()) - 1));
      std::string& line = lines[at];
      const int what = random.below(3);
      if (what == 0) lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
      if (what == 1) lines.push_back(std::string(line));
      if (what == 2) {
        line.resize(line.rfind(',') + 1);
        line += values[static_cast<std::size_t>(random.below(static_cast<int>(values.size())))];
      }
    }
    reported += test::usage_error([&] { report_on(lines); }) == "(no error)" ? 1 : 0;
  }
  EXPECT_GT(reported, 0);
}

}  // namespace
}  // namespace drape
