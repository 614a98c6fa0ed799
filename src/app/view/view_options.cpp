// Declaration and checks of the options of `jalousie view`.
#include "app/view/view_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/gl_debug.h"
#include "app/render_command_line.h"
#include "cli/force_option.h"
#include "cli/memory_option.h"
#include "cli/option_checks.h"
#include "cli/program.h"
#include "core/error.h"

namespace jalousie::app {
namespace {

bool isScene(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) { return c | 0x20; });
  return extension == ".glb" || extension == ".gltf";
}

void addWindowOptions(CLI::App& command, ViewOptions& o) {
  command.add_option("--split", o.split, "Show a second configuration with these options right of a divider")
      ->type_name("OPTIONS");
  command.add_option("--divider", o.divider, "Position of the divider, share of the width")
      ->check(cli::inRange(0.0, 1.0).description(""))
      ->type_name("0..1")
      ->capture_default_str();
  command.add_option("--select", o.select, "Inspect an object; OBJECT is its index in the file")->type_name("OBJECT");
  command.add_flag("--list", o.list, "Open the list of objects");
  command.add_flag("--play", o.play, "Play the camera path");
  command.add_flag("--watch", o.watch, "Read files again when they, or buffers and images that they name, change");
  command.add_option("--scale", o.scale, "Scale of the interface; 0: scale of the display")
      ->check(cli::inRange(0.0, 8.0).description(""))
      ->type_name("0..8")
      ->capture_default_str();
  command
      .add_option("--outputs", o.outputs,
                  "Write screenshots, figures and recorded paths to this folder [current folder]")
      ->type_name("FOLDER");
  command
      .add_option("--shaders", o.shaders, "Read shaders from this folder and rebuild them when one changes [built in]")
      ->type_name("FOLDER");
}

void addScriptOptions(CLI::App& command, ViewOptions& o) {
  command
      .add_option("--screenshot", o.screenshot,
                  "Write the picture after the last frame; without --frames, this is the first")
      ->type_name("OUT.png");
  command
      .add_option("--frames", o.frames,
                  "Exit after N frames (1..1000000); with --play, each shows the next frame of the path")
      ->check(cli::inRange(1, 1000000).description(""))
      ->type_name("N");
  command.add_flag("--interface", o.withInterface, "Include the interface in the screenshot");
  command
      .add_option("--json", o.render.json,
                  "Write times and counts of the last 10 s as JSON at the end; -: standard output")
      ->type_name("STATS");
  addDebugOption(command, o.debug);
}

}  // namespace

void ViewOptions::finish() {
  if (withInterface && screenshot.empty()) throw Error(ErrorCode::kUsage, "--interface needs --screenshot");
  if (!screenshot.empty() && !frames) frames = 1;
  json = render.json;
#ifdef JALOUSIE_SHADER_FOLDER
  // Development builds read the shaders from the source tree, except in scripts.
  if (shaders.empty() && !frames) shaders = JALOUSIE_SHADER_FOLDER;
#endif
  RenderOptions check = render;
  check.finishFrame();
  if (split) viewOptionsOf(*split);
}

void addViewOptions(CLI::App& command, ViewOptions& options) {
  command
      .add_option("files", options.files, "glTF or GLB files, or folders of them; at most 8 files, shown side by side")
      ->type_name("FILE");
  addCameraOptions(command, options.render);
  command.get_option("--size")->each([&options](const std::string&) { options.sizeGiven = true; });
  addMethodOptions(command, options.render);
  addPictureOptions(command, options.render);
  addWindowOptions(command, options);
  addScriptOptions(command, options);
  cli::addForceOption(command, options.render.replace);
  cli::addMemoryOption(command, options.render.memory);
  command.footer(R"(Examples:
  jalousie view scene.glb
      drag to turn, wheel to zoom, right drag to look around, W A S D to fly, click to inspect, F1 for all keys
  jalousie view scene.glb --view lod --split "--mode hom --lod linear --view lod"
      the default beside the pipeline of the thesis
  jalousie view before.glb after.glb --watch
      two bakes side by side, read again when they change
  jalousie view scene.glb --path walk.glb --play
      play the camera path of another file
  jalousie view scene.glb --eye 0,2,9 --look 0,0,0 --screenshot view.png --frames 3
      write the picture that jalousie render writes for the same options
)");
}

RenderOptions viewOptionsOf(const std::string& text) {
  RenderOptions options;
  CLI::App parser;
  parser.set_help_flag();
  addMethodOptions(parser, options);
  addPictureOptions(parser, options);
  try {
    cli::parse(parser, text);
  } catch (const Error& error) {
    throw Error(error.code(), std::string("--split: ") + error.what());
  }
  RenderOptions check = options;
  check.finishFrame();
  return options;
}

std::vector<std::filesystem::path> expandFolders(const std::vector<std::filesystem::path>& arguments) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& argument : arguments) {
    std::vector<std::filesystem::path> inside;
    std::error_code failed;
    if (std::filesystem::is_directory(argument, failed))
      for (std::filesystem::directory_iterator it(argument, failed), end; !failed && it != end; it.increment(failed))
        if (isScene(it->path())) inside.push_back(it->path());
    std::sort(inside.begin(), inside.end());
    if (inside.empty()) inside.push_back(argument);
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

}  // namespace jalousie::app
