// Colours points and lines: lit where the file has normals, else base colour and emission (glTF 2.0, 3.9.6). Views that
// colour objects leave them grey.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "shared/palette.h"
#include "lib/surface.glsl"
#include "lib/shading.glsl"
#include "lib/view_ray.glsl"

layout(std140, binding = kBindingDrawView) uniform DrawViewBlock { DrawView drawView; };

in Loose {
  vec3 positionWorld;
  vec3 normalWorld;
  TextureCoordinates uv;
  vec4 color;
  flat uint material;
} vertex;

layout(location = 0) out vec4 frameColor;
layout(location = 1) out uint objectNumber;  // only where the frame has an item buffer: they belong to no object

void main() {
  Material material = materials[vertex.material];
  vec4 base = baseColor(material, vertex.color, vertex.uv);
  if (isHole(material, true, false, base.a, uvec2(gl_FragCoord.xy))) discard;
  vec3 toEye = -normalize(viewRay(drawView.cameraWorld, drawView.forwardWorld, vertex.positionWorld));
  bool isLit = (material.flags & kMaterialUnlit) == 0u && dot(vertex.normalWorld, vertex.normalWorld) > 0.0;
  vec3 color = base.rgb;
  if (!isShadedView(drawView.view))
    color = kColorLoose.rgb;
  else if (isLit)
    color = exposed(lightFrom(base.rgb, normalize(vertex.normalWorld), toEye, drawView.lightWorld.xyz) +
                    material.emission.rgb);
  else if ((material.flags & kMaterialUnlit) == 0u)
    color = min(base.rgb + material.emission.rgb, vec3(1.0));
  frameColor = vec4(color, 1.0);
  objectNumber = 0u;
}
