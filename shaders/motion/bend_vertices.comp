// Moves the vertices of skinned and morphed meshes (glTF 2.0, 3.7.2.2 and 3.7.3.3), and of points and lines that move.
//
// One thread: one vertex. Reads bentVertices, influences, deltas, weights, joints. Writes positions and normals in the
// scene's vertex buffers. Barrier owed: VERTEX_ATTRIB_ARRAY. CPU twin: src/scene/motion_state.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/motion_structs.h"
#include "lib/groups.glsl"
#include "lib/transform.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingMotionView) uniform MotionViewBlock { MotionView motionView; };
layout(std430, binding = kBindingVertices) writeonly buffer VertexWordBlock { uint vertexWords[]; };
layout(std430, binding = kBindingLooseVertices) writeonly buffer LooseWordBlock { uint looseWords[]; };
layout(std430, binding = kBindingBentVertices) readonly buffer BentVertexBlock { BentVertex bentVertices[]; };
layout(std430, binding = kBindingInfluences) readonly buffer InfluenceBlock { Influence influences[]; };
layout(std430, binding = kBindingDeltas) readonly buffer DeltaBlock { MorphDelta deltas[]; };
layout(std430, binding = kBindingWeights) readonly buffer WeightBlock { float weights[]; };
layout(std430, binding = kBindingJoints) readonly buffer JointBlock { Transform joints[]; };

struct Moved {
  vec3 position;
  vec3 normal;  // not unit
};

Transform blendedJoints(BentVertex vertex) {
  Transform sum = Transform(vec4(0.0), vec4(0.0), vec4(0.0));
  for (uint i = 0u; i < vertex.influenceCount; ++i) {
    Influence influence = influences[vertex.firstInfluence + i];
    Transform joint = joints[influence.joint];
    sum.worldFromObject0 += influence.weight * joint.worldFromObject0;
    sum.worldFromObject1 += influence.weight * joint.worldFromObject1;
    sum.worldFromObject2 += influence.weight * joint.worldFromObject2;
  }
  return sum;
}

Moved moved(BentVertex vertex) {
  Moved result = Moved(vertex.position.xyz, vertex.normal.xyz);
  for (uint t = 0u; t < vertex.targetCount; ++t) {
    float weight = weights[vertex.firstWeight + t];
    if (weight == 0.0) continue;
    MorphDelta delta = deltas[vertex.firstDelta + t * vertex.deltaStride];
    result.position += weight * delta.position.xyz;
    result.normal += weight * delta.normal.xyz;
  }
  if ((vertex.flags & kBentSkinned) == 0u) return result;
  Transform blended = blendedJoints(vertex);
  return Moved(transformPoint(blended, result.position), transformNormal(blended, result.normal));
}

/// As packNormal in src/scene/scene_data.cpp.
uint packedNormal(vec3 normal) {
  vec3 scaled = clamp(normal, -1.0, 1.0) * 511.0;
  uvec3 bits = uvec3(ivec3(sign(scaled) * floor(abs(scaled) + 0.5))) & 0x3ffu;
  return bits.x | bits.y << 10 | bits.z << 20;
}

vec3 unitOr(vec3 v, vec3 fallback) {
  float size = length(v);
  return size > 0.0 && !isinf(size) ? v / size : fallback;
}

uint normalOf(BentVertex vertex, uint number, vec3 normal) {
  if ((vertex.flags & kBentLoose) != 0u) return packedNormal(unitOr(normal, vec3(0.0)));
  if ((vertex.flags & kBentFlat) != 0u) {
    uint first = number - (vertex.flags >> kBentCornerShift & 3u);
    vec3 corner = moved(bentVertices[first]).position;
    vec3 edge1 = moved(bentVertices[first + 1u]).position - corner;
    vec3 edge2 = moved(bentVertices[first + 2u]).position - corner;
    normal = cross(edge1, edge2);
  }
  return packedNormal(unitOr(normal, vec3(0.0, 0.0, 1.0)));
}

void main() {
  uint number = threadNumber();
  if (number >= motionView.vertexCount) return;
  BentVertex vertex = bentVertices[number];
  Moved result = moved(vertex);
  uint word = vertex.destination * kVertexWords;
  uint normal = normalOf(vertex, number, result.normal);
  uvec3 position = floatBitsToUint(result.position);
  if ((vertex.flags & kBentLoose) != 0u) {
    for (uint k = 0u; k < 3u; ++k)
      looseWords[word + k] = position[k];
    looseWords[word + kVertexNormalWord] = normal;
  } else {
    for (uint k = 0u; k < 3u; ++k)
      vertexWords[word + k] = position[k];
    vertexWords[word + kVertexNormalWord] = normal;
  }
}
