// The proving table of the level rules: triangles at equal error against levels by pixel error on whole objects.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lv_setup.h"

namespace jalousie::bench {

/// What is measured.
struct ProveOptions {
  bool still = true;   ///< one camera: triangles, wrong pixels, frame times
  bool moving = true;  ///< a path with temporally stable levels: triangles, switches
  std::vector<std::string> candidates;
};

/// Names of all candidates, in the order of the table.
std::vector<std::string> proveCandidates();

/// Measures one view at 640x360, adds a row per candidate to figures["rows"] and every sweep to figures["sweeps"],
/// and prints progress on standard error.
/// @param divided  the same scene with cells
void measureProve(const LvView& view, const scene::SceneData& divided, const ProveOptions& options,
                  nlohmann::ordered_json& figures);

/// Prints the head of the table, the rows from an index on, and a table of the means over all rows, which it adds to
/// figures["means"].
void printProveHead();
void printProveRows(const nlohmann::ordered_json& figures, std::size_t first);
void printProveMeans(nlohmann::ordered_json& figures);

}  // namespace jalousie::bench
