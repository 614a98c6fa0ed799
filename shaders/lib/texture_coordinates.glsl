// Texture coordinates on their way from a vertex to a fragment: TEXCOORD_0 and, with JAL_FULL_MATERIALS, TEXCOORD_1.
#ifdef JAL_FULL_MATERIALS
#define TextureCoordinates vec4
#else
#define TextureCoordinates vec2
#endif
