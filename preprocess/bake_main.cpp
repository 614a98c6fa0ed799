// jalousie-bake: reads meshes and writes glTF with measured LOD chains.
#include <fmt/format.h>

#include <exception>
#include <optional>

#include "asset/gltf_file.h"
#include "bake/pipeline/bake_command.h"
#include "bake/pipeline/command_line.h"
#include "bake/pipeline/threads.h"
#include "bake/report/inspect.h"
#include "bake/report/sheet.h"
#include "core/error.h"
#include "core/file.h"
#include "core/standard_streams.h"

namespace {

using namespace jalousie;

void inspect(const bake::CommandLine& command) {
  const std::filesystem::path file = command.inputs.front();
  const tinygltf::Model model = asset::loadGltf(file, command.bake.limits);
  const std::vector<bake::InspectedChain> chains = bake::inspectModel(model);
  if (!command.sheet.empty()) {
    bake::SheetOptions options;
    options.title = file.filename().string();
    options.slices = bake::threadedSlices(0);
    writeFileAtomic(command.sheet, bake::sheetHtml(model, options));
  }
  if (command.json == "-") {
    printOutput(bake::inspectJson(chains));
  } else if (!command.quiet) {
    printOutput(bake::inspectText(chains));
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string input;
  openStandardStreams();
  try {
    const std::optional<bake::CommandLine> command = bake::parseCommandLine(argc, argv);
    if (!command) return 0;
    if (!command->inspect) return bake::runBake(*command);
    input = command->inputs.front();
    inspect(*command);
    return 0;
  } catch (const Error& error) {
    // Errors about the content carry no path of their own.
    const bool aboutInput = error.file().empty() && error.code() != ErrorCode::kUsage && !input.empty();
    printError(fmt::format("jalousie-bake: {}{}", aboutInput ? oneLine(input) + ": " : "", error.what()));
    return error.exitCode();
  } catch (const std::exception& error) {
    printError(fmt::format("jalousie-bake: {}{}", input.empty() ? "" : oneLine(input) + ": ", oneLine(error.what())));
    return static_cast<int>(ErrorCode::kInternal);
  }
}
