// Formats the report of jalousie-scatter.
#include "scatter/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scatter/camera_path.h"
#include "scatter/occluder.h"

namespace jalousie::scatter {
namespace {

using nlohmann::ordered_json;

const char* rotationName(Rotation rotation) {
  switch (rotation) {
    case Rotation::kX:
      return "x";
    case Rotation::kAny:
      return "any";
    case Rotation::kNone:
      break;
  }
  return "none";
}

ordered_json vectorJson(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

const char* shapeName(Shape shape) {
  switch (shape) {
    case Shape::kGround:
      return "ground";
    case Shape::kCity:
      return "city";
    case Shape::kCube:
      break;
  }
  return "cube";
}

std::string reportJson(const Options& options, const Summary& summary) {
  const Layout& layout = options.layout;
  ordered_json report;
  report["objects"] = layout.count;
  report["meshes_per_object"] = summary.meshesPerObject;
  report["layout"] = shapeName(layout.shape);
  report["side"] = summary.side;
  report["rotate"] = rotationName(layout.rotation);
  report["scale"] = {layout.scale.min, layout.scale.max};
  report["moving"] = summary.moving;
  report["seed"] = layout.seed;
  report["levels"] = summary.levels;
  report["triangles_per_object"] = summary.trianglesPerObject;
  report["triangles_full"] = summary.trianglesFull;
  report["occluder"] = nullptr;
  if (options.occluder) {
    report["occluder"] = {{"kind", occluderName(options.occluder->kind)},
                          {"cover", options.occluder->cover},
                          {"triangles", summary.occluderTriangles}};
  }
  if (layout.shape == Shape::kCity) {
    report["city"] = {{"built", layout.built},
                      {"blocks", summary.blocks},
                      {"buildings", summary.buildings},
                      {"boxes", summary.buildingBoxes},
                      {"triangles", summary.buildingTriangles}};
  }
  if (summary.groundTriangles > 0) report["ground_triangles"] = summary.groundTriangles;
  report["bounds"] = {{"min", vectorJson(summary.boundsWorld.min)}, {"max", vectorJson(summary.boundsWorld.max)}};
  report["camera_frames"] = kFrameCount;
  report["ignored"] = ordered_json::object();
  for (const auto& [name, count] : summary.ignored)
    report["ignored"][name] = count;
  return report.dump(2) + "\n";
}

std::string reportLine(const Options& options, const Summary& summary) {
  const std::uint32_t count = options.layout.count;
  std::string objects = count == 1 ? "1 object" : fmt::format("{} objects", count);
  if (summary.meshesPerObject > 1) objects += fmt::format(" of {} meshes", summary.meshesPerObject);
  const char* where = options.layout.shape == Shape::kCity     ? "in a city"
                      : options.layout.shape == Shape::kGround ? "on a ground"
                                                               : "in a cube";
  if (summary.buildings > 0) objects += fmt::format(" and {} buildings", summary.buildings);
  if (count > 1) objects += fmt::format(" {} of side {:.4g}", where, summary.side);
  if (summary.moving > 0) objects += fmt::format(", {} of them moving", summary.moving);
  return fmt::format("{}, {} triangles at LOD 0", objects, summary.trianglesFull);
}

}  // namespace jalousie::scatter
