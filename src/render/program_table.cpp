// One line per drawing program.
#include "render/program_table.h"

namespace jalousie::render {

std::span<const gl::ProgramSource> programTable() {
  static const gl::ProgramSource kPrograms[] = {
      {"shaded solid", {"render/mesh.vert", "render/mesh.frag"}, {}},
      {"shaded sheet", {"render/mesh.vert", "render/mesh.frag"}, {"JAL_SHEET"}},
      {"shaded solid patch", {"render/patch.vert", "render/patch.tesc", "render/patch.tese", "render/mesh.frag"}, {}},
      {"shaded sheet patch",
       {"render/patch.vert", "render/patch.tesc", "render/patch.tese", "render/mesh.frag"},
       {"JAL_SHEET"}},
      {"opacity solid", {"render/mesh.vert", "render/opacity.frag"}, {"JAL_OPACITY"}},
      {"opacity sheet", {"render/mesh.vert", "render/opacity.frag"}, {"JAL_OPACITY", "JAL_SHEET"}},
      {"opacity solid patch",
       {"render/patch.vert", "render/patch.tesc", "render/patch.tese", "render/opacity.frag"},
       {"JAL_OPACITY"}},
      {"opacity sheet patch",
       {"render/patch.vert", "render/patch.tesc", "render/patch.tese", "render/opacity.frag"},
       {"JAL_OPACITY", "JAL_SHEET"}},
      {"map view", {"render/fullscreen.vert", "render/map_view.frag"}, {}},
  };
  return kPrograms;
}

}  // namespace jalousie::render
