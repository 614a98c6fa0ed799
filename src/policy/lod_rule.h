// The rules by which an object gets its level of detail, in one table.
#pragma once

#include <span>

#include "policy/lv_measure.h"
#include "shared/traits.h"

namespace jalousie {

/// Values index lodRuleTable().
enum class LodRule : gpu::uint {
  kFinest,      ///< LOD 0
  kLinear,      ///< LV mapped linearly onto the levels (thesis 4.1.3)
  kPixelError,  ///< coarsest level whose screen-space error is at most tau
  kCoverage,    ///< finest level whose stored share of the screen the object covers
  kLvError,     ///< the same, with tau relaxed by LV
  kPrice,       ///< least sum of visible error and triangles, at one price of a triangle for all objects
};

/// One row of the table.
struct LodRuleRow {
  const char* name;  ///< value of --lod
  LodRule id;
  bool followsError = false;             ///< uses tau; hysteresis and cross-fades apply
  bool followsCoverage = false;          ///< uses the thresholds of MSFT_screencoverage; with followsError
  bool followsLv = false;                ///< uses the level of visibility
  bool pricesTriangles = false;          ///< weighs error against triangles; with followsError and followsLv
  LvMeasure measure = LvMeasure::kNone;  ///< measure of LV where none is chosen
  const char* help;                      ///< phrase for --help, panel and docs
};

/// All rules, in the order of LodRule.
std::span<const LodRuleRow> lodRuleTable();
const LodRuleRow& rowOf(LodRule rule);
/// Whether LV makes the rule's tau larger.
bool relaxesTau(const LodRuleRow& rule);
/// Whether the rule needs the stored errors of levels.
bool usesErrors(const LodRuleRow& rule);
/// kTrait... of shared/traits.h.
gpu::uint traitsOf(LodRule rule);

}  // namespace jalousie
