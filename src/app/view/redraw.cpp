// Number of frames until pictures have settled.
#include "app/view/redraw.h"

namespace jalousie::app {
namespace {

/// Enough for both phases of hiz to settle and for pixels to be counted.
constexpr std::uint32_t kSettleFrames = 8;
/// With --calm, LV is smoothed over time: four seconds of a moving picture (docs/lod_selection.md).
constexpr std::uint32_t kCalmFrames = 128;

}  // namespace

void Redraw::scenesChanged() {
  sceneFrames_ = kSettleFrames;
  for (const Configuration& configuration : state_.configurations)
    if (configuration.active.frameOptions.calm) sceneFrames_ = kCalmFrames;
  interfaceChanged();
  inspectionOutdated();
}

}  // namespace jalousie::app
