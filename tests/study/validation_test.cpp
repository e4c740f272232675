#include "study/validation.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "drape/scene/scene.hpp"
#include "study/known_answers.hpp"
#include "study/report.hpp"
#include "study/validation_measures.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

template <class Call>
void expect_usage_error(Call&& call, const std::string& message) {
  const std::string found = test::usage_error(std::forward<Call>(call));
  EXPECT_NE(found.find(message), std::string::npos) << found;
}

std::vector<std::string> names_of_cases() {
  std::vector<std::string> names;
  for (const ValidationCase& one : validation_cases()) {
    if (!one.quick.empty()) names.push_back(one.name);
  }
  return names;
}

ValidationStudy measured(const ValidationOptions& options) {
  ValidationStudy study = plan_validation(options);
  Progress progress;
  EXPECT_TRUE(measure_validation(study, options, {}, progress, [] {}));
  return study;
}

class QuickValidation : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(, QuickValidation, testing::ValuesIn(names_of_cases()), [](const auto& tested) {
  std::string name = tested.param;
  std::erase(name, '-');
  return name;
});

TEST_P(QuickValidation, IsMet) {
  const ValidationStudy study = measured({.cases = {GetParam()}, .quick = true, .patience = 1000});
  const ValidationVerdict verdict = verdict_of(study, study.cases.front(), scene_factor);
  EXPECT_TRUE(verdict.met) << verdict.worst_problem << " " << verdict.worst_answer << ": " << verdict.worst
                           << " of what is allowed; " << study.runs.front().failure;
  EXPECT_GT(verdict.answers, 0);
  const StudyReport report = validation_report(study);
  ASSERT_EQ(report.sections.size(), 1U);
  ASSERT_EQ(report.sections[0].motions.size(), 1U) << "its motion, to turn";
  EXPECT_GE(report.sections[0].motions[0].played.frames, study.runs.front().study_case.steps > 0 ? 2 : 1);
  EXPECT_LT(report.sections[0].motions[0].played.data.size(), 1'000'000U);
}

TEST(Validation, AWrongProblemIsNotMet) {
  ValidationStudy study = plan_validation({.cases = {"catenary"}, .quick = true});
  study.runs.front().study_case.overrides.emplace_back("cloth.mesh={grid=[8,1],pattern=\"alternating\",size=[2,0.05]}");
  Progress progress;
  ASSERT_TRUE(measure_validation(study, {}, {}, progress, [] {}));
  EXPECT_FALSE(all_met(study));
  EXPECT_NE(validation_report(study).headline.find("0 of 1"), std::string::npos);
}

TEST(Validation, HasFewerThan400RunsAndDefaultsWithoutAKeyAboutHow) {
  const ValidationStudy study = plan_validation({});
  EXPECT_LE(study.runs.size(), 400U);
  EXPECT_GE(study.cases.size(), 12U);
  const IntegratorSettings otherwise;
  for (const ValidationRun& run : study.runs) {
    if (run.factor != default_factor) continue;
    const SimulationSettings settings = run.study_case.load().simulation;
    EXPECT_EQ(settings.step, SimulationSettings{}.step) << run.name;
    EXPECT_FALSE(settings.accuracy) << run.name;
    EXPECT_EQ(settings.integrator.scheme, otherwise.scheme) << run.name;
    EXPECT_FALSE(settings.integrator.tolerance || settings.integrator.stop) << run.name;
    EXPECT_FALSE(settings.integrator.max_iterations) << run.name;
  }
}

/// Cases of bending, free flight, air and contact with one diagonal, alternating ones, both, and on an irregular mesh.
class OnAnyMesh : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(, OnAnyMesh,
                         testing::Values("bending-length", "heavy-cantilever", "clamped-plate", "free-flight",
                                         "terminal-velocity", "incline", "restitution", "stick-slip", "turntable",
                                         "capstan"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(OnAnyMesh, IsTheAnswerTheSame) {
  ValidationStudy study = plan_validation({.cases = {GetParam()}});
  std::erase_if(study.runs, [](const ValidationRun& run) { return run.factor != "mesh"; });
  ASSERT_EQ(study.runs.size() % 3, 0U) << "three meshes beside the scene's own";
  ASSERT_FALSE(study.runs.empty());
  EXPECT_EQ(study.runs.back().setting, "irregular");
  Progress progress;
  ASSERT_TRUE(measure_validation(study, {.patience = 1000}, {}, progress, [] {}));
  for (const ValidationRun& run : study.runs) {
    for (const KnownAnswer& answer : study.cases.front().problem(run.problem).answers) {
      const std::optional<double> value = run.value(answer.name);
      ASSERT_TRUE(value) << run.setting << ": " << run.failure;
      EXPECT_LE(in_tolerances(answer, *value), 1) << run.setting << ' ' << answer.name << ' ' << *value;
    }
  }
}

TEST(Validation, AMethodAloneIsVaried) {
  const ValidationStudy study = plan_validation({.cases = {"pendulum"}, .methods = {"semi-implicit"}});
  int varied = 0;
  for (const ValidationRun& run : study.runs) {
    if (run.factor != "method") continue;
    EXPECT_EQ(run.setting, "semi-implicit");
    ++varied;
  }
  EXPECT_EQ(varied, 1);
  expect_usage_error([] { plan_validation({.methods = {"verlett"}}); }, "did you mean 'verlet'?");
  expect_usage_error([] { plan_validation({.cases = {"catenery"}}); }, "did you mean 'catenary'?");
}

class ValidationRuns : public test::InScratchFolder {};

TEST_F(ValidationRuns, GoOnWhereTheyEnded) {
  const ValidationOptions options{.cases = {"pattern-stiffness"}, .quick = true};
  ValidationStudy study = measured(options);
  study.command = "drape study validation pattern-stiffness --quick";
  study.runs.back().measured = false;
  put(path("runs.csv"), validation_runs(study));
  ValidationStudy again = plan_validation(options);
  again.command = study.command;
  read_validation_runs(path("runs.csv"), again);
  EXPECT_FALSE(again.runs.back().measured);
  again.runs.back().measured = study.runs.back().measured = true;
  again.runs.back().seconds = study.runs.back().seconds;
  again.runs.back().names = study.runs.back().names;
  again.runs.back().values = study.runs.back().values;
  again.runs.back().step = study.runs.back().step;
  again.runs.back().cell = study.runs.back().cell;
  again.runs.back().vertices = study.runs.back().vertices;
  again.runs.back().rest_speed = study.runs.back().rest_speed;
  EXPECT_EQ(validation_runs(again), validation_runs(study));
  again.command = "drape study validation";
  expect_usage_error([&] { read_validation_runs(path("runs.csv"), again); }, "is of another command");
}

TEST_F(ValidationRuns, OfCsvAnswersAreJudged) {
  const ValidationCase of = validation_cases({"heavy-cantilever"}).front();
  put(path("a.csv"), "problem,quantity,value\ngamma-10,drop,0.7012\ngamma-10,reach,0.66\r\n");
  const std::vector<GivenAnswer> given = read_answers(of, path("a.csv"), "");
  ASSERT_EQ(given.size(), 2U);
  EXPECT_TRUE(given[0].met());
  EXPECT_FALSE(given[1].met());
  const auto expect_error = [&](const std::string& text, const std::string& message) {
    put(path("b.csv"), text);
    expect_usage_error([&] { read_answers(of, path("b.csv"), ""); }, message);
  };
  expect_error("", "there is no answer in it");
  expect_error("gamma-10,drop,0.7\n", "b.csv:1: expected the line problem,quantity,value");
  expect_error("problem,quantity,value\ngama-10,drop,0.7\n", "b.csv:2: heavy-cantilever has no problem 'gama-10'; did");
  expect_error("problem,quantity,value\ngamma-10,drip,0.7\n",
               "b.csv:2: problem 'gamma-10' has no quantity 'drip'; did");
  expect_error("problem,quantity,value\ngamma-10,drop,0.7m\n", "b.csv:2: expected a number, found '0.7m'");
  put(path("c.csv"), "problem,quantity,value\ngamma-10,drop,nan\n");
  EXPECT_FALSE(read_answers(of, path("c.csv"), "").front().met());
}

/// Returns the bytes of a little-endian number.
std::string bytes_of(std::uint64_t number, int count) {
  std::string bytes;
  for (int k = 0; k < count; ++k) bytes += static_cast<char>(number >> (8 * k) & 0xFFU);
  return bytes;
}

/// Makes an NPZ file with one array as numpy.savez writes it, without checksums.
std::string npz(const std::string& name, const std::string& header, const std::vector<double>& values) {
  std::string array = "\x93NUMPY";
  array += {1, 0};
  array += bytes_of(header.size(), 2) + header;
  for (const double value : values) array += bytes_of(std::bit_cast<std::uint64_t>(value), 8);
  const std::string file = name + ".npy", size = bytes_of(array.size(), 4), length = bytes_of(file.size(), 2);
  const std::string same =
      bytes_of(20, 2) + bytes_of(0, 2) + bytes_of(0, 2) + bytes_of(0, 4) + bytes_of(0, 4) + size + size + length;
  const std::string local = "PK\x03\x04" + same + bytes_of(0, 2) + file + array;
  const std::string entry = "PK\x01\x02" + bytes_of(20, 2) + same + bytes_of(0, 2) + bytes_of(0, 2) + bytes_of(0, 2) +
                            bytes_of(0, 2) + bytes_of(0, 4) + bytes_of(0, 4) + file;
  return local + entry + "PK\x05\x06" + bytes_of(0, 4) + bytes_of(1, 2) + bytes_of(1, 2) + bytes_of(entry.size(), 4) +
         bytes_of(local.size(), 4) + bytes_of(0, 2);
}

TEST_F(ValidationRuns, OfNpzMotionsAreMeasured) {
  const ValidationCase of = validation_cases({"pattern-stiffness"}).front();
  StudyCase study_case;
  study_case.scene = of.scene;
  const Vertices x = study_case.load().simulation.cloth.positions;
  std::vector<double> values;
  for (Eigen::Index i = 0; i < x.rows(); ++i) values.insert(values.end(), {x(i, 0), x(i, 1), x(i, 2)});
  const std::string shape = "{'descr': '<f8', 'fortran_order': False, 'shape': (81, 3), }";
  put(path("right.npz"), npz("positions", shape, values));
  const std::vector<GivenAnswer> right = read_answers(of, path("right.npz"), "diagonal-0");
  ASSERT_EQ(right.size(), 1U);
  EXPECT_TRUE(right.front().met()) << right.front().value;
  for (double& value : values) value *= 1.0001;
  put(path("wrong.npz"), npz("positions", shape, values));
  EXPECT_FALSE(read_answers(of, path("wrong.npz"), "diagonal-0").front().met());
  const auto expect_error = [&](const std::string& bytes, const std::string& problem, const std::string& message) {
    put(path("bad.npz"), bytes);
    expect_usage_error([&] { read_answers(of, path("bad.npz"), problem); }, message);
  };
  const std::string good = npz("positions", shape, values);
  expect_error(good, "", "expected --problem with the motion's problem");
  expect_error(good.substr(0, good.size() / 2), "diagonal-0", "expected an NPZ file");
  expect_error(npz("x", shape, values), "diagonal-0", "expected an array 'positions'");
  expect_error(npz("positions", "{'descr': '<f8', 'fortran_order': False, 'shape': (243,), }", values), "diagonal-0",
               "expected [times ×] 81 × 3 numbers");
  expect_error(npz("positions", "{'descr': '<f8', 'fortran_order': False, 'shape': (810, 3), }", values), "diagonal-0",
               "is damaged");
  expect_error(npz("positions", "{'descr': '<f8', 'fortran_order': True, 'shape': (81, 3), }", values), "diagonal-0",
               "in C order");
}

/// Shards divide the runs of a plan, and merged they are the plan again.
TEST_F(ValidationRuns, OfShardsAreThoseOfTheWhole) {
  const auto plan = [](const Shard& shard) {
    ValidationStudy study =
        plan_validation({.cases = {"pattern-stiffness", "pendulum"}, .quick = true, .shard = shard});
    study.command = "drape study validation pattern-stiffness pendulum --quick";
    for (ValidationRun& run : study.runs) {  // invented: measuring them would take a while
      run.measured = true;
      run.names = {"modulus"};
      run.values = {static_cast<double>(run.problem.size())};
      run.seconds = 0.5;
    }
    study.seconds = 1;
    return study;
  };
  const ValidationStudy whole = plan({});
  std::vector<std::filesystem::path> files;
  for (std::size_t k = 3; k >= 1; --k) {
    const ValidationStudy part = plan({k, 3});
    EXPECT_LT(part.runs.size(), whole.runs.size());
    files.push_back(put(path(std::to_string(k) + ".csv"), validation_runs(part)));
  }
  const MergedValidation merged = merge_validation(files);
  EXPECT_TRUE(merged.missing.empty());
  EXPECT_EQ(merged.study.seconds, 3);
  ASSERT_EQ(merged.study.runs.size(), whole.runs.size());
  for (std::size_t i = 0; i < whole.runs.size(); ++i) {
    EXPECT_EQ(merged.study.runs[i].problem, whole.runs[i].problem);
    EXPECT_EQ(merged.study.runs[i].values, whole.runs[i].values);
  }
  EXPECT_EQ(merged.study.missing(), 0U);
  EXPECT_EQ(validation_report(merged.study).headline.find("missing"), std::string::npos);
  ValidationStudy begun = plan({1, 3});
  begun.runs.front().measured = false;
  put(path("1.csv"), validation_runs(begun));
  const ValidationStudy unfinished = merge_validation(files).study;
  EXPECT_EQ(unfinished.missing(), 1U);
  EXPECT_TRUE(
      validation_report(unfinished).headline.starts_with(fmt::format("1 of {} runs are missing; ", whole.runs.size())))
      << validation_report(unfinished).headline;
  begun.provenance = {{"drape", "0.0.1, revision 1"}};
  put(path("1.csv"), validation_runs(begun));
  expect_usage_error([&] { merge_validation(files); }, "made by drape 0.0.1, revision 1, but the study by ");
  files.pop_back();
  const MergedValidation partly = merge_validation(files);
  ASSERT_EQ(partly.missing.size(), 1U);
  EXPECT_EQ(partly.missing.front().text(), "1/3");
  ValidationStudy other = plan({1, 3});
  other.command = "drape study validation";
  files.push_back(put(path("other.csv"), validation_runs(other)));
  expect_usage_error([&] { merge_validation(files); }, "are not of one study");
}

/// The ring of a flat disc covers all of it, one that hangs straight down nothing, and a folded sheet its shadow once.
TEST(Measures, DrapeIsTheShareOfTheRingThatCastsAShadow) {
  constexpr int sides = 96, center = 2 * sides;
  constexpr double outer = 0.2, held = 0.1;
  ObservedMotion disc;
  disc.times = {0};
  const auto shape = [](double radius, double depth) {
    Vertices x(center + 1, 3);
    x.row(center).setZero();
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * M_PI * i / sides;
      x.row(i) << held * std::cos(angle), held * std::sin(angle), 0;
      x.row(sides + i) << radius * std::cos(angle), radius * std::sin(angle), -depth;
    }
    return x;
  };
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    disc.cloth.triangles.push_back({center, i, next});
    disc.cloth.triangles.push_back({i, sides + i, sides + next});
    disc.cloth.triangles.push_back({i, sides + next, next});
  }
  const auto coefficient = [&](double radius, double depth) {
    disc.positions = {shape(radius, depth)};
    return measure_motion("drape", disc, {{"radius", outer}, {"held", held}}).at("coefficient");
  };
  EXPECT_NEAR(coefficient(outer, 0), 1, 4e-3);  // less by the polygon's sides
  EXPECT_NEAR(coefficient(held, 0.1), 0, 4e-3);
  EXPECT_NEAR(coefficient(outer * std::sqrt(0.625), 0.06), 0.5, 4e-3);
  EXPECT_NEAR(coefficient(0.05, 0.06), 0, 4e-3) << "what hangs below the support casts no other shadow";
}

TEST(Measures, ComputeWhatPositionsSay) {
  // A pendulum of 1 m that swings as cos 3t.
  ObservedMotion motion;
  motion.cloth.rest.resize(2, 3);
  motion.cloth.rest << 0, 0.5, 0, 0, -0.5, 0;
  motion.cloth.pins = {0};
  for (int i = 0; i <= 2000; ++i) {
    const double time = 1e-3 * i, angle = 0.1 * std::cos(3 * time);
    Vertices x(2, 3);
    x << 0, 0, 0, 0, std::sin(angle), -std::cos(angle);
    motion.times.push_back(time);
    motion.positions.push_back(x);
  }
  const double measured = measure_motion("pendulum", motion, {{"g", 9.0}}).at("period");
  EXPECT_NEAR(measured, 1, 1e-6);
  expect_usage_error([&] { measure_motion("pendulum", motion, {}); }, "the case gives no number 'g'");
  expect_usage_error([&] { measure_motion("pendulun", motion, {}); }, "did you mean 'pendulum'?");
}

TEST(Measures, OfStickSlipCountCyclesFromWhereItBreaksLoose) {
  // One vertex: at rest until the spring's force is that of friction, then as fast as the spring's end.
  constexpr double omega = 5, speed = 0.1, friction = 0.3, g = 9.8, loose = friction * g / (omega * omega * speed);
  ObservedMotion motion;
  motion.cloth.masses = Eigen::VectorXd::Ones(1);
  for (int i = 0; i <= 4000; ++i) {
    const double time = 1e-3 * i;
    motion.times.push_back(time);
    motion.positions.emplace_back(Vertices::Zero(1, 3));
    motion.positions.back()(0, 0) = 7 + speed * std::max(0.0, time - loose);
  }
  std::map<std::string, double> given{{"omega", omega}, {"friction", friction}, {"g", g}, {"speed", speed}};
  const auto found = measure_motion("stick-slip", motion, given);
  EXPECT_EQ(found.at("way--0.1"), 0);
  for (const auto& [name, cycles] : {std::pair{"way-0.25", 0.25}, {"way-1.5", 1.5}, {"way-2", 2.0}}) {
    EXPECT_NEAR(found.at(name), cycles, 1e-9) << name;
  }
  given.erase("speed");
  const double last = motion.positions.back()(0, 0);
  EXPECT_NEAR(measure_motion("stick-slip", motion, given).at("rest"), last * omega * omega / (friction * g), 1e-12);
  given["speed"] = speed / 2;  // so that it breaks loose too late for what there is of the motion
  expect_usage_error([&] { measure_motion("stick-slip", motion, given); }, "the motion is too short");
}

}  // namespace
}  // namespace drape
