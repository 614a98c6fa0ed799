// The buffers and textures that passes hand to each other: plain structs of borrowed pointers.
#pragma once

namespace jalousie::gl {
class Buffer;
class Texture;
}  // namespace jalousie::gl

namespace jalousie::visibility {

/// The scene's buffers. The caller owns them and keeps them while a pass uses them.
struct SceneBindings {
  const gl::Buffer* transforms = nullptr;  ///< gpu::Transform, by Object::transform
  const gl::Buffer* objects = nullptr;     ///< gpu::Object [objectCount]
  const gl::Buffer* chains = nullptr;      ///< gpu::Chain
  const gl::Buffer* lods = nullptr;        ///< gpu::Lod

  // The cells of scene::SceneData::cells; null where the scene has none.
  const gl::Buffer* cells = nullptr;       ///< gpu::Object [cellCount]
  const gl::Buffer* cellChains = nullptr;  ///< gpu::Chain
  const gl::Buffer* cellLods = nullptr;    ///< gpu::Lod
  const gl::Buffer* cellBounds = nullptr;  ///< gpu::CellBounds, by cellLods

  /// What is drawn in the place of the objects: the cells, where there are any.
  SceneBindings drawn() const {
    return cells == nullptr ? *this : SceneBindings{transforms, cells, cellChains, cellLods};
  }
};

/// What a frame decided about every object, for draw lists and drawing programs.
struct ObjectBuffers {
  const gl::Buffer* view = nullptr;    ///< gpu::CullView
  const gl::Buffer* states = nullptr;  ///< gpu::ObjectState [objectCount]
  const gl::Buffer* boxes = nullptr;   ///< gpu::ScreenBox [objectCount]
  const gl::Buffer* marks = nullptr;   ///< kMark... [objectCount]
  const gl::Buffer* price = nullptr;   ///< gpu::PriceState, which BudgetPass moves

  // Of the cells; null where the scene has none.
  const gl::Buffer* cellStates = nullptr;  ///< gpu::ObjectState [cellCount]
  const gl::Buffer* cellMarks = nullptr;   ///< kMark... [cellCount]

  /// What draw lists are made of: states and marks of the cells, where there are any.
  ObjectBuffers drawn() const {
    return cellMarks == nullptr ? *this : ObjectBuffers{view, cellStates, boxes, cellMarks, price};
  }
};

/// The textures of the overlap test; which of them it reads depends on the traits of the mode.
struct CoverTextures {
  const gl::Texture* map = nullptr;      ///< occlusion map, with kTraitUsesMap
  const gl::Texture* pyramid = nullptr;  ///< depth pyramid, with kTraitUsesDepth
  const gl::Texture* depth = nullptr;    ///< level 0 of the pyramid, with kTraitUsesDepth
};

}  // namespace jalousie::visibility
