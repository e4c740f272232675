#include "scene/portable.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/value_text.hpp"

namespace drape {
namespace {

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
