#pragma once

#include "sim/system.hpp"

namespace drape {

/// How much of each list of a system there is at one moment.
struct SystemSizes {
  std::size_t forces, fields, energies, corrections, filters, contacts;
  explicit SystemSizes(const System& system)
      : forces(system.forces.size()),
        fields(system.fields.size()),
        energies(system.energies.size()),
        corrections(system.corrections.size()),
        filters(system.filters.size()),
        contacts(system.contacts.size()) {}
};

/// Makes everything that was added to the system after `before` add the seconds it takes to `seconds`, which must
/// outlive the system. What is not timed pays nothing for that it could be.
void time_additions(System& system, const SystemSizes& before, double& seconds);

}  // namespace drape
