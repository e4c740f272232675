#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace drape {

/// Steps of equal length on which the moments of a motion lie.
struct TimeGrid {
  double step = 0.04;               ///< h [s]
  std::vector<std::int64_t> steps;  ///< of each moment, from 0, increasing
  double fps = 25, speed = 1;       ///< of a film that shows each step: speed/fps = h, where h is that of a film
};

/// @param name    of the file, for messages
/// @param times   of the moments [s]; empty: they are as far apart as `fps` says
/// @param fps     given by the user, which goes before times
/// @param of_file what the file says of its film
/// @throws UsageError if the times do not increase, or lie on no such steps
TimeGrid make_time_grid(const std::string& name, std::size_t count, const std::vector<double>& times,
                        std::optional<double> fps, std::optional<double> of_file);

}  // namespace drape
