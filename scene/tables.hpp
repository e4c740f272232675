#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/keys.hpp"
#include "scene/scene.hpp"
#include "sim/effects/effect.hpp"
#include "sim/fabrics.hpp"

namespace drape {

/// A value as it stands in the file, see scene/document.hpp.
struct TomlValue;

/// What [cloth] and [cloth.transform] say, before it is made into a Cloth.
struct ClothTable {
  const TomlValue* mesh = nullptr;
  const TomlValue* rest = nullptr;
  const TomlValue* pins = nullptr;
  const Fabric* material = nullptr;          ///< of what nothing else says
  double mass = 1;                           ///< of the whole, where no density is said [kg]
  std::optional<double> density;             ///< [kg/m²]
  std::optional<double> stiffness, modulus;  ///< at most one; of every spring, and by area [N/m]
  enum class Springs { edges, edges_and_bend } springs = Springs::edges;
  std::optional<double> shear_stiffness, bend_stiffness;  ///< of edges_and_bend; else as `stiffness` [N/m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();     ///< [m/s]

  const TomlValue* scale = nullptr;
  Eigen::Vector3d rotate = Eigen::Vector3d::Zero();     ///< [degrees]
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();  ///< [m]
};

/// A table of the scene format.
struct TableType {
  std::string name;  ///< "cloth.transform"
  std::string help;
  Keys keys;
  bool required = false;
  bool repeatable = false;  ///< may be written as [[name]] several times
};

/// Every table of a scene but its effects, whose keys write to `cloth` and `scene`. With effect_types() the only
/// description of the format: reading, error messages and the reference page are made from it.
std::vector<TableType> scene_tables(ClothTable& cloth, Scene& scene);

/// The table of an effect of this type, whose keys write to it.
TableType effect_table(const EffectType& type, Effect& effect);

/// A key as a reference shows it.
struct KeyText {
  std::string name;
  std::string form;                 ///< of its value, with its range: "number, above 0"
  std::vector<std::string> values;  ///< all it takes, where it takes one of a few
  std::string unit, initial, help;  ///< `initial` is what holds without the key; empty: nothing of that form
  bool required = false;
  std::vector<std::string> alternatives;  ///< a required key may be left out where one of these is given
};

/// A table as a reference shows it. Its help and those of its keys are one paragraph of Markdown.
struct TableText {
  std::string name, help;
  bool repeatable = false;
  std::vector<KeyText> keys;
};

/// Every table of a scene, effects last.
std::vector<TableText> reference_tables();

/// The format's reference: a heading and a table of keys for each table, in Markdown.
std::string format_reference();

}  // namespace drape
