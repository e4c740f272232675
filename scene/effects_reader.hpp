#pragma once

#include <string>
#include <vector>

#include "scene/document.hpp"
#include "scene/table_reader.hpp"
#include "sim/effects/effect.hpp"

namespace drape {

/// An effect with the table that it was read from.
struct ReadEffect {
  Effect effect;
  const TomlValue* table;
  bool good;  ///< read without a problem
};

/// Reads the tables [effects.NAME] of a document, in the order of the registry and, of one name, of the document.
std::vector<ReadEffect> read_effects(const TomlValue& document, TableReader& reader, Problems& problems);

/// What each of them is called in a path of a key: effects.NAME, and of several of one name with its number,
/// effects.sphere.0.
std::vector<std::string> effect_paths(const std::vector<ReadEffect>& effects);

/// Lets the effects check their values against everything else.
/// @param settings that have these effects
void check_effects(const std::vector<ReadEffect>& effects, const SimulationSettings& settings, Problems& problems);

}  // namespace drape
