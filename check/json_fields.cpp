#include "check/json_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drape {
namespace {

constexpr int deepest = 8;  // levels of nesting; a manifest has three

}  // namespace

Json parse_json(std::string_view bytes) {
  const auto bounded = [](int depth, Json::parse_event_t, const Json&) {
    if (depth > deepest) throw std::invalid_argument(fmt::format("is nested more than {} deep", deepest));
    return true;
  };
  try {
    return Json::parse(bytes, bounded);
  } catch (const Json::parse_error& error) {
    const std::string_view before = bytes.substr(0, error.byte);
    throw std::invalid_argument(
        fmt::format("is not valid JSON: syntax error in line {}", 1 + std::count(before.begin(), before.end(), '\n')));
  } catch (const Json::exception&) {
    throw std::invalid_argument("holds a number that is too large");
  }
}

Fields::Fields(const Json& json, std::string name) : json_(json), name_(std::move(name)) {
  if (json.is_object()) return;
  throw std::invalid_argument(name_.empty() ? "is not a JSON object" : fmt::format("'{}' is not a JSON object", name_));
}

std::vector<Fields> Fields::objects(const char* key) const {
  if (!at(key).is_array()) fail(key, "a list");
  std::vector<Fields> all;
  for (const Json& json : at(key)) all.emplace_back(json, fmt::format("{}{}[{}].", name_, key, all.size()));
  return all;
}

std::string Fields::text(const char* key) const {
  if (!at(key).is_string()) fail(key, "a text");
  return at(key).get<std::string>();
}

bool Fields::flag(const char* key) const {
  if (!at(key).is_boolean()) fail(key, "true or false");
  return at(key).get<bool>();
}

double Fields::positive(const char* key, double least) const {
  const double value = number(key);
  if (!(value >= least)) fail(key, fmt::format("a number from {:g} on, found {:g}", least, value));
  return value;
}

Eigen::Vector3d Fields::point(const char* key) const {
  list(key, 3);
  Eigen::Vector3d values;
  for (int i = 0; i < 3; ++i) values[i] = number(at(key)[static_cast<std::size_t>(i)], key);
  return values;
}

Eigen::Vector2i Fields::pixels(const char* key) const {
  constexpr std::int64_t least = 16, most = 8192;  // as [check] size
  list(key, 2);
  const auto value = [&](std::size_t i) { return static_cast<int>(whole(at(key)[i], key, least, most)); };
  return {value(0), value(1)};
}

void Fields::fail(const char* key, std::string_view expected) const {
  throw std::invalid_argument(fmt::format("'{}{}': expected {}", name_, key, expected));
}

const Json& Fields::at(const char* key) const {
  const auto found = json_.find(key);
  if (found == json_.end()) throw std::invalid_argument(fmt::format("'{}{}' is missing", name_, key));
  return *found;
}

void Fields::list(const char* key, std::size_t count) const {
  if (!at(key).is_array() || at(key).size() != count) fail(key, fmt::format("{} numbers", count));
}

double Fields::number(const Json& json, const char* key) const {
  if (!json.is_number()) fail(key, "a number");
  return json.get<double>();
}

std::int64_t Fields::whole(const Json& json, const char* key, std::int64_t least, std::int64_t most) const {
  // Numbers above the largest signed one are stored as unsigned.
  const bool fits = json.is_number_integer() &&
                    (!json.is_number_unsigned() || json.get<std::uint64_t>() <= static_cast<std::uint64_t>(most));
  if (!fits || json.get<std::int64_t>() < least || json.get<std::int64_t>() > most) {
    fail(key, fmt::format("a whole number from {} to {}", least, most));
  }
  return json.get<std::int64_t>();
}

}  // namespace drape
