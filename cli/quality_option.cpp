#include "cli/quality_option.hpp"

#include <algorithm>

#include "core/nearest.hpp"

namespace drape {

void add_quality_option(CLI::App& command, std::vector<std::string>& overrides) {
  command
      .add_option_function<std::string>(
          "--quality",
          [&overrides](const std::string& given) {
            const std::vector<std::string> names{"draft", "film", "print"};
            if (std::ranges::find(names, given) == names.end()) {
              throw CLI::ValidationError(
                  "--quality", "unknown quality '" + given + "'" + did_you_mean(given, names, "the choices are"));
            }
            overrides.push_back("look.quality=" + given);
          },
          "Size, samples and solver's tolerance in one word, relative to the scene's own")
      ->type_name("draft|film|print");
}

}  // namespace drape
