// The programs that draw and that play animations, in one table that a test builds completely.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

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
  kDensity,
  kDensityPatch,
  kLoose,
  kMapView,
  kDepthView,
  kOverdrawView,
  kBoxes,
  kMoveNodes,
  kMoveTargets,
  kBendVertices,
  kBoundPoses,
  kQueryBox,
  kQueryBoxMasked,  ///< with an importance mask
};

/// The define that reads instance lists with ARB_shader_draw_parameters instead of an instanced attribute.
inline constexpr const char* kDrawParametersDefine = "JAL_DRAW_PARAMETERS";

/// The define for scenes whose materials have more than a base colour with a plain texture.
inline constexpr const char* kFullMaterialsDefine = "JAL_FULL_MATERIALS";

/// The define that declares so many array textures, 1 to gpu::kTextureClasses (checked).
std::string_view textureClassesDefine(std::uint32_t count);

/// All programs, in the order of ProgramId.
std::span<const gl::ProgramSource> programTable();
inline const gl::ProgramSource& programSource(ProgramId id) {
  return programTable()[static_cast<unsigned>(id)];
}

}  // namespace jalousie::render
