#include "study/validation_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/names_in_folders.hpp"
#include "core/nearest.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"
#include "scene/scene.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* case_format = "drape validation case 1";
constexpr const char* cases_folder = "scenes/validation";
constexpr std::size_t most_case_bytes = std::size_t{1} << 22;

/// A JSON object with access to members by name.
class CaseObject {
 public:
  CaseObject(const Json& json, std::string place) : json_(json), place_(std::move(place)) {
    if (!json.is_object()) fail("expected an object");
  }

  [[nodiscard]] std::string text(const char* key) const { return of<std::string>(key, "a text"); }
  [[nodiscard]] std::string text_or(const char* key, std::string otherwise) const {
    return has(key) ? text(key) : std::move(otherwise);
  }
  [[nodiscard]] double number(const char* key) const {
    if (!at(key).is_number()) fail(fmt::format("expected a number as '{}'", key));
    return at(key).get<double>();
  }
  [[nodiscard]] std::vector<std::string> texts(const char* key) const {
    return has(key) ? of<std::vector<std::string>>(key, "a list of texts") : std::vector<std::string>{};
  }
  [[nodiscard]] std::map<std::string, double> numbers(const char* key) const {
    return has(key) ? of<std::map<std::string, double>>(key, "numbers by name") : std::map<std::string, double>{};
  }
  [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }
  [[nodiscard]] std::vector<CaseObject> objects(const char* key) const {
    std::vector<CaseObject> list;
    if (!has(key)) return list;
    if (!at(key).is_array()) fail(fmt::format("expected a list as '{}'", key));
    for (const Json& one : at(key)) list.emplace_back(one, place_);
    return list;
  }
  [[nodiscard]] CaseObject object(const char* key) const { return {at(key), place_}; }
  [[noreturn]] void fail(const std::string& sentence) const {
    throw UsageError(fmt::format("{}: {}", place_, sentence));
  }

 private:
  [[nodiscard]] const Json& at(const char* key) const {
    if (!has(key)) fail(fmt::format("expected a member '{}'", key));
    return json_.at(key);
  }
  template <class T>
  [[nodiscard]] T of(const char* key, const char* kind) const {
    try {
      return at(key).get<T>();
    } catch (const Json::exception&) {
      fail(fmt::format("expected {} as '{}'", kind, key));
    }
  }

  const Json& json_;
  std::string place_;
};

KnownAnswer read_answer(const CaseObject& from, const ValidationCase& of) {
  KnownAnswer answer;
  answer.name = from.text("name");
  answer.curve = from.text_or("curve", answer.name);
  answer.x = from.number("x");
  answer.value = from.number("value");
  answer.tolerance = from.number("tolerance");
  if (!(answer.tolerance > 0)) from.fail("expected a tolerance above 0");
  const auto is_curve = [&](const ValidationCurve& curve) { return curve.name == answer.curve; };
  if (std::ranges::none_of(of.curves, is_curve)) from.fail(fmt::format("there is no curve '{}'", answer.curve));
  return answer;
}

ValidationProblem read_problem(const CaseObject& from, const ValidationCase& of) {
  ValidationProblem problem;
  problem.name = from.text("name");
  problem.overrides = from.texts("set");
  problem.given = from.numbers("given");
  problem.given.insert(of.given.begin(), of.given.end());
  for (const CaseObject& answer : from.objects("answers")) problem.answers.push_back(read_answer(answer, of));
  if (problem.answers.empty()) from.fail(fmt::format("problem '{}' has no answers", problem.name));
  return problem;
}

ValidationFactor read_factor(const CaseObject& from, const ValidationCase& of) {
  ValidationFactor factor{from.text("factor"), of.problem(from.text("problem")).name, {}};
  for (const CaseObject& one : from.objects("runs")) {
    const std::string name = one.text("name");
    factor.variants.push_back({name, factor.factor == "method" ? name : "", one.texts("set")});
  }
  return factor;
}

std::vector<std::string> known_cases(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (fs::exists(entry.path() / "case.json", error)) names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace

const ValidationProblem& ValidationCase::problem(const std::string& called) const {
  std::vector<std::string> names;
  for (const ValidationProblem& one : problems) {
    if (one.name == called) return one;
    names.push_back(one.name);
  }
  throw UsageError(
      fmt::format("{} has no problem '{}'{}", name, called, did_you_mean(called, names, "the problems are")));
}

ValidationCase read_validation_case(const fs::path& file, const std::string& scene_folder) {
  const Json json = Json::parse(read_text(file, most_case_bytes), nullptr, false, true);
  if (json.is_discarded()) throw UsageError(fmt::format("{}: expected JSON", shown(file)));
  const CaseObject from(json, shown(file));
  if (from.text("format") != case_format) from.fail(fmt::format("expected the format '{}'", case_format));
  ValidationCase result;
  result.name = file.parent_path().filename().string();
  result.title = from.text("title");
  result.question = from.text("question");
  result.theory = from.text("theory");
  result.source = from.text("source");
  result.mesh = from.text("mesh");
  result.scene = scene_folder + "/" + name_in_folder(from.text("scene"), shown(file), "scene");
  result.measure = from.text("measure");
  result.x_title = from.text("x");
  result.given = from.numbers("given");
  if (from.has("rest")) {
    result.only_end = true;
    result.rest_speed = from.object("rest").number("speed");
    result.rest_after = from.object("rest").number("after");
  }
  for (const CaseObject& one : from.objects("curves")) {
    result.curves.push_back({one.text("name"), one.text("title"), one.text("how")});
  }
  if (result.curves.empty()) from.fail("expected at least one curve");
  result.default_overrides = from.texts("default");
  for (const CaseObject& one : from.objects("problems")) result.problems.push_back(read_problem(one, result));
  if (result.problems.empty()) from.fail("expected at least one problem");
  result.quick = from.texts("quick");
  for (const std::string& name : result.quick) static_cast<void>(result.problem(name));
  if (from.has("quick_set")) result.quick_overrides = from.texts("quick_set");
  for (const CaseObject& one : from.objects("vary")) result.factors.push_back(read_factor(one, result));
  return result;
}

std::vector<ValidationCase> validation_cases(const std::vector<std::string>& names) {
  const fs::path folder = data_folder() / cases_folder;
  const std::vector<std::string> known = known_cases(folder);
  if (known.empty()) throw UsageError(fmt::format("{}: there is no case in it", shown(folder)));
  std::vector<ValidationCase> cases;
  for (const std::string& name : names.empty() ? known : names) {
    if (std::ranges::find(known, name) == known.end()) {
      throw UsageError(fmt::format("unknown case '{}'{}", name, did_you_mean(name, known, "the cases are")));
    }
    const auto same = [&](const ValidationCase& one) { return one.name == name; };
    if (std::ranges::any_of(cases, same)) continue;
    cases.push_back(read_validation_case(folder / name / "case.json", fmt::format("{}/{}", cases_folder, name)));
  }
  return cases;
}

}  // namespace drape
