#pragma once

#include <string>

#include "sweep/results.hpp"

namespace drape {

/// Returns a row per run: number, varied keys, outcome and every figure.
std::string runs_csv(const SweepResults& results);

/// Returns the film grids for a report, with the microseconds and iterations of a step below each film.
std::string sweep_markdown(const SweepResults& results);

/// Returns LaTeX tables of the microseconds and iterations of a step, complete environments that need no package.
std::string sweep_latex(const SweepResults& results);

/// Returns a link from the sweep's folder to a run's film or sheet; empty if it has none.
std::string film_of(const SweepResults& results, const SweepRow& row);

/// Formats a figure for readers: "12.5"; a dash if there is none.
std::string short_figure(const SweepRow& row, const std::string& name);

}  // namespace drape
