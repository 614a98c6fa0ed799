// One line per compute program.
#include "visibility/program_table.h"

namespace jalousie::visibility {

std::span<const gl::ProgramSource> programTable() {
  static const gl::ProgramSource kPrograms[] = {
      {"classify", {"visibility/classify.comp"}, {}},
      {"reduce map", {"visibility/reduce_map.comp"}, {}},
      {"analyse", {"visibility/analyse.comp"}, {}},
      {"emit commands", {"visibility/emit_commands.comp"}, {}},
  };
  return kPrograms;
}

}  // namespace jalousie::visibility
