// One way to render the scene, and what the experiment asks about it.
#pragma once

#include <string>

#include "compare/plan.h"
#include "render/frame_options.h"
#include "scene/scene_data.h"

namespace jalousie::compare {

/// One way to render the scene.
struct Configuration {
  std::string name;         ///< unique within an experiment
  std::string commandLine;  ///< the same as options of `jalousie render`
  render::FrameOptions frame;
  render::RendererOptions renderer;  ///< its importance mask, if any, must outlive the experiment
  scene::BuildOptions build = {};    ///< how its scene is built

  /// Whether the level rule reads FrameOptions::tau, so that a sweep can vary it.
  bool followsTau() const;
};

/// How the reference pictures are rendered: every object at its finest level. @pre not Reference::kNone (checked)
render::FrameOptions referenceOptions(Reference reference);

}  // namespace jalousie::compare
