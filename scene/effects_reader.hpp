#pragma once

#include <string>
#include <vector>

#include "scene/document.hpp"
#include "scene/table_reader.hpp"
#include "sim/effects/effect.hpp"

namespace drape {

/// An effect and the table that describes it.
struct ReadEffect {
  Effect effect;
  const TomlValue* table;
  bool good;  ///< true if read without a problem
};

/// Reads the tables [effects.NAME] of a document, in the order of the registry; equal names keep their document order.
std::vector<ReadEffect> read_effects(const TomlValue& document, TableReader& reader, Problems& problems);

/// Returns the key path of each effect: effects.NAME. Several effects of one name get numbers: effects.sphere.0.
std::vector<std::string> effect_paths(const std::vector<ReadEffect>& effects);

/// Lets each effect check its values against all other settings.
/// @param settings settings that contain these effects
void check_effects(const std::vector<ReadEffect>& effects, const SimulationSettings& settings, Problems& problems);

}  // namespace drape
