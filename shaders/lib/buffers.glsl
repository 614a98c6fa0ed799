// Buffer blocks shared by the visibility kernels.

layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
#include "lib/traits.glsl"
layout(std430, binding = kBindingTransforms) readonly buffer TransformBlock { Transform transforms[]; };
layout(std430, binding = kBindingObjects) readonly buffer ObjectBlock { Object objects[]; };
layout(std430, binding = kBindingChains) readonly buffer ChainBlock { Chain chains[]; };
layout(std430, binding = kBindingLods) readonly buffer LodBlock { Lod lods[]; };
layout(std430, binding = kBindingStates) buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingBoxes) buffer BoxBlock { ScreenBox boxes[]; };
layout(std430, binding = kBindingMarks) buffer MarkBlock { uint marks[]; };
