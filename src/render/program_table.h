// The drawing programs, in one table that a test builds completely.
#pragma once

#include <span>

#include "gl/program.h"

namespace jalousie::render {

/// Shaded, opacity and id programs come in the same order: solid, sheet, solid patch, sheet patch.
enum class ProgramId : unsigned {
  kShadedSolid,
  kShadedSheet,
  kShadedSolidPatch,
  kShadedSheetPatch,
  kOpacitySolid,
  kOpacitySheet,
  kOpacitySolidPatch,
  kOpacitySheetPatch,
  kIdSolid,
  kIdSheet,
  kIdSolidPatch,
  kIdSheetPatch,
  kMapView,
  kDepthView,
  kOverdrawView,
  kBoxes,
};

/// The define that reads instance lists with ARB_shader_draw_parameters instead of an instanced attribute.
inline constexpr const char* kDrawParametersDefine = "JAL_DRAW_PARAMETERS";

/// All programs, in the order of ProgramId.
std::span<const gl::ProgramSource> programTable();
inline const gl::ProgramSource& programSource(ProgramId id) {
  return programTable()[static_cast<unsigned>(id)];
}

}  // namespace jalousie::render
