// Allocates the per-object buffers, cleared to zero.
#include "visibility/object_store.h"

#include "shared/frame_structs.h"

namespace jalousie::visibility {
namespace {

gl::Buffer makeStorage(std::size_t bytes, const char* name) {
  gl::Buffer buffer(bytes, GL_DYNAMIC_STORAGE_BIT, name);
  buffer.clear();
  return buffer;
}

}  // namespace

ObjectStore::ObjectStore(std::uint32_t count)
    : objectCount(count),
      states(makeStorage(sizeof(gpu::ObjectState) * count, "object states")),
      boxes(makeStorage(sizeof(gpu::ScreenBox) * count, "screen boxes")),
      marks(makeStorage(sizeof(gpu::uint) * count, "object marks")),
      pixelCounts(makeStorage(sizeof(gpu::uint) * count, "pixels per object")) {}

void ObjectStore::forget() {
  marks.clear();
}

}  // namespace jalousie::visibility
