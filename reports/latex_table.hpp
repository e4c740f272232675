#pragma once

#include <string>

#include "reports/result_table.hpp"

namespace drape {

/// Width of a column of an article, and of a page of two of them [pt, of 72.27 to the inch].
inline constexpr double latex_column = 3.3 * 72.27, latex_page = 7 * 72.27;

/// Formats a table for \input, in letters of 8 pt; needs booktabs and array. Cells are wrapped so that the table fits a
/// column of an article, or otherwise a page of two columns. A table too wide for that is split: each part repeats the
/// columns that identify the rows.
std::string to_latex(const ResultTable& table);

}  // namespace drape
