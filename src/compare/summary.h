// summary.json: figures per configuration, ratios to the baseline, cost at equal error.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "asset/scene_types.h"
#include "compare/plan.h"
#include "compare/results.h"

namespace jalousie::scene {
struct SceneNames;
}

namespace jalousie::compare {

struct Configuration;

/// Facts about a run that stand beside its figures.
struct Circumstances {
  std::string scene;     ///< file name
  std::string path;      ///< file name of the camera path; empty: the scene's own
  std::string renderer;  ///< GL_RENDERER
  std::string timing;    ///< "wall" or "gpu"
  std::string command;   ///< repeats the experiment
  std::string version;
  asset::ContentCounts ignored = {};         ///< what the scene's file holds that is not drawn
  const scene::SceneNames* names = nullptr;  ///< of the scene; null: objects are named by their numbers
};

/// The content of summary.json. Keys are stable; docs/compare.md explains them.
nlohmann::ordered_json summaryJson(const Results& results, const std::vector<Configuration>& configurations,
                                   const Plan& plan, const Circumstances& circumstances);

/// A table of the main figures for a terminal. @param summary  of summaryJson()
std::string summaryText(const nlohmann::ordered_json& summary);

}  // namespace jalousie::compare
