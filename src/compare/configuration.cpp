// All comparisons of culling modes, level rules and visibility measures that compare makes.
#include "compare/configuration.h"

#include "core/check.h"

namespace jalousie::compare {

bool Configuration::followsTau() const {
  return frame.lodRule == gpu::kLodPixelError || frame.lodRule == gpu::kLodLvError;
}

bool Configuration::tessellates() const {
  return frame.detail == gpu::kDetailTessellation;
}

bool dependsOnHistory(const render::FrameOptions& options) {
  return options.cullMode == gpu::kCullHiz || options.lvMeasure == gpu::kLvPixels || options.calm;
}

render::FrameOptions referenceOptions(Reference reference) {
  JAL_CHECK((reference != Reference::kNone));
  render::FrameOptions options;
  options.cullMode = reference == Reference::kFull ? gpu::kCullNone : gpu::kCullHiz;
  options.lodRule = gpu::kLodFinest;
  options.lvMeasure = gpu::kLvNone;
  return options;
}

}  // namespace jalousie::compare
