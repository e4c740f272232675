#include "drape/sim/state.hpp"

#include "core/bytes.hpp"

namespace drape {

std::uint64_t hash_of(const State& state) {
  Hash hash;
  hash.add(&state.step, sizeof state.step);
  const auto add = [&hash](const auto& numbers) {
    hash.add(numbers.data(), static_cast<std::size_t>(numbers.size()) * sizeof(double));
  };
  for (const Vertices* vertices : {&state.x, &state.v, &state.restraint.acceleration}) add(*vertices);
  add(state.restraint.tensions);
  if (state.substeps != 0) hash.add(&state.substeps, sizeof state.substeps);
  return hash.value();
}

}  // namespace drape
