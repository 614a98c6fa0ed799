// One row per compute program.
#include "visibility/program_table.h"

namespace jalousie::visibility {

std::span<const gl::ProgramSource> programTable() {
  static const gl::ProgramSource kPrograms[] = {
      {"classify", {"visibility/classify.comp"}, {}},
      {"reduce map", {"visibility/reduce_map.comp"}, {}},
      {"analyse map", {"visibility/analyse.comp"}, {"JAL_USES_MAP"}},
      {"analyse map and depth", {"visibility/analyse.comp"}, {"JAL_USES_MAP", "JAL_USES_DEPTH"}},
      {"analyse depth", {"visibility/analyse.comp"}, {"JAL_USES_DEPTH"}},
      {"reduce depth, first level", {"visibility/reduce_depth.comp"}, {"JAL_FROM_DEPTH"}},
      {"reduce depth, first level, covered", {"visibility/reduce_depth.comp"}, {"JAL_FROM_DEPTH", "JAL_COVERED"}},
      {"reduce depth", {"visibility/reduce_depth.comp"}, {}},
      {"reduce depth, min filter", {"visibility/reduce_depth.comp"}, {"JAL_MINMAX"}},
      {"bin objects", {"visibility/bin_objects.comp"}, {}},
      {"bin objects, tile per thread", {"visibility/bin_objects.comp"}, {"JAL_TILE_PER_THREAD"}},
      {"scan entries", {"visibility/scan.comp"}, {}},
      {"scan sums", {"visibility/scan.comp"}, {"JAL_SCAN_SUMS"}},
      {"scatter", {"visibility/scatter.comp"}, {}},
      {"scatter, tile per thread", {"visibility/scatter.comp"}, {"JAL_TILE_PER_THREAD"}},
      {"scatter per object", {"visibility/scatter.comp"}, {"JAL_PER_OBJECT"}},
      {"scatter per object, tile per thread", {"visibility/scatter.comp"}, {"JAL_PER_OBJECT", "JAL_TILE_PER_THREAD"}},
      {"write commands", {"visibility/write_commands.comp"}, {}},
      {"write counts", {"visibility/write_commands.comp"}, {"JAL_PER_OBJECT"}},
      {"count states", {"visibility/count_states.comp"}, {}},
      {"count pixels", {"visibility/count_pixels.comp"}, {}},
      {"mark ghosts", {"visibility/mark_ghosts.comp"}, {}},
      {"classify cells", {"visibility/classify_cells.comp"}, {}},
      {"analyse cells, map", {"visibility/analyse_cells.comp"}, {"JAL_USES_MAP"}},
      {"analyse cells, map and depth", {"visibility/analyse_cells.comp"}, {"JAL_USES_MAP", "JAL_USES_DEPTH"}},
      {"analyse cells, depth", {"visibility/analyse_cells.comp"}, {"JAL_USES_DEPTH"}},
      {"count cells", {"visibility/count_cells.comp"}, {}},
      {"count states of cells", {"visibility/count_states.comp"}, {"JAL_CELLS"}},
      {"mark ghosts of cells", {"visibility/mark_ghosts.comp"}, {"JAL_CELLS"}},
      {"adjust price", {"visibility/adjust_price.comp"}, {}},
      {"budget, sum", {"visibility/budget_sum.comp"}, {}},
      {"budget, sum of cells", {"visibility/budget_sum.comp"}, {"JAL_CELLS"}},
      {"budget, plan", {"visibility/budget_plan.comp"}, {}},
      {"budget, forecast", {"visibility/budget_forecast.comp"}, {}},
      {"budget, limit", {"visibility/budget_limit.comp"}, {}},
      {"slice commands", {"visibility/slice_commands.comp"}, {}},
      {"drop hidden", {"visibility/drop_hidden.comp"}, {}},
      {"hide objects", {"visibility/hide_objects.comp"}, {}},
      {"hide cells", {"visibility/hide_cells.comp"}, {}},
      {"face ranges", {"visibility/face_ranges.comp"}, {}},
      {"face commands", {"visibility/face_commands.comp"}, {}},
      {"slice faces", {"visibility/slice_faces.comp"}, {}},
  };
  return kPrograms;
}

}  // namespace jalousie::visibility
