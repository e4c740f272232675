#pragma once

#include <CLI/CLI.hpp>

#include "scene/values.hpp"

namespace drape {

/// Accepts a finite number in the range.
CLI::Validator number_in(const Range& range);

/// Accepts a whole number in the range.
CLI::Validator whole_number_in(const Range& range);

}  // namespace drape
