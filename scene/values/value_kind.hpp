#pragma once

#include <deque>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "core/keys.hpp"
#include "drape/render/overlay/caption.hpp"
#include "drape/scene/document.hpp"
#include "scene/selection.hpp"
#include "scene/tables.hpp"
#include "scene/values.hpp"

namespace drape {

/// A key's value in a document, and its surroundings.
struct GivenValue {
  const Key& key;
  const TomlValue& value;
  const TomlTable& table;                     ///< contains the key
  const std::filesystem::path& folder;        ///< of the scene, which holds the files that it names
  const std::deque<PlacedSelection>* meshes;  ///< of all cloths; null before they are read
  Problems& problems;
  std::vector<std::filesystem::path>& files;  ///< receives the files that the value names

  [[nodiscard]] Range range() const { return {key.minimum, key.maximum, key.minimum_excluded}; }
  /// Adds a problem of the value; the message begins with the key's name.
  void report(const std::string& message) const { problems.add(value.place, key.name + ": " + message); }
};

/// A kind of value that a key may have: everything that the scene format does with it. registry.cpp lists all kinds.
class ValueKind {
 public:
  using Json = nlohmann::ordered_json;
  using Path = std::filesystem::path;

  virtual ~ValueKind() = default;

  /// Returns the types of Key::target with values of this kind.
  [[nodiscard]] virtual std::vector<std::type_index> types() const = 0;

  /// Reads a value into the key's target. A wrong one is a problem, and leaves the target as it is.
  virtual void read(const GivenValue& given) const = 0;

  /// Returns the target's value as scene text; empty for none. Different values have different texts.
  [[nodiscard]] virtual std::string text(const Key& key) const = 0;

  /// Returns the text that a motion's hash contains; nothing for a value that the hash omits.
  /// @param written the value in the document; null if absent
  /// @param folder  of the scene
  [[nodiscard]] virtual std::optional<std::string> hashed_text(const Key& key, const TomlValue* written,
                                                               const Path& folder) const;

  /// Returns the value for captions and logs; by default as the document writes it, or "none".
  [[nodiscard]] virtual FieldValue field(const Key& key, const TomlValue* written) const;

  /// Returns the description of the form in the reference: "[x, y, z]".
  [[nodiscard]] virtual std::string form(const Key& key) const = 0;

  /// Returns the accepted words, if they are a fixed set.
  [[nodiscard]] virtual std::vector<std::string> words(const Key& key) const;

  /// Returns the JSON schema of the value, with the key's limits and default.
  [[nodiscard]] virtual Json schema(const Key& key) const = 0;

  /// Returns the definition that schemas of this kind refer to with json_schema::reference(), if any.
  [[nodiscard]] virtual std::optional<std::pair<std::string, Json>> definition() const;
};

/// Returns the kind of a key's value.
/// @throws std::logic_error if the registry has none for the target's type
const ValueKind& kind_of(const Key& key);

/// Returns all kinds.
const std::vector<const ValueKind*>& value_kinds();

/// A kind of plain values: a key's target is a T, or an optional T whose default is no value.
template <class T>
class PlainKind : public ValueKind {
 public:
  [[nodiscard]] std::vector<std::type_index> types() const final { return {typeid(T*), typeid(std::optional<T>*)}; }
  void read(const GivenValue& given) const final {
    std::optional<T> value = parse(given);
    if (!value) return;
    if (auto* optional = given.key.pointer<std::optional<T>>()) {
      *optional = *std::move(value);
    } else {
      *given.key.pointer<T>() = *std::move(value);
    }
  }
  [[nodiscard]] std::string text(const Key& key) const final {
    const T* value = value_of(key);
    return value == nullptr ? "" : text_of(*value);
  }
  [[nodiscard]] FieldValue field(const Key& key, const TomlValue*) const final {
    const T* value = value_of(key);
    return value == nullptr ? FieldValue("default") : field_of(*value);
  }

 protected:
  /// Returns the target's value, or null if an optional one has none.
  static const T* value_of(const Key& key) {
    const auto* optional = key.pointer<std::optional<T>>();
    if (optional == nullptr) return key.pointer<T>();
    return *optional ? &**optional : nullptr;
  }

 private:
  /// Reads a value; returns nothing after a problem.
  [[nodiscard]] virtual std::optional<T> parse(const GivenValue& given) const = 0;
  [[nodiscard]] virtual std::string text_of(const T& value) const = 0;
  [[nodiscard]] virtual FieldValue field_of(const T& value) const = 0;
};

/// A kind whose target is a description such as Choice, or a pointer.
template <class Target>
class DescribedKind : public ValueKind {
 public:
  [[nodiscard]] std::vector<std::type_index> types() const final { return {typeid(Target)}; }

 protected:
  static const Target& target(const Key& key) { return *key.as<Target>(); }
};

/// A kind that the reader of the key's table interprets: its target only keeps the place in the document.
template <class Kind>
class DeferredKind : public DescribedKind<Written<Kind>> {
 public:
  void read(const GivenValue& given) const final { *this->target(given.key).value = &given.value; }
  std::string text(const Key&) const final { return ""; }
  std::optional<std::string> hashed_text(const Key&, const TomlValue*, const ValueKind::Path&) const final {
    return std::nullopt;  // the values made from it are hashed
  }
};

/// Formats a value as in a scene file, on one line, with strings bare.
std::string toml_text(const TomlValue& value);

}  // namespace drape
