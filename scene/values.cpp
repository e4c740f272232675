#include "scene/values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>
#include <vector>

#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/document.hpp"
#include "drape/scene/scene.hpp"

namespace drape {
namespace {

void expected(const char* what, const TomlValue& value, const std::string& name, Problems& problems) {
  problems.add(value.place, fmt::format("{}: expected {}, found {}", name, what, value.kind()));
}

bool is_file(const std::filesystem::path& path) {
  std::error_code error;
  const bool whole = path.native().find('\0') == std::string::npos;  // the system ends a name at a zero byte
  return whole && std::filesystem::is_regular_file(path, error);
}

}  // namespace

const TomlArray* read_array(const TomlValue& value, const std::string& name, std::size_t size, const char* what,
                            Problems& problems) {
  const TomlArray* array = value.as<TomlArray>();
  if (array == nullptr) {
    problems.add(value.place, fmt::format("{}: expected an array of {} {}, found {}", name, size, what, value.kind()));
  } else if (array->size() != size) {
    problems.add(value.place,
                 fmt::format("{}: expected an array of {} {}, found one of {}", name, size, what, array->size()));
    return nullptr;
  }
  return array;
}

std::string item_name(const std::string& name, std::size_t index) { return fmt::format("{}[{}]", name, index); }

std::string Range::text() const {
  std::string text;
  if (std::isfinite(minimum)) text = fmt::format("{} {}", minimum_excluded ? "above" : "at least", minimum);
  if (std::isfinite(maximum)) text += fmt::format("{}at most {}", text.empty() ? "" : " and ", maximum);
  return text;
}

std::optional<bool> read_bool(const TomlValue& value, const std::string& name, Problems& problems) {
  if (const bool* flag = value.as<bool>()) return *flag;
  expected("true or false", value, name, problems);
  return std::nullopt;
}

std::optional<int> read_int(const TomlValue& value, const std::string& name, const Range& range, Problems& problems) {
  const std::int64_t* whole = value.as<std::int64_t>();
  if (whole == nullptr) {
    expected("a whole number", value, name, problems);
    return std::nullopt;
  }
  Range representable = range;
  representable.minimum = std::max<double>(range.minimum, std::numeric_limits<int>::min());
  representable.maximum = std::min<double>(range.maximum, std::numeric_limits<int>::max());
  if (representable.contains(static_cast<double>(*whole))) return static_cast<int>(*whole);
  const Range& told = range.contains(static_cast<double>(*whole)) ? representable : range;
  problems.add(value.place, fmt::format("{} must be {}, found {}", name, told.text(), *whole));
  return std::nullopt;
}

std::optional<double> read_number(const TomlValue& value, const std::string& name, const Range& range,
                                  Problems& problems) {
  double number = 0;
  if (const std::int64_t* whole = value.as<std::int64_t>()) {
    number = static_cast<double>(*whole);
  } else if (const double* real = value.as<double>()) {
    number = *real;
  } else {
    expected("a number", value, name, problems);
    return std::nullopt;
  }
  if (!std::isfinite(number)) {
    problems.add(value.place, fmt::format("{} must be finite, found {}", name, number));
  } else if (!range.contains(number)) {
    problems.add(value.place, fmt::format("{} must be {}, found {}", name, range.text(), number));
  } else {
    return number;
  }
  return std::nullopt;
}

std::optional<std::string> read_string(const TomlValue& value, const std::string& name, Problems& problems) {
  if (const std::string* text = value.as<std::string>()) return *text;
  expected("a string", value, name, problems);
  return std::nullopt;
}

namespace {

/// Reads an array of as many numbers as the vector has.
/// @param read reads one of them: read_number() or read_int()
template <class Vector>
std::optional<Vector> read_array_of(const TomlValue& value, const std::string& name, const Range& range,
                                    const char* what, auto read, Problems& problems) {
  Vector vector = Vector::Zero();
  const TomlArray* array = read_array(value, name, static_cast<std::size_t>(vector.size()), what, problems);
  bool good = array != nullptr;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    const auto number = read((*array)[i], item_name(name, i), range, problems);
    good = good && number;
    if (number) vector[static_cast<Eigen::Index>(i)] = *number;
  }
  return good ? std::optional(vector) : std::nullopt;
}

}  // namespace

std::optional<Eigen::Vector3d> read_vector(const TomlValue& value, const std::string& name, const Range& range,
                                           Problems& problems) {
  return read_array_of<Eigen::Vector3d>(value, name, range, "numbers", read_number, problems);
}

std::optional<Eigen::Vector2d> read_pair(const TomlValue& value, const std::string& name, const Range& range,
                                         Problems& problems) {
  return read_array_of<Eigen::Vector2d>(value, name, range, "numbers", read_number, problems);
}

std::optional<Eigen::Vector2i> read_int_pair(const TomlValue& value, const std::string& name, const Range& range,
                                             Problems& problems) {
  return read_array_of<Eigen::Vector2i>(value, name, range, "whole numbers", read_int, problems);
}

std::optional<std::vector<int>> read_ints(const TomlValue& value, const std::string& name, const Range& range,
                                          Problems& problems) {
  const TomlArray* array = value.as<TomlArray>();
  if (array == nullptr) {
    expected("an array of whole numbers", value, name, problems);
    return std::nullopt;
  }
  std::vector<int> numbers;
  for (std::size_t i = 0; i < array->size(); ++i) {
    if (const auto number = read_int((*array)[i], item_name(name, i), range, problems)) numbers.push_back(*number);
  }
  return numbers.size() == array->size() ? std::optional(numbers) : std::nullopt;
}

std::optional<std::filesystem::path> read_file_name(const TomlValue& value, const std::string& name,
                                                    const std::filesystem::path& folder, Problems& problems) {
  const std::optional<std::string> text = read_string(value, name, problems);
  if (!text || text->empty()) return text ? std::optional(std::filesystem::path{}) : std::nullopt;

  std::filesystem::path beside_scene = folder / *text;
  if (is_file(beside_scene)) return beside_scene;
  if (value.place.override_number > 0 && problems.override_folder()) {
    beside_scene = *problems.override_folder() / *text;
    if (is_file(beside_scene)) return beside_scene;
  }
  if (std::error_code error; std::filesystem::is_directory(beside_scene, error)) {
    problems.add(value.place, fmt::format("{}: expected a file, but {} is a folder", name, shown(beside_scene)));
    return std::nullopt;
  }
  try {
    const std::filesystem::path in_data = data_folder() / "textures" / *text;
    if (is_file(in_data)) return in_data;
    problems.add(value.place,
                 fmt::format("{}: no such file: neither {} nor {}", name, shown(beside_scene), shown(in_data)));
  } catch (const UsageError& no_data_folder) {
    problems.add(value.place,
                 fmt::format("{}: no such file: {} (and {})", name, shown(beside_scene), no_data_folder.what()));
  }
  return std::nullopt;
}

std::string quoted_or(const std::string& first, const std::vector<std::string>& others) {
  std::string all = fmt::format("'{}'", first);
  for (const std::string& other : others) {
    all += fmt::format("{}'{}'", &other == &others.back() ? " or " : ", ", other);
  }
  return all;
}

namespace {

struct NamedColor {
  const char* name;
  std::uint32_t rgb;
};

// CSS Color Module Level 4, section 6.1.
constexpr NamedColor named_colors[] = {
    {"white", 0xffffff},  {"silver", 0xc0c0c0}, {"gray", 0x808080},  {"black", 0x000000}, {"red", 0xff0000},
    {"maroon", 0x800000}, {"yellow", 0xffff00}, {"olive", 0x808000}, {"lime", 0x00ff00},  {"green", 0x008000},
    {"aqua", 0x00ffff},   {"teal", 0x008080},   {"blue", 0x0000ff},  {"navy", 0x000080},  {"fuchsia", 0xff00ff},
    {"purple", 0x800080}, {"orange", 0xffa500},
};

Rgb unpack(std::uint32_t rgb) {
  const auto channel = [rgb](int shift) { return static_cast<double>((rgb >> shift) & 0xff) / 255; };
  return {channel(16), channel(8), channel(0)};
}

}  // namespace

std::span<const std::string> color_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const NamedColor& color : named_colors) list.emplace_back(color.name);
    return list;
  }();
  return names;
}

std::optional<Rgb> parse_color(std::string_view text) {
  for (const auto& [name, rgb] : named_colors) {
    if (text == name) return unpack(rgb);
  }
  if (text.empty() || text.front() != '#') return std::nullopt;
  std::string digits(text.substr(1));
  if (digits.size() == 3) digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
  if (digits.size() != 6) return std::nullopt;
  std::uint32_t rgb = 0;
  const char* const end = digits.data() + digits.size();
  if (std::from_chars(digits.data(), end, rgb, 16).ptr != end) return std::nullopt;
  return unpack(rgb);
}

std::string color_text(const Rgb& color) {
  const auto channel = [](double value) { return static_cast<int>(std::lround(value * 255)); };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(color.r), channel(color.g), channel(color.b));
}

namespace {

std::string number_text(double number) {
  const std::string text = fmt::format("{}", number);
  // Add a point: otherwise TOML would read an integer, whose range is smaller.
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::string toml_quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

namespace {

/// Returns a name as TOML writes it: bare if possible.
std::string name_text(const std::string& name) {
  const auto bare = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  return !name.empty() && std::ranges::all_of(name, bare) ? name : toml_quoted(name);
}

}  // namespace

std::string toml_literal(const TomlValue& value) {
  std::string text;
  if (const TomlTable* table = value.as<TomlTable>()) {
    for (const TomlEntry& entry : table->entries) {
      text += fmt::format("{}{} = {}", text.empty() ? "{ " : ", ", name_text(entry.name), toml_literal(entry.value));
    }
    return text.empty() ? "{}" : text + " }";
  }
  if (const TomlArray* array = value.as<TomlArray>()) {
    for (const TomlValue& item : *array) text += (text.empty() ? "" : ", ") + toml_literal(item);
    return "[" + text + "]";
  }
  if (const std::string* string = value.as<std::string>()) return toml_quoted(*string);
  if (const bool* flag = value.as<bool>()) return *flag ? "true" : "false";
  if (const std::int64_t* whole = value.as<std::int64_t>()) return fmt::format("{}", *whole);
  if (const double* number = value.as<double>()) return number_text(*number);
  return "1970-01-01";  // unused: no key accepts a date
}

}  // namespace drape
