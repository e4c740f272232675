#include "sim/state.hpp"

#include "core/hash.hpp"

namespace drape {

std::uint64_t hash_of(const State& state) {
  Hash hash;
  hash.add(&state.step, sizeof state.step);
  for (const Vertices* vertices : {&state.x, &state.v, &state.held}) {
    hash.add(vertices->data(), static_cast<std::size_t>(vertices->size()) * sizeof(double));
  }
  return hash.value();
}

}  // namespace drape
