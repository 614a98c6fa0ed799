// Counts only; no time.
#include "frustum_steps.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "culling/frustum_tree.h"
#include "gl_bench.h"

namespace jalousie::bench {
namespace {

struct Variant {
  const char* name;
  culling::FrustumSteps steps;
};
/// Each one adds a step; the first one is the flat test of all objects.
constexpr Variant kVariants[] = {
    {"flat", {false, false, false, false}},
    {"flat, last plane first", {false, false, true, false}},
    {"hierarchy", {true, false, false, false}},
    {"hierarchy, plane masks", {true, true, false, false}},
    {"hierarchy, plane masks, last plane first", {true, true, true, false}},
    {"the same, spheres first", {true, true, true, true}},
};

}  // namespace

void measureFrustumSteps(const test::Journey& journey, float aspect, std::uint32_t frames,
                         nlohmann::ordered_json& figures) {
  const culling::SpatialHierarchy tree = culling::buildHierarchy(journey.scene);
  const double all = static_cast<double>(tree.objects.size()) * frames;
  fmt::print(
      "\n| frustum culling on the CPU | box against plane, per object | sphere against plane | nodes |\n"
      "|---|---|---|---|\n");
  for (const Variant& variant : kVariants) {
    culling::FrustumCuller culler(tree);
    culling::FrustumCost sum;
    std::vector<std::uint8_t> inside;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      const culling::Frustum frustum(scene::clipFromWorld(journey.camera(frame), aspect));
      const culling::FrustumCost cost = culler.cull(frustum, variant.steps, inside);
      sum.nodes += cost.nodes;
      sum.planesOfBoxes += cost.planesOfBoxes;
      sum.planesOfSpheres += cost.planesOfSpheres;
      for (std::size_t i = 0; i < tree.objects.size(); ++i)
        require(frustum.holdsPartOf(tree.objectBounds[i]) == (inside[tree.objects[i]] != 0),
                fmt::format("{}: {} disagrees with the flat test", journey.name, variant.name));
    }
    fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} |\n", variant.name, static_cast<double>(sum.planesOfBoxes) / all,
               static_cast<double>(sum.planesOfSpheres) / all, static_cast<double>(sum.nodes) / all);
    figures.push_back({{"scene", journey.name},
                       {"frustum_steps", variant.name},
                       {"planes_of_boxes", static_cast<double>(sum.planesOfBoxes) / all},
                       {"planes_of_spheres", static_cast<double>(sum.planesOfSpheres) / all},
                       {"nodes", static_cast<double>(sum.nodes) / all}});
  }
}

}  // namespace jalousie::bench
