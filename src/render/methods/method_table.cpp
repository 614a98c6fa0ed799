// One line per method.
#include "render/methods/method_table.h"

#include "core/check.h"
#include "render/methods/frustum/frustum_method.h"
#include "render/methods/full/full_method.h"
#include "render/methods/hiz/hiz_method.h"
#include "render/methods/hom/hom_method.h"
#include "render/methods/hom_depth/hom_depth_method.h"

namespace jalousie::render {
namespace {

/// @param inputs  for methods that need more than a FrameContext
std::unique_ptr<CullMethod> makeMethod(CullMode mode, [[maybe_unused]] const MethodInputs& inputs) {
  switch (mode) {
    case CullMode::kFull:
      return std::make_unique<FullMethod>();
    case CullMode::kFrustum:
      return std::make_unique<FrustumMethod>();
    case CullMode::kHom:
      return std::make_unique<HomMethod>();
    case CullMode::kHomDepth:
      return std::make_unique<HomDepthMethod>();
    case CullMode::kHiz:
      return std::make_unique<HizMethod>();
  }
  return nullptr;
}

}  // namespace

MethodTable::MethodTable(const MethodInputs& inputs) {
  for (const CullModeRow& row : cullModeTable()) {
    std::unique_ptr<CullMethod> method = makeMethod(row.id, inputs);
    const bool known = method != nullptr;
    JAL_CHECK(known);
    methods_.push_back(std::move(method));
  }
}

void MethodTable::resize(std::uint32_t width, std::uint32_t height) const {
  for (const std::unique_ptr<CullMethod>& method : methods_)
    method->resize(width, height);
}

void MethodTable::forget() const {
  for (const std::unique_ptr<CullMethod>& method : methods_)
    method->forget();
}

}  // namespace jalousie::render
