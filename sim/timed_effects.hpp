#pragma once

#include "sim/system.hpp"

namespace drape {

/// Sizes of a system's lists at one moment.
struct SystemSizes {
  std::size_t forces, fields, energies, dashpots, corrections, filters, contacts;
  explicit SystemSizes(const System& system)
      : forces(system.forces.size()),
        fields(system.fields.size()),
        energies(system.energies.size()),
        dashpots(system.dashpots.size()),
        corrections(system.corrections.size()),
        filters(system.filters.size()),
        contacts(system.contacts.size()) {}
};

/// Wraps everything added to the system after `before` so that its computing time is added to `seconds`, which must
/// outlive the system. Without timing there is no overhead.
void time_additions(System& system, const SystemSizes& before, double& seconds);

}  // namespace drape
