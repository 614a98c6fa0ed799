// The jalousie program: one subcommand per task; errors become one line and an exit code.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "app/render_command.h"
#include "app/render_options.h"
#include "core/error.h"

int main(int argc, char** argv) {
  CLI::App program{"Level of detail that follows how visible each object is", "jalousie"};
  program.set_version_flag("--version", JALOUSIE_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(32);
  jalousie::app::RenderOptions render;
  CLI::App* renderCommand = program.add_subcommand("render", "Render one frame, headless");
  jalousie::app::addRenderOptions(*renderCommand, render);
  try {
    program.parse(argc, argv);
    render.finish();
    jalousie::app::runRender(render);
    return 0;
  } catch (const CLI::Success& answer) {
    return program.exit(answer);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "jalousie: {} (see jalousie render --help)\n", error.what());
    return static_cast<int>(jalousie::ErrorCode::kUsage);
  } catch (const jalousie::Error& error) {
    fmt::print(stderr, "jalousie: {}\n", error.what());
    return error.exitCode();
  } catch (const std::exception& error) {
    fmt::print(stderr, "jalousie: internal error: {}\n", error.what());
    return static_cast<int>(jalousie::ErrorCode::kInternal);
  }
}
