// Questions of the experiment to the tables of modes and rules.
#include "compare/configuration.h"

#include "core/check.h"

namespace jalousie::compare {

bool Configuration::followsTau() const {
  return rowOf(frame.lodRule).followsError;
}

render::FrameOptions referenceOptions(Reference reference) {
  JAL_CHECK((reference != Reference::kNone));
  render::FrameOptions options;
  options.cullMode = reference == Reference::kFull ? CullMode::kFull : CullMode::kHiz;
  options.lodRule = LodRule::kFinest;
  options.lvMeasure = LvMeasure::kNone;
  return options;
}

}  // namespace jalousie::compare
