#pragma once

#include <string>

#include "drape/core/error.hpp"

namespace drape::test {

/// Returns the message of the UsageError that a call throws; "(no error)" if there is none.
template <class Call>
std::string usage_error(Call&& call) {
  try {
    call();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "(no error)";
}

}  // namespace drape::test
