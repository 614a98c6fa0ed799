// The drawing programs, in one table that a test builds completely.
#pragma once

#include <span>

#include "gl/program.h"

namespace jalousie::render {

/// Shaded and opacity programs come in the order of the draw lists: solid, sheet, solid patch, sheet patch.
enum class ProgramId : unsigned {
  kShadedSolid,
  kShadedSheet,
  kShadedSolidPatch,
  kShadedSheetPatch,
  kOpacitySolid,
  kOpacitySheet,
  kOpacitySolidPatch,
  kOpacitySheetPatch,
  kMapView,
};

/// All programs, in the order of ProgramId.
std::span<const gl::ProgramSource> programTable();
inline const gl::ProgramSource& programSource(ProgramId id) {
  return programTable()[static_cast<unsigned>(id)];
}

}  // namespace jalousie::render
