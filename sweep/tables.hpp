#pragma once

#include <string>

#include "sweep/results.hpp"

namespace drape {

/// A row for each run: its number, every key that varies, what became of it, and every figure.
std::string runs_csv(const SweepResults& results);

/// The films in grids, with the microseconds and iterations of a step below each, as a report has them.
std::string sweep_markdown(const SweepResults& results);

/// Tables of the microseconds and iterations of a step: whole table environments, which need no package.
std::string sweep_latex(const SweepResults& results);

/// A run's file of this extension, "film" or "sheet" before it, as a link from the sweep's folder; empty: it has none.
std::string film_of(const SweepResults& results, const SweepRow& row);

/// A figure as people read it: "12.5"; a dash where there is none.
std::string short_figure(const SweepRow& row, const std::string& name);

}  // namespace drape
