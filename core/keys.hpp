#pragma once

#include <Eigen/Core>
#include <any>
#include <array>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/keyframe.hpp"
#include "core/rgb.hpp"

namespace drape {

/// One of several names; choosing one calls `set` with its place in `names`.
struct Choice {
  std::vector<std::string> names;
  std::function<void(std::size_t)> set;
  std::optional<std::size_t> initial = 0;  ///< the place of the one that holds so far: without the key, its default
};

/// A key whose value is of a kind of its own, such as a mesh or a file with a motion. Nothing here knows what it is:
/// whoever describes the table and whoever reads it do.
struct CustomValue {
  std::string form;  ///< for a reference page: "number or [x, y, z]"
  std::any target;   ///< a pointer to what is set if the key is given
};

/// Keyframes, [{ time = 0, NAME = [x, y, z] }, …], at times that increase from 0 on.
struct KeyframeList {
  std::vector<std::string> names;  ///< that the value can have, one and the same in the whole list
  std::vector<Keyframe>* keyframes = nullptr;
  std::function<void(std::size_t)> set_name = {};  ///< called with the place in `names` of the one that was used
  std::size_t name = 0;                            ///< the place of the one that holds
};

/// Vertices of the cloth, in the forms that [cloth] pins takes; ascending, each once.
struct VertexSelection {
  std::vector<int>* vertices = nullptr;
};

/// Three formulas, ["-x", "-y", "0"].
struct FormulaList {
  std::array<std::string, 3>* formulas = nullptr;
  /// What is wrong with a formula, as the end of a sentence that has named it; nothing if it is fine.
  std::function<std::optional<std::string>(const std::string&)> problem;
};

/// One key of a settings table: its name, the variable its value is written to, which values make sense, and one
/// sentence that says what it means. Readers, error messages and the reference pages are all made from this.
struct Key {
  using Target = std::variant<bool*, int*, double*, std::string*, std::filesystem::path*, Rgb*, Choice, CustomValue,
                              KeyframeList, VertexSelection, FormulaList, Eigen::Vector2i*, Eigen::Vector3d*,
                              std::vector<int>*, std::optional<int>*, std::optional<double>*, std::optional<Rgb>*,
                              std::optional<Eigen::Vector2i>*, std::optional<Eigen::Vector3d>*>;

  std::string name;
  Target target;
  std::string unit;  ///< "m", "N/m", "1/s²"; empty for a pure number
  std::string help;
  bool required = false;
  std::vector<std::string> alternatives = {};  ///< a required key may be left out where one of these is given
  double minimum = -std::numeric_limits<double>::infinity();  ///< applies to every component of a vector
  double maximum = std::numeric_limits<double>::infinity();
  bool minimum_excluded = false;

  Key& must_be_given() { return required = true, *this; }
  Key& must_be_given_unless(std::vector<std::string> others) {
    return required = true, alternatives = std::move(others), *this;
  }
  Key& at_least(double value) { return minimum = value, *this; }
  Key& at_most(double value) { return maximum = value, *this; }
  Key& above(double value) { return minimum = value, minimum_excluded = true, *this; }
};

/// The keys of one table, in the order in which a reference page lists them.
class Keys {
 public:
  /// Adds a key whose value goes to `target`, which must outlive this object. Returns it, to state its limits.
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

  /// The same for a choice that stays open without the key.
  template <class Enum>
  Key& choice(std::string name, std::optional<Enum>& target, std::vector<std::string> names, std::string help) {
    Choice choice{std::move(names), [&target](std::size_t index) { target = static_cast<Enum>(index); },
                  target ? std::optional(static_cast<std::size_t>(*target)) : std::nullopt};
    return add(std::move(name), std::move(choice), "", std::move(help));
  }

  /// Says what there is instead of a key that there was.
  void replace(const std::string& name, std::string advice) { replaced_[name] = std::move(advice); }

  [[nodiscard]] const std::deque<Key>& all() const { return keys_; }
  /// Keys that there were, and what there is instead of them.
  [[nodiscard]] const std::map<std::string, std::string>& replaced() const { return replaced_; }

 private:
  std::map<std::string, std::string> replaced_;
  std::deque<Key> keys_;  // a deque: the references that add() returns stay valid
};

}  // namespace drape
