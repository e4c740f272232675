#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace drape {

/// Grid of equal time steps that contains the moments of a motion.
struct TimeGrid {
  double step = 0.04;               ///< h [s]
  std::vector<std::int64_t> steps;  ///< step of each moment, from 0, increasing
  double fps = 25, speed = 1;       ///< film with one frame per step: speed/fps = h, if h suits a film
};

/// Finds the grid of a motion.
/// @param times   times of the moments [s]; empty: intervals of 1/fps
/// @param fps     given by the user; has precedence over times
/// @param of_file frame rate in the file
/// @throws UsageError if the times do not increase, or fit no such grid; the message begins with `name`
TimeGrid make_time_grid(const std::string& name, std::size_t count, const std::vector<double>& times,
                        std::optional<double> fps, std::optional<double> of_file);

}  // namespace drape
