// Declaration and checks of the options of `jalousie view`.
#include "app/view/view_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/gl_debug.h"
#include "app/option_checks.h"
#include "core/error.h"

namespace jalousie::app {
namespace {

bool isScene(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) { return c | 0x20; });
  return extension == ".glb" || extension == ".gltf";
}

void addWindowOptions(CLI::App& command, ViewOptions& o) {
  command.add_option("--split", o.split, "Options of a second configuration, shown right of a divider")
      ->type_name("OPTIONS");
  command.add_option("--divider", o.divider, "Where the divider is, share of the width")
      ->check(inRange(0.0, 1.0).description(""))
      ->type_name("0..1")
      ->capture_default_str();
  command.add_option("--select", o.select, "Inspect this object, counted in the file's order")->type_name("OBJECT");
  command.add_flag("--play", o.play, "Play the camera path");
  command.add_flag("--watch", o.watch, "Read a file again whenever it changes");
  command.add_option("--scale", o.scale, "Size of the interface; 0: as the display says")
      ->check(inRange(0.0, 8.0).description(""))
      ->type_name("0..8")
      ->capture_default_str();
  command.add_option("--outputs", o.outputs, "Folder for screenshots and recorded paths [current]")
      ->type_name("FOLDER");
  command.add_option("--shaders", o.shaders, "Folder to read shaders from; they are built anew when one changes")
      ->type_name("FOLDER");
}

void addScriptOptions(CLI::App& command, ViewOptions& o) {
  command.add_option("--screenshot", o.screenshot, "Write a picture at the end; alone it means --frames 1")
      ->type_name("OUT.png");
  command.add_option("--frames", o.frames, "Leave after N frames; --play then goes one frame of the path at a time")
      ->check(inRange(1, 1000000).description(""))
      ->type_name("N");
  command.add_flag("--interface", o.withInterface, "The screenshot shows the interface too");
  command.add_option("--json", o.render.json, "Write the figures of the last frames at the end")->type_name("STATS");
  addDebugOption(command, o.debug);
}

}  // namespace

void ViewOptions::finish() {
  if (withInterface && screenshot.empty()) throw Error(ErrorCode::kUsage, "--interface needs --screenshot");
  if (!screenshot.empty() && !frames) frames = 1;
  json = render.json;
#ifdef JALOUSIE_SHADER_FOLDER
  // Development builds read the shaders of their source tree; scripts do not.
  if (shaders.empty() && !frames) shaders = JALOUSIE_SHADER_FOLDER;
#endif
  RenderOptions check = render;
  check.finishFrame();
  if (split) viewOptionsOf(*split);
}

void addViewOptions(CLI::App& command, ViewOptions& options) {
  command.add_option("files", options.files, "glTF or GLB files, or folders of them; several stand side by side")
      ->type_name("FILE");
  addCameraOptions(command, options.render);
  command.get_option("--size")->each([&options](const std::string&) { options.sizeGiven = true; });
  addMethodOptions(command, options.render);
  addPictureOptions(command, options.render);
  addWindowOptions(command, options);
  addScriptOptions(command, options);
  command.footer(R"(Examples:
  jalousie view scene.glb
      drag turns, wheel zooms, right drag and WASD fly, click inspects, F1 lists the keys
  jalousie view scene.glb --view lod --split "--mode hom --lod linear --view lod"
      the default beside the thesis' pipeline
  jalousie view before.glb after.glb --watch
      two bakes side by side, read again whenever they change
  jalousie view scene.glb --path walk.glb --play
  jalousie view scene.glb --eye 0,2,9 --look 0,0,0 --screenshot view.png --frames 3
      what jalousie render writes for the same options
)");
}

RenderOptions viewOptionsOf(const std::string& text) {
  RenderOptions options;
  CLI::App parser;
  parser.set_help_flag();
  addMethodOptions(parser, options);
  addPictureOptions(parser, options);
  try {
    parser.parse(text);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::kUsage, std::string("--split: ") + error.what());
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
