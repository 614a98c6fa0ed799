// Buffer blocks shared by the visibility kernels.

layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(std430, binding = kBindingObjects) readonly buffer ObjectBlock { Object objects[]; };
layout(std430, binding = kBindingChains) readonly buffer ChainBlock { Chain chains[]; };
layout(std430, binding = kBindingLods) readonly buffer LodBlock { Lod lods[]; };
layout(std430, binding = kBindingStates) buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingRects) buffer RectBlock { ScreenRect rects[]; };
layout(std430, binding = kBindingCommands) writeonly buffer CommandBlock { DrawCommand commands[]; };
