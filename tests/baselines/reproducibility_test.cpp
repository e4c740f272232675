#include <gtest/gtest.h>

#include <fmt/format.h>
#include <iterator>
#include <map>
#include <thread>
#include <vector>

#include "sim/kernels/kernels.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

// The same scene and binary give the same bits, independent of the machine's load and settings.

namespace drape {
namespace {

namespace fs = std::filesystem;

class Reproducibility : public ::testing::Test {
 protected:
  /// Runs the built drape; @ stands for the folder of the homework's scenes.
  [[nodiscard]] test::Finished drape(const std::string& environment, std::string arguments) const {
    const std::string scenes = std::string(DRAPE_SOURCE_DIR) + "/scenes/homework/";
    for (std::size_t at = 0; (at = arguments.find('@', at)) != std::string::npos; at += scenes.size()) {
      arguments.replace(at, 1, scenes);
    }
    return test::drape(folder_, arguments, environment);
  }

  /// Returns the bytes of every picture of the film's first frames, and of the last positions.
  [[nodiscard]] std::map<std::string, std::string> film(const std::string& name, const std::string& environment = "",
                                                        const std::string& scene = "@5.toml") const {
    const auto finished = drape(environment, film_arguments(name, scene));
    EXPECT_EQ(finished.code, 0) << finished.text;
    return bytes(name);
  }

  [[nodiscard]] std::string film_arguments(const std::string& name, const std::string& scene) const {
    return fmt::format(
        "render {0} --quiet --set time.duration=1.2 --set video.size=[160,120] -o {1}/{{frame:02}}.png "
        "--positions {1}/positions.csv",
        scene, name);
  }

  [[nodiscard]] std::map<std::string, std::string> bytes(const std::string& name) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_.path() / name)) {
      files[entry.path().filename().string()] = test::content(entry.path());
    }
    return files;
  }

  test::SceneFolder folder_;
};

TEST_F(Reproducibility, TwoRunsGiveTheSameBytes) {
  const auto first = film("first");
  EXPECT_EQ(first.size(), 32u);  // frames 0 to 30 and the positions
  EXPECT_EQ(first, film("second"));
  EXPECT_NE(first.at("00.png"), first.at("30.png"));
}

TEST_F(Reproducibility, ThreadsOfTheRendererChangeNothing) {
  const auto one = film("one", "LP_NUM_THREADS=1");
  EXPECT_EQ(one, film("two", "LP_NUM_THREADS=2"));
  EXPECT_EQ(one, film("none", "LP_NUM_THREADS=0"));
}

TEST_F(Reproducibility, FourOthersAtOnceChangeNothing) {
  const auto alone = film("alone");
  std::vector<std::jthread> threads;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    threads.emplace_back([this, name] {
      const auto finished = drape("", film_arguments(name, "@5.toml"));
      EXPECT_EQ(finished.code, 0) << finished.text;
    });
  }
  threads.clear();
  for (const char* name : {"a", "b", "c", "d", "e"}) EXPECT_EQ(bytes(name), alone) << name;
}

TEST_F(Reproducibility, AFrameIsTheSameWhereverTheRangeBegins) {
  const auto whole = film("whole");
  for (const int first : {1, 7, 18, 30}) {
    const std::string name = fmt::format("from{}", first);
    const auto finished = drape("", film_arguments(name, "@5.toml") + fmt::format(" --frames {}..{}", first, first));
    EXPECT_EQ(finished.code, 0) << finished.text;
    const std::string picture = fmt::format("{:02}.png", first);
    EXPECT_EQ(test::content(folder_.path() / name / picture), whole.at(picture)) << first;
  }
}

TEST_F(Reproducibility, EveryInstructionSetGivesTheSameMotion) {
  for (const char* scene : {"1", "2", "4", "5"}) {  // all methods, and contact
    std::map<std::string, std::string> motions;
    for (const Kernels* kernels : all_kernels()) {
      if (kernels->supported() == 0) continue;
      const std::string name(kernels->name), file = std::string(scene) + name + ".csv";
      const auto finished = drape("DRAPE_ISA=" + name, fmt::format("simulate @{}.toml --quiet --set time.duration=2 "
                                                                   "--positions {}",
                                                                   scene, file));
      EXPECT_EQ(finished.code, 0) << finished.text;
      motions[name] = test::content(folder_.path() / file);
    }
    ASSERT_GE(motions.size(), 1u);
    for (const auto& [name, motion] : motions) EXPECT_EQ(motion, motions.begin()->second) << scene << ' ' << name;
  }
}

TEST_F(Reproducibility, WhatCrashesTheRendererIsRefused) {
  const auto finished = drape("LP_NATIVE_VECTOR_WIDTH=512", film_arguments("film", "@5.toml"));
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.text.find("LP_NATIVE_VECTOR_WIDTH is \"512\"; expected 128 or 256"), std::string::npos)
      << finished.text;
}

/// Settings that make drape or Mesa compute differently with equal results.
class Environment : public Reproducibility, public ::testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(Of, Environment,
                         ::testing::Values("DRAPE_ISA=sse2", "LP_NUM_THREADS=0", "LP_NUM_THREADS=1", "LP_NUM_THREADS=2",
                                           "LP_NATIVE_VECTOR_WIDTH=128", "GALLIUM_OVERRIDE_CPU_CAPS=sse2",
                                           "GALLIUM_OVERRIDE_CPU_CAPS=avx", "OPENBLAS_CORETYPE=Prescott",
                                           "OMP_NUM_THREADS=7", "LC_ALL=de_DE.UTF-8"));

TEST_P(Environment, PassesTheGoldensOfTheHomework) {
  const auto finished = drape(GetParam(), "check @1.toml @2.toml @3.toml @4.toml @5.toml --update none");
  EXPECT_EQ(finished.code, 0) << finished.text;
}

}  // namespace
}  // namespace drape
