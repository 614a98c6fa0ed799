// Which object a vertex belongs to: an entry of the instance list.
// JAL_DRAW_PARAMETERS: read with ARB_shader_draw_parameters; else core 4.5, as an instanced attribute.

#ifdef JAL_DRAW_PARAMETERS
layout(std430, binding = kBindingDrawInstances) readonly buffer InstanceBlock { uint instances[]; };
uint instanceEntry() { return instances[gl_BaseInstanceARB + gl_InstanceID]; }
#else
layout(location = kAttributeObject) in uint objectAttribute;
uint instanceEntry() { return objectAttribute; }
#endif
