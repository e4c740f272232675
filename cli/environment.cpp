#include "cli/environment.hpp"

#include <cstdlib>
#include <string>

#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/settings.hpp"

namespace drape {
namespace {

/// Calls `use` with the value of a non-empty environment variable.
template <class Use>
void with_variable(const char* name, const Use& use) {
  const char* value = std::getenv(name);
  if (value == nullptr || *value == '\0') return;
  try {
    use(value);
  } catch (const UsageError& error) {
    throw UsageError(std::string(name) + ": " + error.what());
  }
}

}  // namespace

void use_environment_isa() { with_variable("DRAPE_ISA", limit_instruction_set); }
void use_environment_data() {
  with_variable("DRAPE_DATA", [](const char* folder) { use_data_folder(folder); });
}

}  // namespace drape
