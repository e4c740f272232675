#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/keys.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/effect.hpp"

namespace drape {

/// A value of a document, see scene/document.hpp.
struct TomlValue;

/// A value that the reader of its table interprets, see DeferredKind: its place in the document, null if absent.
template <class Kind>
struct Written {
  const TomlValue** value;
};
class FilesKind;
class MeshKind;
class PinsKind;
class ScaleKind;
class SeamSideKind;

/// The values of [cloth] and [cloth.transform], before they become a Cloth.
struct ClothTable {
  std::string name;  ///< empty: it is the only one
  const TomlValue* mesh = nullptr;
  const TomlValue* rest = nullptr;
  const TomlValue* pins = nullptr;
  const Fabric* material = nullptr;  ///< default of values that are not given
  double mass = 1;                   ///< total mass where no density is given [kg]
  std::optional<double> density;     ///< [kg/m²]
  std::optional<double> stiffness;   ///< of every spring [N/m]
  std::optional<WarpWeft> modulus;   ///< instead: by area [N/m]
  double warp = 0;                   ///< angle of the warp in the rest shape [degrees]
  enum class Springs { edges, edges_and_bend } springs = Springs::edges;
  std::optional<double> shear_stiffness, bend_stiffness;  ///< for edges_and_bend; default `stiffness` [N/m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();     ///< [m/s]

  std::optional<Rgb> color;       ///< instead of the look's
  std::filesystem::path texture;  ///< likewise; empty: none of its own

  const TomlValue* scale = nullptr;
  Eigen::Vector3d rotate = Eigen::Vector3d::Zero();     ///< [degrees]
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();  ///< [m]
};

/// The values of [seam], before they become a Seam.
struct SeamTable {
  const TomlValue* a = nullptr;
  const TomlValue* b = nullptr;
  double time = 1;       ///< [s]
  bool reverse = false;  ///< side b runs the other way
};

/// A table of the scene format.
struct TableType {
  std::string name;  ///< "cloth.transform"
  std::string help;
  Keys keys;
  bool required = false;
  bool repeatable = false;  ///< can be written as [[name]] several times; read by its own reader
  enum class Affects { motion, picture, nothing } affects = Affects::motion;  ///< nothing: no golden depends on it
};

/// Returns the tables of a cloth: [cloth] and [cloth.transform].
std::vector<TableType> cloth_tables(ClothTable& cloth);

/// Returns the table of a seam.
TableType seam_table(SeamTable& seam);

/// Returns every table of a scene except its cloths, its seams and its effects.
std::vector<TableType> other_tables(Scene& scene);

/// Returns every table of a scene except its effects; the keys write to `cloth`, `seam` and `scene`. Together with
/// effect_types() it is the only description of the format: reader, messages and reference page are made from it.
std::vector<TableType> scene_tables(ClothTable& cloth, SeamTable& seam, Scene& scene);

/// Returns the names of the other_tables() that affect this.
std::vector<std::string> tables_that_affect(TableType::Affects what);

/// Returns the table of an effect of this type; its keys write to the effect.
TableType effect_table(const EffectType& type, Effect& effect);

/// Calls `use` with every table of a scene, its effects included. The keys' targets have their defaults.
void for_each_table(const std::function<void(const TableType&)>& use);

/// A key in the reference.
struct KeyText {
  std::string name;
  std::string form;                 ///< form of its value, with its range: "number, above 0"
  std::vector<std::string> values;  ///< accepted values, if they are a fixed set
  std::string unit, initial, help;  ///< `initial`: the default; empty: none in that form
  bool required = false;
  std::vector<std::string> alternatives;  ///< keys that make a required key optional
};

/// A table in the reference. Its help and that of its keys are one paragraph of Markdown each.
struct TableText {
  std::string name, help;
  bool repeatable = false;
  std::vector<KeyText> keys;
};

/// Returns every table of a scene, effects last.
std::vector<TableText> reference_tables();

/// Returns the format's reference in Markdown: a heading and a table of keys for each table.
std::string format_reference();

}  // namespace drape
