// One range for each component.
#include "bake/io/attribute_range.h"

#include <algorithm>
#include <limits>

namespace jalousie::bake {
namespace {

bool isDirectionOrPlace(const std::string& name) {
  return name == "POSITION" || name == "NORMAL" || name == "TANGENT" || name.starts_with("TEXCOORD_");
}

void clamp(Attribute& level, const Attribute& finest) {
  for (std::size_t k = 0; k < finest.components; ++k) {
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (std::size_t i = k; i < finest.values.size(); i += finest.components) {
      low = std::min(low, finest.values[i]);
      high = std::max(high, finest.values[i]);
    }
    if (low > high) continue;
    for (std::size_t i = k; i < level.values.size(); i += level.components)
      level.values[i] = std::clamp(level.values[i], low, high);
  }
}

}  // namespace

void clampToRange(CombinedMesh& level, const CombinedMesh& finest) {
  for (std::size_t p = 0; p < level.primitives.size() && p < finest.primitives.size(); ++p) {
    std::vector<Attribute>& attributes = level.primitives[p].attributes;
    for (std::size_t a = 0; a < attributes.size(); ++a)
      if (!isDirectionOrPlace(attributes[a].name)) clamp(attributes[a], finest.primitives[p].attributes[a]);
  }
}

}  // namespace jalousie::bake
