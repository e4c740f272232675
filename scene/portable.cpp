#include "drape/scene/scene.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <system_error>

#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "scene/mesh/source.hpp"
#include "scene/values.hpp"

namespace drape {
namespace {

std::filesystem::path chosen_data_folder;

bool is_folder(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

}  // namespace

void use_data_folder(const std::filesystem::path& folder) {
  if (!folder.empty() && !is_folder(folder)) throw UsageError("no such folder: " + shown(folder));
  chosen_data_folder = folder;
}

std::filesystem::path data_folder() {
  if (!chosen_data_folder.empty()) return chosen_data_folder;
  const std::filesystem::path installed = std::filesystem::path("share") / "drape";
  std::filesystem::path source = DRAPE_SOURCE_TREE;
  for (const auto& root : installation_roots()) {
    if (is_folder(root / installed)) return root / installed;
  }
  if (is_folder(source)) return source;
  std::filesystem::path configured = configured_prefix() / installed;
  if (is_folder(configured)) return configured;
  throw UsageError("no data folder found: none beside the program, and neither " + shown(configured) + " nor " +
                   shown(source) + " exists");
}

namespace {

/// Replacer of file names in a scene by their names in the portable scene.
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
      if (names_frames(*string)) return replace_frames(*string);
      const auto input = std::ranges::find_if(inputs_, [&](const auto& file) { return is_named(file, *string); });
      if (input != inputs_.end()) *string = name_of(*input);
    }
  }

  /// Adds input files that the scene does not name itself: other files refer to them.
  void add_others() {
    for (const std::filesystem::path& input : inputs_) {
      const std::string name = input.filename().string();
      const bool there = std::ranges::any_of(
          files_, [&](const PortableScene::File& file) { return file.place == input || file.name == name; });
      if (!there) files_.push_back({name, input});
    }
  }

 private:
  /// Renames a sequence like "body/{frame:04}.obj".
  void replace_frames(std::string& text) {
    const std::filesystem::path named = folder_ / text;
    const std::string before = fmt::format("file-{}-", files_.size() + 1);
    bool found = false;
    for (const std::filesystem::path& input : inputs_) {
      if (!is_frame(input, named)) continue;
      files_.push_back({before + input.filename().string(), input});
      found = true;
    }
    if (found) text = before + named.filename().string();
  }

  /// Returns true if `text` names the file, beside the scene or in the data folder's textures/.
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
  FileNames names(folder, inputs, scene.files);
  names.replace(document);
  names.add_others();
  for (const TomlEntry& list : document.as<TomlTable>()->entries) {  // before the first header
    if (list.value.as<TomlArray>() == nullptr) continue;
    scene.text += fmt::format("{} = {}\n", toml_quoted(list.name), toml_literal(list.value));
  }
  for (const TomlEntry& table : document.as<TomlTable>()->entries) {
    if (table.name == "check") continue;
    if (const TomlTable* entries = table.value.as<TomlTable>()) {
      scene.text += fmt::format("[{}]\n", toml_quoted(table.name));
      for (const TomlEntry& entry : entries->entries) {
        scene.text += fmt::format("{} = {}\n", toml_quoted(entry.name), toml_literal(entry.value));
      }
      scene.text += '\n';
    }
  }
  return scene;
}

}  // namespace drape
