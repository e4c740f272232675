#include "study/validation_answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "core/nearest.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"
#include "import/npy.hpp"
#include "study/case.hpp"
#include "study/validation.hpp"
#include "study/validation_measures.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_answer_bytes = std::size_t{1} << 24;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const std::size_t begin = cell.find_first_not_of(" \t\r\""), end = cell.find_last_not_of(" \t\r\"");
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

const KnownAnswer& answer_called(const ValidationProblem& problem, const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  for (const KnownAnswer& answer : problem.answers) {
    if (answer.name == name) return answer;
    names.push_back(answer.name);
  }
  throw UsageError(fmt::format("{}: problem '{}' has no quantity '{}'{}", place, problem.name, name,
                               did_you_mean(name, names, "the quantities are")));
}

std::vector<GivenAnswer> answers_of_csv(const ValidationCase& of, const fs::path& file) {
  std::istringstream text(read_text(file, most_answer_bytes));
  std::vector<GivenAnswer> given;
  std::string line;
  std::size_t number = 0;
  while (std::getline(text, line)) {
    const std::string place = fmt::format("{}:{}", shown(file), ++number);
    const std::vector<std::string> cells = cells_of(line);
    if (cells.empty()) continue;
    if (cells.size() != 3) {
      throw UsageError(fmt::format("{}: expected problem,quantity,value, found {} cells", place, cells.size()));
    }
    if (number == 1) {
      if (cells != std::vector<std::string>{"problem", "quantity", "value"}) {
        throw UsageError(fmt::format("{}: expected the line problem,quantity,value", place));
      }
      continue;
    }
    GivenAnswer answer;
    try {
      answer.problem = &of.problem(cells[0]);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{}: {}", place, error.what()));
    }
    answer.known = &answer_called(*answer.problem, cells[1], place);
    const char* const end = cells[2].data() + cells[2].size();
    const auto [read, error] = std::from_chars(cells[2].data(), end, answer.value);
    if (error != std::errc() || read != end) {
      throw UsageError(fmt::format("{}: expected a number, found '{}'", place, shown(cells[2])));
    }
    given.push_back(answer);
  }
  if (given.empty()) throw UsageError(fmt::format("{}: there is no answer in it", shown(file)));
  return given;
}

/// Returns the states in an array of positions or velocities.
std::vector<Vertices> states_in(NpyStream& array, Eigen::Index vertices) {
  const std::vector<std::size_t>& shape = array.shape();
  const auto count = static_cast<std::size_t>(vertices);
  const bool one = shape.size() == 2, several = shape.size() == 3;
  if ((!one && !several) || shape.back() != 3 || shape[shape.size() - 2] != count) {
    array.fail(fmt::format("expected [times ×] {} × 3 numbers", count));
  }
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  std::vector<Vertices> states;
  const std::vector<double> values = array.rest();
  for (std::size_t begin = 0; begin < values.size(); begin += 3 * count) {
    states.emplace_back(Eigen::Map<const Rows>(values.data() + begin, vertices, 3));
  }
  return states;
}

std::vector<GivenAnswer> answers_of_npz(const ValidationCase& of, const fs::path& file, const std::string& name) {
  if (name.empty() && of.problems.size() > 1) {
    std::vector<std::string> names;
    for (const ValidationProblem& one : of.problems) names.push_back(one.name);
    throw UsageError(
        fmt::format("{}: expected --problem with the motion's problem, one of {}", shown(file), quoted_list(names)));
  }
  const ValidationProblem& problem = name.empty() ? of.problems.front() : of.problem(name);
  const ZipReader zip(file);
  const auto positions = array_named(zip, {"positions"}), velocities = array_named(zip, {"velocities"}),
             times = array_named(zip, {"times"});
  if (!positions) throw UsageError(fmt::format("{}: expected an array 'positions'", shown(file)));
  StudyCase what;
  what.scene = of.scene;
  what.overrides = problem.overrides;
  ObservedMotion motion;
  motion.cloth = what.load().simulation.cloth;
  const Eigen::Index vertices = motion.cloth.positions.rows();
  motion.positions = states_in(*positions, vertices);
  if (velocities) motion.velocities = states_in(*velocities, vertices);
  motion.times = times ? times->rest() : std::vector<double>(motion.positions.size(), 0.0);
  std::map<std::string, double> values;
  try {
    values = measure_motion(of.measure, motion, problem.given);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}: {}", shown(file), error.what()));
  }
  std::vector<GivenAnswer> given;
  for (const KnownAnswer& known : problem.answers) given.push_back({&problem, &known, values.at(known.name)});
  return given;
}

}  // namespace

bool GivenAnswer::met() const { return std::isfinite(value) && in_tolerances(*known, value) <= 1; }

std::vector<GivenAnswer> read_answers(const ValidationCase& of, const fs::path& file, const std::string& problem) {
  if (file.extension() == ".npz") return answers_of_npz(of, file, problem);
  if (!problem.empty()) throw UsageError("--problem belongs to an NPZ file: a CSV file names its problems itself");
  return answers_of_csv(of, file);
}

}  // namespace drape
