#include "scene/portable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drape {
namespace {

/// A string in TOML's quotes.
std::string quoted(const std::string& text) {
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

std::string number_text(double number) {
  const std::string text = fmt::format("{}", number);
  // Without a point or an exponent it would be a whole number, of which TOML has fewer.
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string toml(const TomlValue& value) {
  std::string text;
  if (const TomlTable* table = value.as<TomlTable>()) {
    for (const TomlEntry& entry : table->entries) {
      text += fmt::format("{}{} = {}", text.empty() ? "{ " : ", ", quoted(entry.name), toml(entry.value));
    }
    return text.empty() ? "{}" : text + " }";
  }
  if (const TomlArray* array = value.as<TomlArray>()) {
    for (const TomlValue& item : *array) text += (text.empty() ? "" : ", ") + toml(item);
    return "[" + text + "]";
  }
  if (const std::string* string = value.as<std::string>()) return quoted(*string);
  if (const bool* flag = value.as<bool>()) return *flag ? "true" : "false";
  if (const std::int64_t* whole = value.as<std::int64_t>()) return fmt::format("{}", *whole);
  if (const double* number = value.as<double>()) return number_text(*number);
  return "1970-01-01";  // no key takes a date, so no scene has one
}

/// Gives the strings that name files the names that they have in the portable scene.
class FileNames {
 public:
  FileNames(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& inputs,
            std::vector<PortableScene::File>& files)
      : folder_(folder), inputs_(inputs), files_(files) {}

  void replace(TomlValue& value) {
    if (TomlTable* table = value.as<TomlTable>()) {
      for (TomlEntry& entry : table->entries) replace(entry.value);
    } else if (TomlArray* array = value.as<TomlArray>()) {
      for (TomlValue& item : *array) replace(item);
    } else if (std::string* string = value.as<std::string>(); string != nullptr && !string->empty()) {
      const auto input = std::ranges::find_if(inputs_, [&](const auto& file) { return is_named(file, *string); });
      if (input != inputs_.end()) *string = name_of(*input);
    }
  }

 private:
  /// Beside the scene, or else in the data folder's textures/.
  [[nodiscard]] bool is_named(const std::filesystem::path& file, const std::string& text) const {
    return file == folder_ / text || file.native().ends_with("/textures/" + text);
  }

  std::string name_of(const std::filesystem::path& file) {
    const auto found = std::ranges::find(files_, file, &PortableScene::File::place);
    if (found != files_.end()) return found->name;
    files_.push_back({fmt::format("file-{}{}", files_.size() + 1, file.extension().string()), file});
    return files_.back().name;
  }

  const std::filesystem::path& folder_;
  const std::vector<std::filesystem::path>& inputs_;
  std::vector<PortableScene::File>& files_;
};

}  // namespace

PortableScene make_portable(TomlValue document, const std::filesystem::path& folder,
                            const std::vector<std::filesystem::path>& inputs) {
  PortableScene scene;
  FileNames(folder, inputs, scene.files).replace(document);
  for (const TomlEntry& table : document.as<TomlTable>()->entries) {
    if (table.name == "check") continue;
    if (const TomlTable* entries = table.value.as<TomlTable>()) {
      scene.text += fmt::format("[{}]\n", quoted(table.name));
      for (const TomlEntry& entry : entries->entries) {
        scene.text += fmt::format("{} = {}\n", quoted(entry.name), toml(entry.value));
      }
      scene.text += '\n';
    }
  }
  return scene;
}

}  // namespace drape
