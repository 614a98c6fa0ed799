// jalousie-bake: meshes in, glTF with measured LOD chains out.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <optional>

#include "asset/gltf_file.h"
#include "asset/gltf_quantize.h"
#include "bake/bake_document.h"
#include "bake/command_line.h"
#include "bake/import.h"
#include "bake/inspect.h"
#include "bake/report.h"
#include "bake/sheet.h"
#include "core/error.h"
#include "core/file.h"
#include "core/progress.h"

namespace {

using namespace jalousie;

void writeSheet(const tinygltf::Model& model, const bake::CommandLine& command, const std::string& title) {
  if (command.sheet.empty()) return;
  bake::SheetOptions options;
  options.title = title;
  writeFileAtomic(command.sheet, bake::sheetHtml(model, options));
}

void inspect(const bake::CommandLine& command) {
  const tinygltf::Model model = asset::loadGltf(command.inputs.front(), command.bake.limits);
  const std::vector<bake::InspectedChain> chains = bake::inspectModel(model);
  writeSheet(model, command, command.inputs.front().filename().string());
  if (command.json == "-") {
    fmt::print("{}", bake::inspectJson(chains));
  } else if (!command.quiet) {
    fmt::print("{}", bake::inspectText(chains));
  }
}

void run(const bake::CommandLine& command) {
  if (command.inspect) return inspect(command);
  std::vector<bake::MeshReport> reports;
  {
    Progress progress("baking", 0, command.quiet);
    tinygltf::Model model = bake::importFiles(command.inputs, command.bake.limits);
    reports =
        bake::bakeDocument(model, command.bake, [&](std::size_t done, std::size_t total, const std::string& what) {
          progress.update(done, fmt::format("mesh {} of {}, {}", done + 1, total, what));
        });
    writeSheet(model, command, command.output.filename().string());
    if (command.quantize) asset::quantizeModel(model);
    asset::saveGlb(model, command.output, {command.compress});
  }
  if (command.json == "-") {
    fmt::print("{}", bake::reportJson(reports));
    return;
  }
  if (!command.json.empty()) writeFileAtomic(command.json, bake::reportJson(reports));
  if (!command.quiet) fmt::print("{}", bake::reportText(reports));
}

}  // namespace

int main(int argc, char** argv) {
  std::string input;
  try {
    const std::optional<bake::CommandLine> command = bake::parseCommandLine(argc, argv);
    if (!command) return 0;
    input = command->inputs.front().string();
    run(*command);
    return 0;
  } catch (const Error& error) {
    // Errors about the content carry no path of their own.
    const bool aboutInput = error.file().empty() && error.code() != ErrorCode::kUsage;
    fmt::print(stderr, "jalousie-bake: {}{}\n", aboutInput ? input + ": " : "", error.what());
    return error.exitCode();
  } catch (const std::exception& error) {
    fmt::print(stderr, "jalousie-bake: {}: {}\n", input, error.what());
    return static_cast<int>(ErrorCode::kInternal);
  }
}
