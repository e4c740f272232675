#pragma once

#include <cstdlib>
#include <string_view>

#include "drape/core/error.hpp"

namespace drape {

/// Calls a reader of input. It may return or throw a refusal with a message; everything else ends the program.
template <class Refusal = UsageError, class Read>
void accepts_or_refuses(Read&& read) {
  try {
    read();
  } catch (const Refusal& error) {
    if (std::string_view(error.what()).empty()) std::abort();
  }
}

}  // namespace drape
