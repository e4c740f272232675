#pragma once

#include <any>
#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace drape {

struct Keyframe;  // drape/sim/tracks.hpp

/// One of several names; choosing one calls `set` with its index in `names`.
struct Choice {
  std::vector<std::string> names;
  std::function<void(std::size_t)> set;
  std::optional<std::size_t> initial = 0;  ///< index of the default
};

/// Keyframes, [{ time = 0, NAME = [x, y, z] }, …], at increasing times from 0.
struct KeyframeList {
  std::vector<std::string> names;  ///< possible names of the value; a list uses one of them throughout
  std::vector<Keyframe>* keyframes = nullptr;
  std::function<void(std::size_t)> set_name = {};  ///< called with the index in `names` of the name that was used
  std::size_t name = 0;                            ///< index of the current name
};

/// Vertices of the cloth, in the forms that [cloth] pins accepts; ascending, without duplicates.
struct VertexSelection {
  std::vector<int>* vertices = nullptr;
};

/// Three formulas, ["-x", "-y", "0"].
struct FormulaList {
  std::array<std::string, 3>* formulas = nullptr;
  /// Checks a formula. Returns the problem as the end of a sentence that names the formula, or nothing.
  std::function<std::optional<std::string>(const std::string&)> problem;
};

/// Name of the only cloth that an effect acts on; empty: all cloths.
struct ClothName {
  std::string* name = nullptr;
};

/// One key of a settings table: name, target variable, valid range and a sentence of help. Readers, error messages and
/// reference pages are all made from it.
struct Key {
  /// A pointer to the variable that the key sets, or a description such as Choice. Its type determines the kind of
  /// value, see ValueKind.
  using Target = std::any;

  std::string name;
  Target target;
  std::string unit;  ///< "m", "N/m", "1/s²"; empty for a pure number
  std::string help;
  bool required = false;
  std::vector<std::string> alternatives = {};  ///< a required key may be left out if one of these is given
  double minimum = -std::numeric_limits<double>::infinity();  ///< applies to every component of a vector
  double maximum = std::numeric_limits<double>::infinity();
  bool minimum_excluded = false;
  /// False if a motion's hash omits it: it affects only pictures or the length of the run, or what is made of it is
  /// in the hash.
  bool hashed = true;

  /// Returns the target if it has this type, otherwise null.
  template <class T>
  [[nodiscard]] const T* as() const {
    return std::any_cast<T>(&target);
  }
  /// Returns the variable if the target is a pointer to one of this type, otherwise null.
  template <class T>
  [[nodiscard]] T* pointer() const {
    T* const* variable = as<T*>();
    return variable == nullptr ? nullptr : *variable;
  }

  Key& must_be_given() { return required = true, *this; }
  Key& must_be_given_unless(std::vector<std::string> others) {
    return required = true, alternatives = std::move(others), *this;
  }
  Key& at_least(double value) { return minimum = value, *this; }
  Key& at_most(double value) { return maximum = value, *this; }
  Key& omit_from_hash() { return hashed = false, *this; }
  Key& above(double value) { return minimum = value, minimum_excluded = true, *this; }
};

/// The keys of one table, in the order in which a reference page lists them.
class Keys {
 public:
  /// Adds a key that writes to `target`, which must outlive this object. Returns the key, to set its limits.
  Key& add(std::string name, Key::Target target, std::string unit, std::string help) {
    return keys_.emplace_back(
        Key{.name = std::move(name), .target = std::move(target), .unit = std::move(unit), .help = std::move(help)});
  }

  /// Adds a key that takes one of `names`; the i-th name sets `target` to the enumerator with value i.
  template <class Enum>
  Key& choice(std::string name, Enum& target, std::vector<std::string> names, std::string help) {
    Choice choice{std::move(names), [&target](std::size_t index) { target = static_cast<Enum>(index); },
                  static_cast<std::size_t>(target)};
    return add(std::move(name), std::move(choice), "", std::move(help));
  }

  /// Adds a choice whose default is open.
  template <class Enum>
  Key& choice(std::string name, std::optional<Enum>& target, std::vector<std::string> names, std::string help) {
    Choice choice{std::move(names), [&target](std::size_t index) { target = static_cast<Enum>(index); },
                  target ? std::optional(static_cast<std::size_t>(*target)) : std::nullopt};
    return add(std::move(name), std::move(choice), "", std::move(help));
  }

  /// Registers the advice for a key that was removed.
  void replace(const std::string& name, std::string advice) { replaced_[name] = std::move(advice); }

  [[nodiscard]] const std::deque<Key>& all() const { return keys_; }
  /// Returns the removed keys and the advice for each.
  [[nodiscard]] const std::map<std::string, std::string>& replaced() const { return replaced_; }

 private:
  std::map<std::string, std::string> replaced_;
  std::deque<Key> keys_;  // a deque: the references that add() returns stay valid
};

}  // namespace drape
