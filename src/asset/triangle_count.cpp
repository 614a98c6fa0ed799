// Counts from the accessors' headers.
#include "asset/triangle_count.h"

namespace jalousie::asset {

std::uint64_t triangleCount(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) return 0;
  const int accessor = primitive.indices >= 0 ? primitive.indices : position->second;
  const std::uint64_t corners = model.accessors[static_cast<std::size_t>(accessor)].count;
  const bool isList = primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1;
  if (isList) return corners / 3;
  return primitive.mode > TINYGLTF_MODE_TRIANGLES && corners > 2 ? corners - 2 : 0;
}

}  // namespace jalousie::asset
