#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// Returns the number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`, each byte
/// being edited at most once (the optimal string alignment distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the name in `names` with the least edit distance to `name`, the first of several; case is ignored, and '-',
/// '_' and ' ' are equal. Returns "" if more than a third of the name would have to change.
std::string nearest_name(std::string_view name, std::span<const std::string> names);

/// Returns the rest of a message about an unknown name: "; did you mean 'stiffness'?" if one is near, else
/// "; " + `kind` + " 'mesh', 'mass'", or "" if there are no names.
/// @param kind introduces the list, as in "the keys are"
std::string did_you_mean(std::string_view name, std::span<const std::string> names, std::string_view kind);

/// Returns "'mesh', 'mass', 'pins'".
std::string quoted_list(std::span<const std::string> names);

}  // namespace drape
