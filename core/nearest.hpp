#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// The number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`, each byte being
/// edited at most once (the optimal string alignment distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The one of `names` that `name` was probably meant to be: the first of the least edit distance, where capitals do not
/// count and '-', '_' and ' ' are the same. Empty if none is near: more than a third of the name would have to change.
std::string nearest_name(std::string_view name, std::span<const std::string> names);

/// What to say after an unknown name: "; did you mean 'stiffness'?" if one is near, else "; " + `kind` + " 'mesh',
/// 'mass'", or nothing if there are no names.
/// @param kind introduces the list, as in "the keys are"
std::string did_you_mean(std::string_view name, std::span<const std::string> names, std::string_view kind);

/// "'mesh', 'mass', 'pins'"
std::string quoted_list(std::span<const std::string> names);

}  // namespace drape
