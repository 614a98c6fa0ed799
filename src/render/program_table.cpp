// One line per program.
#include "render/program_table.h"

#include <iterator>
#include <vector>

#include "core/check.h"
#include "shared/limits.h"

namespace jalousie::render {
namespace {

using Stages = std::vector<std::string_view>;

Stages meshStages(const char* fragments) {
  return {"render/mesh.vert", fragments};
}
Stages patchStages(const char* fragments) {
  return {"render/patch.vert", "render/patch.tesc", "render/patch.tese", fragments};
}

}  // namespace

std::string_view textureClassesDefine(std::uint32_t count) {
  static constexpr std::string_view kDefines[] = {
      "JAL_TEXTURE_CLASSES=1", "JAL_TEXTURE_CLASSES=2", "JAL_TEXTURE_CLASSES=3", "JAL_TEXTURE_CLASSES=4",
      "JAL_TEXTURE_CLASSES=5", "JAL_TEXTURE_CLASSES=6", "JAL_TEXTURE_CLASSES=7", "JAL_TEXTURE_CLASSES=8"};
  static_assert(std::size(kDefines) == gpu::kTextureClasses);
  JAL_CHECK(count >= 1U);
  JAL_CHECK(count <= gpu::kTextureClasses);
  return kDefines[count - 1];
}

std::span<const gl::ProgramSource> programTable() {
  constexpr const char* kShade = "render/mesh.frag";
  constexpr const char* kCover = "render/coverage.frag";
  static const gl::ProgramSource kPrograms[] = {
      {"shaded solid", meshStages(kShade), {"JAL_SHADED"}},
      {"shaded sheet", meshStages(kShade), {"JAL_SHADED", "JAL_SHEET"}},
      {"shaded solid patch", patchStages(kShade), {"JAL_SHADED"}},
      {"shaded sheet patch", patchStages(kShade), {"JAL_SHADED", "JAL_SHEET"}},
      {"opacity solid", meshStages(kCover), {"JAL_OPACITY"}},
      {"opacity sheet", meshStages(kCover), {"JAL_OPACITY", "JAL_SHEET"}},
      {"opacity solid patch", patchStages(kCover), {"JAL_OPACITY"}},
      {"opacity sheet patch", patchStages(kCover), {"JAL_OPACITY", "JAL_SHEET"}},
      {"id solid", meshStages(kCover), {"JAL_ID"}},
      {"id sheet", meshStages(kCover), {"JAL_ID", "JAL_SHEET"}},
      {"id solid patch", patchStages(kCover), {"JAL_ID"}},
      {"id sheet patch", patchStages(kCover), {"JAL_ID", "JAL_SHEET"}},
      {"density", {"render/mesh.vert", "render/density.geom", "render/density_view.frag"}, {"JAL_SHEET"}},
      {"density patch",
       {"render/patch.vert", "render/patch.tesc", "render/patch.tese", "render/density.geom",
        "render/density_view.frag"},
       {"JAL_SHEET"}},
      {"points and lines", {"render/loose.vert", "render/loose.frag"}, {}},
      {"map view", {"render/fullscreen.vert", "render/map_view.frag"}, {}},
      {"depth view", {"render/fullscreen.vert", "render/map_view.frag"}, {"JAL_DEPTH"}},
      {"overdraw view", {"render/fullscreen.vert", "render/overdraw_view.frag"}, {}},
      {"boxes", {"render/boxes.vert", "render/flat.frag"}, {}},
      {"move nodes", {"motion/move_nodes.comp"}, {}},
      {"move targets", {"motion/move_targets.comp"}, {}},
      {"bend vertices", {"motion/bend_vertices.comp"}, {}},
      {"bound poses", {"motion/bound_poses.comp"}, {}},
      {"query box", {"render/query_box.vert", "render/query_box.frag"}, {}},
      {"query box, masked", {"render/query_box.vert", "render/query_box.frag"}, {"JAL_MASKED"}},
  };
  return kPrograms;
}

}  // namespace jalousie::render
