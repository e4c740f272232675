#include "sweep/page.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/files.hpp"
#include "tests/sweep/sweep_runs.hpp"

namespace drape {
namespace {

using test::request_of;
using test::sweep;
using test::tiny_scene;

/// Cloths in perpendicular planes, which are best seen from different sides.
constexpr const char* turned = "cloth.transform.rotate=[90, 0, 0],[90, 0, 90]";

class CommonSide : public testing::Test {
 protected:
  /// Returns the film of a sweep's run into a folder of that name.
  std::string film(const SweepRequest& request, const std::string& name, std::size_t run) {
    const SweepResults results = sweep(request, {.folder = folder_.path(name), .shard = {}});
    return test::content(run_place(folder_.path(name), results.plan.runs.at(run).key) / "film.gif");
  }

  [[nodiscard]] SweepRequest filmed(const std::vector<std::string>& varied) const {
    SweepRequest request = request_of(scene_, varied);
    request.films = {"gif"};
    return request;
  }

  test::SceneFolder folder_;
  std::filesystem::path scene_ =
      folder_.write("a.toml",
                    "[cloth]\nmesh = { grid = [2, 2] }\nstiffness = 10\npins = [0, 2]\n[time]\nstep = 0.01\n"
                    "duration = 0.1\n[effects.gravity]\n[video]\nsize = [64, 48]\n");
};

TEST_F(CommonSide, IsThatWhichSuitsTheFirstFilm) {
  const SweepRequest both = filmed({turned});
  const SweepPlan plan = make_plan(both);
  ASSERT_EQ(plan.side, std::size_t{0});
  const std::stop_source never;
  const Camera side = side_of_films(plan, never.get_token());
  const std::string given =
      fmt::format("camera={{ azimuth = {:.17g}, elevation = {:.17g} }}", side.azimuth.value(), side.elevation.value());

  SweepRequest second = filmed({"cloth.transform.rotate=[90, 0, 90]"});
  const std::string own = film(second, "own", 0);
  second.overrides = {given};
  const std::string as_the_first = film(second, "given", 0);
  EXPECT_NE(own, as_the_first) << "the second would be seen from another side";
  EXPECT_EQ(film(both, "both", 1), as_the_first);
  const SweepRequest first = filmed({"cloth.transform.rotate=[90, 0, 0]"});
  EXPECT_EQ(film(both, "both", 0), film(first, "first", 0));
}

TEST_F(CommonSide, IsNotChosenWhereTheCameraIsGiven) {
  SweepRequest request = filmed({turned});
  request.overrides = {"camera={ azimuth = 10, elevation = 20 }"};
  EXPECT_FALSE(make_plan(request).side);
  request.overrides = {"camera.position=[3, 3, 3]"};
  EXPECT_FALSE(make_plan(request).side);
  request.overrides = {};
  request.films = {};
  EXPECT_FALSE(make_plan(request).side) << "nothing is drawn";
}

TEST_F(CommonSide, ChangesTheKeysOfThoseThatAreSeenFromIt) {
  const SweepPlan two = make_plan(filmed({"cloth.stiffness=10,20"})),
                  three = make_plan(filmed({"cloth.stiffness=10,20,30"})),
                  other = make_plan(filmed({"cloth.stiffness=5,20"})),
                  alone = make_plan(filmed({"cloth.stiffness=20"}));
  EXPECT_EQ(two.runs[1].key, three.runs[1].key) << "values can be added";
  EXPECT_NE(two.runs[1].key, other.runs[1].key) << "it is seen as another one is";
  EXPECT_NE(two.runs[1].key, alone.runs[0].key);
  EXPECT_EQ(plan_json(plan_of(plan_json(two))), plan_json(two));
}

}  // namespace
}  // namespace drape
