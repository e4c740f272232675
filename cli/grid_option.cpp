#include "cli/grid_option.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "core/error.hpp"
#include "output/path_template.hpp"
#include "output/registry.hpp"

namespace drape {

SheetGrid parse_grid(const std::string& option, const std::string& text) {
  constexpr int most = 100;
  SheetGrid grid;
  const char* const end = text.data() + text.size();
  const auto columns = std::from_chars(text.data(), end, grid.columns);
  const bool two = columns.ec == std::errc() && std::string_view(columns.ptr, end).starts_with('x');
  const auto rows = two ? std::from_chars(columns.ptr + 1, end, grid.rows) : columns;
  const auto within = [](int count) { return count >= 1 && count <= most; };
  if (!two || rows.ec != std::errc() || rows.ptr != end || !within(grid.columns) || !within(grid.rows)) {
    throw UsageError(
        fmt::format("{} takes COLUMNSxROWS, each from 1 to {}, as in 4x3; found '{}'", option, most, text));
  }
  return grid;
}

std::optional<SheetGrid> parse_sheet(const std::string& text, const std::vector<std::string>& outputs) {
  if (text.empty()) return std::nullopt;
  const SheetGrid grid = parse_grid("--sheet", text);
  const auto becomes_sheet = [](const std::string& path) {
    const OutputFormat* format = find_format(path);
    return format != nullptr && format->drawn() && format->file_per_frame() && !PathTemplate(path).has_frame();
  };
  if (std::ranges::none_of(outputs, becomes_sheet)) {
    throw UsageError(fmt::format("--sheet {} needs an output for it: -o NAME.png", text));
  }
  return grid;
}

}  // namespace drape
