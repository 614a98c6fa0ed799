// The scene as the kernels see it: objects, LOD chains, levels, materials.
#ifndef JALOUSIE_SHARED_SCENE_STRUCTS_H
#define JALOUSIE_SHARED_SCENE_STRUCTS_H

#include "shared/types.h"

JAL_SHARED_BEGIN

const uint kObjectMirrored = 1u;  // the transform has a negative determinant: front faces wind clockwise

/// One instance of a chain.
struct Object {
  vec4 worldFromObject0;  // rows of the 3x4 affine transform, world units
  vec4 worldFromObject1;
  vec4 worldFromObject2;
  uint chain;             // index into chains
  uint flags;             // kObject...
  uint reserved0;
  uint reserved1;
};
JAL_ASSERT_SIZE(Object, 64)

/// One LOD chain. Its box bounds every level, and the tessellated surface where that path is in use.
struct Chain {
  vec4 boundsMinObject;   // xyz, object space
  vec4 boundsMaxObject;
  uint firstLod;          // index into lods of LOD 0
  uint lodCount;          // >= 1
  uint patchLod;          // index into lods of the base mesh for tessellation
  uint reserved0;
};
JAL_ASSERT_SIZE(Chain, 48)

/// One level: a range of the scene's index buffer, solid triangles first.
struct Lod {
  uint firstIndex;
  uint solidCount;        // indices of single-sided opaque triangles
  uint sheetCount;        // indices of double-sided, masked or blended triangles, right behind
  int baseVertex;
  float errorObject;      // deviation from LOD 0, object-space length
  uint triangleCount;     // (solidCount + sheetCount) / 3
  uint reserved0;
  uint reserved1;
};
JAL_ASSERT_SIZE(Lod, 32)

const uint kMaterialMask = 1u;         // discard below the cutoff
const uint kMaterialBlend = 2u;        // ordered dither by alpha; never occludes
const uint kMaterialDoubleSided = 4u;
const uint kMaterialTextured = 8u;

struct Material {
  vec4 baseColor;         // linear RGB, alpha
  uint layer;             // of the base colour array texture, with kMaterialTextured
  uint flags;             // kMaterial...
  float alphaCutoff;
  uint reserved0;
};
JAL_ASSERT_SIZE(Material, 32)

/// The layout glMultiDrawElementsIndirect reads.
struct DrawCommand {
  uint count;
  uint instanceCount;
  uint firstIndex;
  int baseVertex;
  uint baseInstance;      // the object's index: an instanced attribute turns it into the object id
};
JAL_ASSERT_SIZE(DrawCommand, 20)

JAL_SHARED_END

#endif
