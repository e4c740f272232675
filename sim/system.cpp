#include "sim/system.hpp"

#include "sim/kernels/kernels.hpp"

namespace drape {

void System::move(State& state, const Vertices* reached) const {
  if (filters.empty() && reached != nullptr) {
    state.x = *reached;
    return;
  }
  for (const auto& filter : filters) filter->apply(state.x, time(state.step), step, state.v);
  kernels().add_multiple(static_cast<std::size_t>(state.x.size()), step, state.v.data(), state.x.data());
  place_pins(state, state.x);
  for (const auto& filter : filters) filter->finish(state.v);
}

}  // namespace drape
