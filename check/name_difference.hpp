#pragma once

#include <string>

#include "check/report.hpp"
#include "render/image.hpp"

namespace drape {

/// What kind of difference two pictures of one size have, in words: a shift, another brightness, other colours, other
/// edges, or one place only.
/// @returns empty if there is none, or none of these explains most of it
std::string name_difference(const Image& expected, const Image& actual);

/// What is another than here where a golden was recorded, of what may change a picture or a bit: "with another renderer
/// (…; here …)". Empty if nothing is.
std::string name_other_machine(const Machine& recorded, const Machine& here);

}  // namespace drape
