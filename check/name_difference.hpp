#pragma once

#include <string>

#include "check/report.hpp"
#include "render/image.hpp"

namespace drape {

/// Names the kind of difference between two pictures of one size: a shift, another brightness, other colours, other
/// edges, or one place only.
/// @returns empty if the pictures are equal, or no kind explains most of the difference
std::string classify_difference(const Image& expected, const Image& actual);

/// Names the differences of the recording machine that may change a picture or a bit: "with another renderer (…; here
/// …)". Empty if there are none.
std::string name_other_machine(const Machine& recorded, const Machine& here);

}  // namespace drape
