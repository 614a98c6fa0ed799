// Options of `jalousie render`: plain values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <string>

#include "core/memory_limit.h"
#include "core/output_files.h"
#include "render/frame_options.h"
#include "scene/cell_options.h"

namespace jalousie::app {

struct RenderOptions {
  std::filesystem::path scene;
  std::string camera;             ///< its name or number in the file of the path; empty: the first one
  std::filesystem::path path;     ///< file whose camera path counts; empty: the scene's own
  std::filesystem::path output;   ///< empty only with statsOnly
  std::filesystem::path json;     ///< empty: none; "-": standard output
  std::optional<double> time;     ///< of the scene's animations, seconds; absent: the pose without them
  std::optional<float> frame;     ///< of the scene's camera path, and of its animations
  std::optional<glm::dvec3> eye;  ///< in the file's world; with look
  std::optional<glm::dvec3> look;
  std::optional<float> freezeFrame;  ///< culling camera, if it differs from the drawing camera
  std::optional<glm::dvec3> freezeEye;
  std::optional<glm::dvec3> freezeLook;
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  std::filesystem::path importance;  ///< mask image; empty: none
  std::optional<LvMeasure> lv;       ///< absent: defaultMeasure()
  std::uint32_t repeat = 1;
  std::uint32_t settle = 2;  ///< frames before the picture where it depends on history; 0 shows the frame of a cut
  bool statsOnly = false;
  bool quiet = false;
  bool debug = false;  ///< use an OpenGL debug context; its messages set the exit code
  bool coreOnly = false;
  scene::CellOptions cells{scene::CellOptions::Kind::kAutomatic};  ///< how the scene is built
  std::string hide;             ///< list of objects that are left out (app/shown_objects.h); empty: none
  std::string only;             ///< list of objects that are drawn, alone; empty: all
  std::set<std::string> given;  ///< names of the table's options that the command line holds, whatever their value
  render::FrameOptions frameOptions;
  render::RendererOptions rendererOptions;
  MemoryLimit memory{kDefaultMaxMemory, "--max-memory"};  ///< of the whole command
  Replace replace = Replace::kSameKind;                   ///< by output, json and the viewer's files

  /// Fills in what follows from other options and refuses contradictions. Errors: kUsage.
  /// Defined in render_command_line.cpp, which knows the table of options.
  void finish();
  /// The same for what has no output: the viewer.
  void finishFrame();
};

}  // namespace jalousie::app
