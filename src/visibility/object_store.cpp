// Allocates the per-object buffers, cleared to zero.
#include "visibility/object_store.h"

#include "shared/frame_structs.h"
#include "visibility/price_control.h"
#include "visibility/storage.h"
#include "visibility/triangle_budget.h"

namespace jalousie::visibility {
ObjectStore::ObjectStore(std::uint32_t count, std::uint32_t cells)
    : objectCount(count),
      states(makeStorage(sizeof(gpu::ObjectState) * count, GL_DYNAMIC_STORAGE_BIT, "object states")),
      boxes(makeStorage(sizeof(gpu::ScreenBox) * count, GL_DYNAMIC_STORAGE_BIT, "screen boxes")),
      marks(makeStorage(sizeof(gpu::uint) * count, GL_DYNAMIC_STORAGE_BIT, "object marks")),
      pixelCounts(makeStorage(sizeof(gpu::uint) * count, GL_DYNAMIC_STORAGE_BIT, "pixels per object")),
      cellCount(cells),
      cellStates(makeStorage(sizeof(gpu::ObjectState) * cells, GL_DYNAMIC_STORAGE_BIT, "cell states")),
      cellMarks(makeStorage(sizeof(gpu::uint) * cells, GL_DYNAMIC_STORAGE_BIT, "cell marks")),
      price(sizeof(gpu::PriceState), GL_DYNAMIC_STORAGE_BIT, "price"),
      budget(makeStorage(sizeof(BudgetWords), GL_DYNAMIC_STORAGE_BIT, "triangle budget")),
      drawnTriangles(makeStorage(sizeof(gpu::uint) * (cells > 0 ? 2 * std::size_t{count} : 1), 0, "drawn triangles")) {
  price.writeValue(firstPrice());
}

void ObjectStore::forget() {
  marks.clear();
  cellMarks.clear();
  price.writeValue(firstPrice());
}

}  // namespace jalousie::visibility
