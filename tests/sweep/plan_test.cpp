#include <gtest/gtest.h>

#include "tests/sweep/sweep_runs.hpp"

namespace drape {
namespace {

using test::least_scene;
using test::request_of;
using test::SceneFolder;
using test::tiny_scene;
using test::usage_error;

class Plan : public testing::Test {
 protected:
  std::string problems(const std::vector<std::string>& varied) {
    try {
      make_plan(request_of(scene_, varied));
      return "(no error)";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return folder_.without_folder(error.what());
    }
  }

  SceneFolder folder_;
  std::filesystem::path scene_ = folder_.write("a.toml", tiny_scene);
};

TEST_F(Plan, FindsOneBadValueAmongTwoHundredRuns) {
  EXPECT_EQ(problems({"cloth.stiffness=1..19/19,-1", "integrator.tolerance=1e-1..1e-10/10log"}),
            "--vary cloth.stiffness=-1: stiffness must be above 0, found -1 (in 10 of 200 runs, of which the first has "
            "cloth.stiffness = -1, integrator.tolerance = 0.1)");
}

TEST_F(Plan, TellsEveryProblemOnce) {
  const std::string text = problems({"cloth.stifness=1,2", "integrator.tolerance=1e-3,-1"});
  EXPECT_NE(text.find("did you mean 'stiffness'?"), std::string::npos) << text;
  EXPECT_NE(text.find("--vary integrator.tolerance=-1: "), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;  // one for both values, and the tolerance
}

TEST_F(Plan, RefusesWhatMakesNoSense) {
  EXPECT_EQ(problems({"cloth.mass=1", "cloth.mass=2"}), "--vary cloth.mass is there twice");
  SweepRequest request = request_of(scene_, {});
  for (const char* film : {"png", "drape", "gfi"}) {
    request.films = {film};
    EXPECT_NE(usage_error([&] { make_plan(request); }), "(no error)") << film;
  }
}

TEST_F(Plan, RefusesARunAndNotTheSweepWhereValuesDoNotGoTogether) {
  const SweepPlan plan = make_plan(request_of(scene_, {"integrator.method=liu13,verlet", "time.step=0.001,0.09"}));
  ASSERT_EQ(plan.runs.size(), 4U);
  for (const std::size_t fine : {0U, 1U, 2U}) EXPECT_EQ(plan.runs[fine].refusal, "") << fine;
  EXPECT_NE(plan.runs[3].refusal.find("step"), std::string::npos);
  EXPECT_NE(problems({"integrator.method=verlet", "time.step=0.08,0.09"}).find("step"), std::string::npos)
      << "all are refused";
}

/// Springs of 1e9 N/m are too stiff for short steps: what is compared with them takes their method, too.
TEST_F(Plan, RunsShareTheMethodThatIsChosen) {
  const std::string text = least_scene + "duration = 0.1\n";
  const std::filesystem::path file = folder_.write("unnamed.toml", text);
  const auto shared = [&](const std::vector<std::string>& varied) {
    std::vector<std::string> methods;
    const SweepPlan plan = make_plan(request_of(file, varied));
    for (const PlannedRun& run : plan.runs) {
      methods.push_back(method_name(load_scene(file, overrides_of(plan, run)).simulation.integrator.method));
    }
    return methods;
  };
  using Methods = std::vector<std::string>;
  EXPECT_EQ(shared({"cloth.stiffness=10,20"}), (Methods{"verlet", "verlet"}));
  EXPECT_EQ(shared({"cloth.stiffness=10,1e9"}), (Methods{"quasi-newton", "quasi-newton"}));
  EXPECT_EQ(shared({"cloth.stiffness=10,1e9", "integrator.method=liu13,auto"}),
            (Methods{"liu13", "quasi-newton", "liu13", "quasi-newton"}));
  const SweepPlan plan = make_plan(request_of(file, {"cloth.stiffness=10,1e9"}));
  EXPECT_EQ(plan_of(plan_json(plan)).runs.front().shared, plan.runs.front().shared);
  EXPECT_EQ(plan.runs.front().key,
            make_plan(request_of(file, {"cloth.stiffness=10", "integrator.method=quasi-newton"})).runs.front().key);
}

TEST_F(Plan, GivesKeysOfWhatIsRunAndOfNothingElse) {
  const auto key = [&](const std::string& text, const std::vector<std::string>& varied, const std::string& name) {
    const std::filesystem::path file = folder_.write(name, text);
    return make_plan(request_of(file, varied)).runs.at(0).key;
  };
  const std::string first = key(tiny_scene, {}, "a.toml");
  EXPECT_EQ(key("# a comment\n" + tiny_scene + "[check]\nsize = [32, 32]\n", {}, "b.toml"), first);
  EXPECT_EQ(key(tiny_scene + "[sweep]\nvary = { \"cloth.mass\" = [1, 2] }\n", {}, "c.toml"), first);
  EXPECT_EQ(key(tiny_scene, {"cloth.stiffness=10"}, "d.toml"), first);  // same value as in the file
  EXPECT_NE(key(tiny_scene, {"cloth.stiffness=11"}, "e.toml"), first);
  SweepRequest longer = request_of(scene_, {});
  longer.steps = 3;
  EXPECT_NE(make_plan(longer).runs.at(0).key, first);
}

TEST_F(Plan, KnowsTheFilesThatASceneNames) {
  const auto key_with = [&](const std::string& height) {
    folder_.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 " + height + "\nf 1 2 3\n");
    return make_plan(
               request_of(
                   folder_.write("m.toml", "[cloth]\nmesh = \"mesh.obj\"\nstiffness = 10\n[time]\nstep = 0.01\n"), {}))
        .runs.at(0)
        .key;
  };
  EXPECT_NE(key_with("0"), key_with("0.5"));
}

TEST_F(Plan, EstimatesThatEffectsTakeTime) {
  const std::vector<std::string> effects{"effects.self_collision={}", "effects.strain_limit={max_stretch=1.1}"};
  const std::string scene = folder_.write("large.toml",
                                          "[cloth]\nmesh = { grid = [30, 30] }\nstiffness = 10\n[time]\n"
                                          "step = 0.01\n[integrator]\nmethod = \"liu13\"\n");
  SweepRequest request;
  request.scenes = {scene};
  const double bare = make_plan(request).runs.front().cost;
  for (const std::string& effect : effects) {
    request.overrides = {effect};
    const double cost = make_plan(request).runs.front().cost;
    EXPECT_GT(cost, 1.2 * bare) << effect << ": it looks at every vertex many times in a step";
    request.overrides.push_back("time.duration=50");  // ten times as long
    EXPECT_NEAR(make_plan(request).runs.front().cost / cost, 10, 0.5);
  }
}

TEST_F(Plan, IsReadFromTheTableSweepOfAFile) {
  const std::filesystem::path file = folder_.write(
      "plan.toml",
      "[sweep]\nscenes = [\"a.toml\"]\nfilm = \"gif\"\nsteps = 4\nset = [\"cloth.mass=2\"]\n"
      "[sweep.vary]\nintegrator.method = [\"liu13\", \"implicit\"]\n\"cloth.stiffness\" = \"10..30/3\"\n");
  SweepRequest request;
  request.scenes = add_sweep_table(file.string(), request);
  EXPECT_EQ(request.scenes, std::vector<std::string>{scene_.string()});
  EXPECT_EQ(make_plan(request).runs.size(), 6U);
  EXPECT_EQ(request.films, std::vector<std::string>{"gif"});
  EXPECT_EQ(request.steps, 4);
  EXPECT_EQ(request.varied.at(0).values, (std::vector<std::string>{"liu13", "implicit"}));

  const std::filesystem::path wrong =
      folder_.write("wrong.toml", "[sweep]\nvery = 1\nsteps = -1\n[sweep.vary]\ncloth.mass = 3\ntime.step = []\n");
  const std::string text =
      folder_.without_folder(usage_error([&] { static_cast<void>(add_sweep_table(wrong.string(), request)); }));
  EXPECT_NE(text.find("wrong.toml:2:1: unknown key 'very' in [sweep]; did you mean 'vary'?"), std::string::npos)
      << text;
  EXPECT_NE(text.find("wrong.toml:3:9: steps: expected a whole number from 0 on, found -1"), std::string::npos) << text;
  EXPECT_NE(text.find("wrong.toml:6:13: time.step: expected an array of values, or a text as --vary takes it, found an "
                      "empty array"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("wrong.toml:5:14: cloth.mass: expected an array of values"), std::string::npos) << text;
}

}  // namespace
}  // namespace drape
