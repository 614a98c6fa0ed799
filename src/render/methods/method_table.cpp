// One line per method.
#include "render/methods/method_table.h"

#include "core/check.h"
#include "render/methods/frustum/frustum_method.h"
#include "render/methods/full/full_method.h"
#include "render/methods/hiz/hiz_method.h"
#include "render/methods/hom/hom_method.h"
#include "render/methods/hom_depth/hom_depth_method.h"
#include "render/methods/portals/portal_method.h"
#include "render/methods/queries/query_method.h"
#include "render/methods/shadows/shadow_method.h"

namespace jalousie::render {
namespace {

/// What several methods share.
struct SharedParts {
  const scene::SceneData& scene;
  std::shared_ptr<QueryScene> boxes;   ///< the scene over a bounding volume hierarchy
  std::shared_ptr<QueryScene> grid;    ///< over a loose grid
  std::shared_ptr<QueryScene> nested;  ///< and over nested grids
};

std::unique_ptr<CullMethod> makeMethod(CullMode mode, const SharedParts& shared) {
  const auto query = [&](culling::QueryMethod method) { return std::make_unique<QueryMethod>(shared.boxes, method); };
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
    case CullMode::kQueryWait:
      return query(culling::QueryMethod::kWait);
    case CullMode::kQueryBatch:
      return query(culling::QueryMethod::kBatch);
    case CullMode::kChcFlat:
      return query(culling::QueryMethod::kCoherentFlat);
    case CullMode::kChc:
      return query(culling::QueryMethod::kCoherent);
    case CullMode::kChcPlusPlus:
      return query(culling::QueryMethod::kCoherentPlus);
    case CullMode::kEyeSiding:
      return std::make_unique<QueryMethod>(shared.grid, culling::QueryMethod::kSiblings);
    case CullMode::kNestedGrid:
      return std::make_unique<QueryMethod>(shared.nested, culling::QueryMethod::kSlabs);
    case CullMode::kQueryConditional:
      return query(culling::QueryMethod::kDeferred);
    case CullMode::kQueryBuffer:
      return std::make_unique<QueryMethod>(shared.boxes, culling::QueryMethod::kDeferred, DeferredDrawing::kBuffer);
    case CullMode::kPlanar:
      return std::make_unique<ShadowMethod>(shared.scene, shared.boxes, culling::OccluderUse::kPolygons);
    case CullMode::kSolid:
      return std::make_unique<ShadowMethod>(shared.scene, shared.boxes, culling::OccluderUse::kSolids);
    case CullMode::kPortals:
      return std::make_unique<PortalMethod>(shared.scene, shared.boxes);
  }
  return nullptr;
}

}  // namespace

MethodTable::MethodTable(const MethodInputs& inputs) {
  const auto overGrid = [&](culling::QueryMethod method) {
    return std::make_shared<QueryScene>(inputs, culling::gridOptions(method));
  };
  const SharedParts shared{inputs.scene, std::make_shared<QueryScene>(inputs),
                           overGrid(culling::QueryMethod::kSiblings), overGrid(culling::QueryMethod::kSlabs)};
  for (const CullModeRow& row : cullModeTable()) {
    std::unique_ptr<CullMethod> method = makeMethod(row.id, shared);
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
