#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "study/accuracy_runs.hpp"
#include "study/profile.hpp"
#include "tests/study/invented_study.hpp"
#include "tests/support/files.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::interop {
namespace {

/// Makes eight scenes with random errors and times.
AccuracyStudy random_study() {
  AccuracyStudy study = test::invented_study();
  study.scenes.clear();
  test::Random random;
  const auto between = [&random](double low, double high) {
    return std::exp(random.between(std::log(low), std::log(high)));
  };
  for (int i = 0; i < 8; ++i) {
    SceneAccuracy scene = test::invented_scene("scene " + std::to_string(i));
    scene.options.methods = {step_methods.begin(), step_methods.end()};
    scene.step_gained = {between(1e-7, 1e-3)};
    scene.asked.clear();
    scene.fixed.clear();
    for (const StepMethod method : step_methods) {
      for (const double setting : {0.1, 0.01, 0.001}) {
        const double cost = between(1, 100);
        std::vector<double> costs(static_cast<std::size_t>(1 + random.below(30)));
        for (double& one : costs) one = cost * between(0.8, 1.2);
        auto& points = setting == 0.1 ? scene.asked : scene.fixed;
        points.push_back(test::invented_motion(scene.scene, method, setting, between(1e-5, 1e-2), costs));
        std::vector<double>& setup = points.back().measured.setup;
        setup.resize(costs.size());
        for (double& one : setup) one = between(0, 1e5);
      }
    }
    study.scenes.push_back(std::move(scene));
  }
  study.pictures.assign(study.scenes.size(), {});
  return study;
}

TEST(Profile, IsWhatScipyMakesOfTheRuns) {
  if (std::getenv("DRAPE_INTEROP") == nullptr) GTEST_SKIP() << "script/interop installs scipy and runs this";
  const AccuracyStudy study = random_study();
  const test::SceneFolder folder;
  folder.write("runs.csv", runs_csv(study));
  const std::string reader = "/usr/bin/python3 '" DRAPE_SOURCE_DIR "/tests/interop/readers/read_profile.py' ";
  const std::string out = (folder.path() / "out").string();
  ASSERT_EQ(std::system((reader + "'" + (folder.path() / "runs.csv").string() + "' > '" + out + "' 2>&1").c_str()), 0)
      << test::content(out);

  std::vector<std::string> notes;
  const std::vector<ProfileCurve> curves = performance_profile(profile_times(study.scenes, notes));
  std::size_t shares = 0, intervals = 0;
  std::istringstream lines(test::content(out));
  for (std::string kind; lines >> kind;) {
    if (kind == "s") {
      std::string solver;
      double tau = 0, share = 0;
      lines >> solver >> tau >> share;
      const auto curve = std::ranges::find(curves, solver, &ProfileCurve::solver);
      ASSERT_NE(curve, curves.end()) << solver;
      EXPECT_NEAR(curve->share(tau * (1 + 1e-12)), share, 1e-12) << solver << " within " << tau;
      ++shares;
      continue;
    }
    std::string point, method, scheme, setting;
    double lower = 0, upper = 0;
    lines >> point >> method >> scheme >> setting >> lower >> upper;
    // Scenes are in order, each with its runs in the order of the file.
    bool found = false;
    for (const SceneAccuracy& scene : study.scenes) {
      for (const auto* points : {&scene.asked, &scene.fixed}) {
        for (const MotionPoint& p : *points) {
          if (p.measured.microseconds.size() < fewest_for_interval) continue;
          found = found || (p.measured.time().lower == lower && p.measured.time().upper == upper);
        }
      }
    }
    EXPECT_TRUE(found) << point << " " << method << " " << scheme << " " << setting << " " << lower << " " << upper;
    ++intervals;
  }
  EXPECT_EQ(shares, 6 * step_methods.size());
  EXPECT_GT(intervals, 50U);
}

}  // namespace
}  // namespace drape::interop
