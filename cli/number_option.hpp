#pragma once

#include <CLI/CLI.hpp>

#include "scene/values.hpp"

namespace drape {

/// Takes a finite number in the range.
CLI::Validator number_in(const Range& range);

/// Takes a whole number in the range.
CLI::Validator whole_number_in(const Range& range);

}  // namespace drape
