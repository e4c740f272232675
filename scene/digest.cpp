#include "scene/digest.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/hash.hpp"

namespace drape {
namespace {

/// Appends the canonical form of a value.
void write(const TomlValue& value, const std::vector<std::string>& ignored, std::string& text) {
  if (const TomlTable* table = value.as<TomlTable>()) {
    std::vector<const TomlEntry*> entries;
    for (const TomlEntry& entry : table->entries) {
      if (std::find(ignored.begin(), ignored.end(), entry.name) == ignored.end()) entries.push_back(&entry);
    }
    std::sort(entries.begin(), entries.end(), [](const auto* a, const auto* b) { return a->name < b->name; });
    text += '{';
    for (const TomlEntry* entry : entries) {
      text += fmt::format("{}:{}=", entry->name.size(), entry->name);
      write(entry->value, {}, text);
    }
    text += '}';
  } else if (const TomlArray* array = value.as<TomlArray>()) {
    text += '[';
    for (const TomlValue& item : *array) write(item, {}, text);
    text += ']';
  } else if (const std::string* string = value.as<std::string>()) {
    text += fmt::format("{}:{};", string->size(), *string);
  } else if (const bool* flag = value.as<bool>()) {
    text += *flag ? "true;" : "false;";
  } else if (const std::int64_t* whole = value.as<std::int64_t>()) {
    text += fmt::format("{:.17g};", static_cast<double>(*whole));
  } else if (const double* number = value.as<double>()) {
    text += fmt::format("{:.17g};", *number);
  } else {
    text += "date;";
  }
}

}  // namespace

std::string digest(const TomlValue& document, const std::vector<std::string>& ignored) {
  std::string text;
  write(document, ignored, text);
  return checksum_of(text);
}

}  // namespace drape
