// The jalousie program: one subcommand per task; errors become one line and an exit code.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "app/compare_command.h"
#include "app/diff_command.h"
#include "app/gl_debug.h"
#include "app/option_values.h"
#include "app/record_command.h"
#include "app/render_command.h"
#include "app/render_command_line.h"
#include "app/view/view_command.h"
#include "core/error.h"

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
    if (word != "--resume" && word != "-q" && word != "--quiet" && word != "--debug") text += " " + shellQuoted(word);
  }
  return text;
}

int run(const std::string& command, Options& options) {
  if (command == "compare") {
    options.compare.finish();
    return runCompare(options.compare);
  }
  if (command == "diff") {
    runDiff(options.diff);
  } else if (command == "record") {
    runRecord(options.record);
  } else if (command == "view") {
    options.view.finish();
    runView(options.view);
  } else {
    options.render.finish();
    runRender(options.render);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{"Level of detail that follows how visible each object is", "jalousie"};
  program.set_version_flag("--version", JALOUSIE_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(32);
  program.footer(
      "Exit codes: 0 done, 2 command line, 3 file not found, 4 cannot be read, 5 malformed, 6 not supported, 7 over a "
      "limit,\n8 cannot be written, 9 no OpenGL 4.5 or no display, 10 a shader does not build, 70 a defect, 130 "
      "interrupted. A failure prints\none line on standard error; existing output files are unchanged.");
  Options options;
  options.compare.command = toRepeat(argc, argv);
  CLI::App* render = program.add_subcommand("render", "Render one frame, headless");
  addRenderOptions(*render, options.render);
  addDebugOption(*render, options.render.debug);
  addViewOptions(*program.add_subcommand("view", "Show scenes in a window and explain what is occluded, and why"),
                 options.view);
  CLI::App* compare =
      program.add_subcommand("compare", "Measure configurations along a camera path and write a report");
  addCompareOptions(*compare, options.compare);
  addDebugOption(*compare, options.compare.debug);
  addDiffOptions(*program.add_subcommand("diff", "Measure how much two pictures differ: PSNR, SSIM, FLIP"),
                 options.diff);
  addRecordOptions(*program.add_subcommand("record", "Write a camera path as a glTF camera animation"), options.record);
  std::string command = "COMMAND";
  try {
    program.parse(argc, argv);
    command = program.get_subcommands().front()->get_name();
    return run(command, options);
  } catch (const CLI::Success& answer) {
    return program.exit(answer);
  } catch (const CLI::ParseError& error) {
    for (const CLI::App* parsed : program.get_subcommands())
      command = parsed->get_name();
    fmt::print(stderr, "jalousie: {} (see jalousie {} --help)\n", error.what(), command);
    return static_cast<int>(jalousie::ErrorCode::kUsage);
  } catch (const jalousie::Error& error) {
    fmt::print(stderr, "jalousie: {}\n", error.what());
    return error.exitCode();
  } catch (const std::exception& error) {
    fmt::print(stderr, "jalousie: internal error: {}\n", error.what());
    return static_cast<int>(jalousie::ErrorCode::kInternal);
  }
}
