// The jalousie program: one subcommand per task.
#include <CLI/CLI.hpp>
#include <string>

#include "app/compare_command.h"
#include "app/diff_command.h"
#include "app/gl_debug.h"
#include "app/option_values.h"
#include "app/record_command.h"
#include "app/render_command.h"
#include "app/render_command_line.h"
#include "app/view/view_command.h"
#include "cli/program.h"

namespace {

using namespace jalousie::app;

struct Options {
  RenderOptions render;
  CompareOptions compare;
  DiffOptions diff;
  RecordOptions record;
  ViewOptions view;
};

/// The command line without the options that do not change the result.
std::string toRepeat(int argc, char** argv) {
  std::string text = "jalousie";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool isKept =
        word != "--resume" && word != "--force" && word != "-q" && word != "--quiet" && word != "--debug";
    if (isKept) text += " " + shellQuoted(word);
  }
  return text;
}

void declare(CLI::App& program, Options& options) {
  program.set_version_flag("--version", JALOUSIE_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(32);
  CLI::App* render = program.add_subcommand("render", "Render one frame, headless");
  addRenderOptions(*render, options.render);
  addDebugOption(*render, options.render.debug);
  addViewOptions(*program.add_subcommand("view", "Show scenes in a window and explain what is occluded, and why"),
                 options.view);
  CLI::App* compare =
      program.add_subcommand("compare", "Measure configurations along a camera path and write a report");
  addCompareOptions(*compare, options.compare);
  addDebugOption(*compare, options.compare.debug);
  addDiffOptions(*program.add_subcommand("diff", "Measure how much two pictures differ: PSNR, SSIM, FLIP, Butteraugli"),
                 options.diff);
  addRecordOptions(*program.add_subcommand("record", "Write a camera path as a glTF camera animation"), options.record);
}

int run(const std::string& command, Options& options) {
  if (command == "compare") {
    options.compare.finish();
    return runCompare(options.compare);
  }
  if (command == "view") {
    options.view.finish();
    return runView(options.view);
  }
  if (command == "diff") {
    runDiff(options.diff);
  } else if (command == "record") {
    runRecord(options.record);
  } else {
    options.render.finish();
    runRender(options.render);
  }
  return 0;
}

int parseAndRun(int argc, char** argv) {
  CLI::App program{"Level of detail that follows how visible each object is", "jalousie"};
  Options options;
  options.compare.command = toRepeat(argc, argv);
  declare(program, options);
  if (!jalousie::cli::parse(program, argc, argv)) return 0;
  return run(program.get_subcommands().front()->get_name(), options);
}

}  // namespace

int main(int argc, char** argv) {
  return jalousie::cli::runProgram("jalousie", [&] { return parseAndRun(argc, argv); });
}
