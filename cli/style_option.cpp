#include "cli/style_option.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/text.hpp"

namespace drape {

void add_style_option(CLI::App& subcommand, FigureStyle& style) {
  subcommand
      .add_option_function<std::string>(
          "--style",
          [&style](const std::string& given) {
            const std::vector<std::string> names{"screen", "paper", "paper-wide"};  // in the enumeration's order
            const auto found = std::ranges::find(names, given);
            if (found == names.end()) {
              throw CLI::ValidationError(
                  "--style", "unknown style '" + given + "'" + did_you_mean(given, names, "the styles are"));
            }
            style = static_cast<FigureStyle>(found - names.begin());
          },
          "Style of the diagrams' files; default screen. paper: for a column of an article, 3.3 in wide, without a "
          "title, in a serif font of 8 pt, as SVG, PDF and pgfplots; paper-wide: 7 in")
      ->type_name("screen|paper|paper-wide");
}

}  // namespace drape
