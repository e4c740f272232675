#include <memory>

#include "cli/sweep_results.hpp"
#include "sweep/merge.hpp"

namespace drape {
namespace {

struct MergeArguments {
  std::vector<std::string> folders;
  std::string output;
};

ExitCode merge(const MergeArguments& arguments, const CommonOptions& common) {
  const std::vector<std::filesystem::path> parts = sweep_parts(arguments.folders);
  const std::filesystem::path folder = arguments.output.empty() ? arguments.folders.front() : arguments.output;
  SweepFile whole = merge_sweeps(parts, folder);
  return conclude_sweep(read_results(folder, std::move(whole)), folder, common);
}

}  // namespace

void add_merge_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* sub = app.add_subcommand("merge", "Merge the shards of a sweep");
  sub->add_option("DIR", arguments->folders, "Folders of shards, or a folder with shards in it")->required();
  sub->add_option("-o,--output", arguments->output, "Folder for the merged sweep; default the first DIR");
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return merge(*arguments, common); }; });
}

}  // namespace drape
