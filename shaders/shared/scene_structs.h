// The scene as the kernels see it: objects, LOD chains, levels, materials.
#ifndef JALOUSIE_SHARED_SCENE_STRUCTS_H
#define JALOUSIE_SHARED_SCENE_STRUCTS_H

#include "shared/types.h"

JAL_SHARED_BEGIN

/// Rows of a 3x4 affine transform, world units. Several objects may refer to one transform. The application may rewrite
/// the transforms in every frame.
struct Transform {
  vec4 worldFromObject0;
  vec4 worldFromObject1;
  vec4 worldFromObject2;
};
JAL_ASSERT_SIZE(Transform, 48)

/// One object, the unit of the choice of detail; or one of the cells that it is culled and drawn in. The chain of a
/// cell has the cell's triangles of every level. Both are sorted by chain, so that what has one level lies side by side
/// in the draw lists.
struct Object {
  uint chain;      // index into chains: those of the objects, or those of the cells
  uint transform;  // index into transforms
  uint owner;      // instance that the object is, or is a part of: index in the file's order
  uint object;     // a cell: index of its object; an object: its own index
};
JAL_ASSERT_SIZE(Object, 16)

/// One LOD chain. Its box bounds every level, and the tessellated surface where that path is in use.
struct Chain {
  vec4 boundsMinObject;  // xyz, object space
  vec4 boundsMaxObject;
  uint firstLod;    // index into lods of LOD 0
  uint lodCount;    // >= 1
  uint patchLod;    // index into lods of the base mesh for tessellation
  uint binCount;    // 2 per level: plain and mirrored; at least 4 where there is a patch base
  uint firstEntry;  // of the chain's counts, [binCount][tileCount] in the array that the prefix sum runs over
  uint tileCount;
  float surfaceObject;  // area of LOD 0, square of an object-space length
  uint reserved0;
};
JAL_ASSERT_SIZE(Chain, 64)

/// Up to kObjectGroupSize consecutive objects of one chain.
struct Tile {
  uint firstObject;
  uint objectCount;  // 1..kObjectGroupSize
  uint chain;
  uint tileOfChain;  // 0 for the chain's first tile
};
JAL_ASSERT_SIZE(Tile, 16)

/// One bin of one chain: what one instanced command draws.
struct Bin {
  uint chain;
  uint bin;  // 2 * level + mirrored; with tessellation level 0 is the plain base, level 1 its patches
};
JAL_ASSERT_SIZE(Bin, 8)

/// One level: a range of the scene's index buffer: solid triangles, then sheets, then blended ones.
struct Lod {
  uint firstIndex;
  uint solidCount;  // indices of single-sided opaque triangles
  uint sheetCount;  // indices of double-sided or masked triangles
  uint blendCount;  // indices of blended triangles
  int baseVertex;
  uint triangleCount;     // (solidCount + sheetCount + blendCount) / 3
  float errorObject;      // largest deviation from LOD 0, object-space length; of a patch base: its flat triangles from
                          // its own curved surface. Infinite where unknown
  float meanErrorObject;  // mean deviation, ascending along the chain; errorObject where unknown
  float leastCoverage;    // least share of the screen that the level is drawn at by kTraitCoverage, descending; 0 where
                          // unknown, so that LOD 0 is drawn
};
JAL_ASSERT_SIZE(Lod, 36)

/// Bounds of a cell's triangles at one level, object space. Empty (min > max) where the cell has none at that level.
struct CellBounds {
  vec4 minObject;  // xyz
  vec4 maxObject;
};
JAL_ASSERT_SIZE(CellBounds, 32)

const uint kMaterialMask = 1u;   // discard below the cutoff
const uint kMaterialBlend = 2u;  // ordered dither by alpha; never occludes
const uint kMaterialDoubleSided = 4u;
const uint kMaterialTextured = 8u;
const uint kMaterialEmissionTextured = 16u;
const uint kMaterialNormalTextured = 32u;
const uint kMaterialUnlit = 64u;

// Bits of TextureUse.sampling.
const uint kSamplingClampU = 1u;
const uint kSamplingMirrorU = 2u;
const uint kSamplingClampV = 4u;
const uint kSamplingMirrorV = 8u;
const uint kSamplingMagnifyNearest = 16u;
const uint kSamplingMinifyNearest = 32u;
const uint kSamplingMipNearest = 64u;
const uint kSamplingMipNone = 128u;
const uint kSamplingSecondUv = 256u;
const uint kSamplingWidthShift = 16u;   // logarithm of the width of the layer, 5 bits
const uint kSamplingHeightShift = 24u;  // and of its height

/// A picture on a surface.
struct TextureUse {
  vec4 uvAxes;    // what u (xy) and v (zw) become
  vec2 uvOffset;  // added to them
  uint place;     // bits 0-15: layer of its array texture; bits 16-31: which array texture, below kTextureClasses
  uint sampling;  // kSampling...
};
JAL_ASSERT_SIZE(TextureUse, 32)

struct Material {
  vec4 baseColor;  // linear RGB, alpha
  vec4 emission;   // linear RGB; w: scale of x and y of the normals of a texture
  uint flags;      // kMaterial...
  float alphaCutoff;
  uint reserved0;
  uint reserved1;
  TextureUse base;  // with kMaterialTextured
  TextureUse emissive;
  TextureUse normals;
};
JAL_ASSERT_SIZE(Material, 144)

/// The layout glMultiDrawElementsIndirect reads.
struct DrawCommand {
  uint count;
  uint instanceCount;
  uint firstIndex;
  int baseVertex;
  uint baseInstance;  // first entry of the instance list, which holds object ids
};
JAL_ASSERT_SIZE(DrawCommand, 20)

JAL_SHARED_END

#endif
