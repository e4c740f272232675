#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/keys.hpp"
#include "sim/settings.hpp"
#include "sim/system.hpp"

namespace drape {

/// Something that acts on the cloth because a scene's table [effects.NAME] asks for it. The object holds what the table
/// says; `install` turns that into what the schemes evaluate. An effect that no scene table names is never made.
class Effect {
 public:
  virtual ~Effect() = default;

  /// Lists the table's keys; their values are written into this object.
  virtual void describe(Keys& keys) = 0;

  /// Says what is wrong with the values taken together, once they are all read: calls `problem` with the key to blame
  /// (empty: the table) and a sentence, once for each problem.
  using ProblemSink = std::function<void(std::string_view key, const std::string& sentence)>;
  virtual void check(const SimulationSettings& /*settings*/, const ProblemSink& /*problem*/) const {}

  /// Adds the effect's forces, energies, corrections and colliders to the system.
  virtual void install(System& system) const = 0;
};

/// A row of the registry.
struct EffectType {
  std::string_view name;
  bool repeatable;  ///< may be written as [[effects.NAME]] several times
  std::unique_ptr<Effect> (*make)();
};

/// Every effect there is, in the order in which they are evaluated. The only list of them.
std::span<const EffectType> effect_types();

}  // namespace drape
