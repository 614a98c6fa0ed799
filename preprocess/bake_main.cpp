// jalousie-bake: reads meshes and writes glTF with measured LOD chains.
#include <optional>
#include <vector>

#include "asset/gltf_file.h"
#include "asset/scene_rooms.h"
#include "bake/pipeline/bake_command.h"
#include "bake/pipeline/command_line.h"
#include "bake/pipeline/threads.h"
#include "bake/report/inspect.h"
#include "bake/report/sheet.h"
#include "cli/program.h"
#include "core/error.h"
#include "core/file.h"
#include "core/output_files.h"
#include "core/standard_streams.h"

namespace {

using namespace jalousie;

void inspect(const bake::CommandLine& command) {
  const std::filesystem::path file = command.inputs.front();
  checkOutputs(std::vector<NamedFile>{{"--sheet", command.sheet, OutputKind::kPage}}, std::vector{file},
               command.replace);
  const tinygltf::Model model = asset::loadGltf(file, command.bake.limits);
  const std::vector<bake::InspectedChain> chains = bake::inspectModel(model);
  if (!command.sheet.empty()) {
    bake::SheetOptions options;
    options.title = file.filename().string();
    options.slices = bake::threadedSlices(0);
    writeFileAtomic(command.sheet, bake::sheetHtml(model, options));
  }
  if (command.json == kStandardOutput) {
    printOutput(bake::inspectJson(chains, asset::roomsOf(model)));
  } else if (!command.quiet) {
    printOutput(bake::inspectText(chains, asset::roomsOf(model)));
  }
}

void cut(const bake::CommandLine& command) {
  const std::filesystem::path file = command.inputs.front();
  checkOutputs(std::vector<NamedFile>{{"-o", command.output, OutputKind::kScene},
                                      {"--json", command.json, OutputKind::kReport, true}},
               std::vector{file}, command.replace);
  tinygltf::Model model = asset::loadGltf(file, command.cut->limits);
  const std::vector<bake::CutNode> nodes = bake::cutDocument(model, *command.cut);
  asset::saveGlb(model, command.output, {command.compress});
  if (!command.json.empty()) writeText(command.json, bake::cutJson(nodes));
  if (!command.quiet && command.json != kStandardOutput) printOutput(bake::cutText(nodes));
}

int run(int argc, char** argv) {
  const std::optional<bake::CommandLine> command = bake::parseCommandLine(argc, argv);
  if (!command) return 0;
  if (!command->inspect && !command->cut) return bake::runBake(*command);
  cli::withFile(command->inputs.front(), [&] { command->cut ? cut(*command) : inspect(*command); });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return cli::runProgram("jalousie-bake", [&] { return run(argc, argv); });
}
