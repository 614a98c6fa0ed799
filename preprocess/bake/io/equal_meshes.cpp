// Compares meshes whose hashes agree.
#include "bake/io/equal_meshes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <unordered_map>

#include "asset/accessor_layout.h"

namespace jalousie::bake {
namespace {

using asset::detail::Elements;

constexpr std::uint64_t kNoLimit = ~0ULL;
/// Meshes of one hash that are compared at most: hashes of honest meshes do not collide.
constexpr std::size_t kMostOfOneHash = 4;

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15ULL;
  return hash ^ (hash >> 32U);
}

class Comparison {
 public:
  explicit Comparison(const tinygltf::Model& model) : model_(model), hashes_(model.accessors.size()) {}

  bool mayEqual(const tinygltf::Mesh& mesh) const {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (!primitive.targets.empty() || !isPlain(primitive.indices)) return false;
      for (const auto& [name, accessor] : primitive.attributes)
        if (!isPlain(accessor)) return false;
    }
    return true;
  }

  std::uint64_t hash(const tinygltf::Mesh& mesh) {
    std::uint64_t hash = mesh.primitives.size();
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      hash = mixed(hash, static_cast<std::uint64_t>(primitive.mode));
      hash = mixed(hash, static_cast<std::uint64_t>(primitive.material));
      hash = mixed(hash, hashOf(primitive.indices));
      for (const auto& [name, accessor] : primitive.attributes)
        hash = mixed(mixed(hash, name.size()), hashOf(accessor));
    }
    return hash;
  }

  bool areEqual(const tinygltf::Mesh& a, const tinygltf::Mesh& b) const {
    if (a.primitives.size() != b.primitives.size()) return false;
    for (std::size_t p = 0; p < a.primitives.size(); ++p)
      if (!areEqual(a.primitives[p], b.primitives[p])) return false;
    return true;
  }

 private:
  const tinygltf::Accessor& at(int accessor) const { return model_.accessors[static_cast<std::size_t>(accessor)]; }

  bool isPlain(int accessor) const {
    return accessor < 0 || (!at(accessor).sparse.isSparse && at(accessor).bufferView >= 0);
  }

  std::size_t elementSize(int accessor) const {
    return asset::detail::elementBytes(at(accessor).type, at(accessor).componentType);
  }

  std::uint64_t hashOf(int accessor) {
    if (accessor < 0) return 0;
    std::optional<std::uint64_t>& known = hashes_[static_cast<std::size_t>(accessor)];
    if (known) return *known;
    const Elements elements = asset::detail::baseElements(model_, accessor, kNoLimit);
    const std::size_t size = elementSize(accessor);
    std::uint64_t hash = mixed(elements.count, size);
    for (std::uint64_t i = 0; i < elements.count; ++i) {
      for (std::size_t byte = 0; byte < size; byte += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, elements.data + i * elements.stride + byte, std::min(sizeof word, size - byte));
        hash = mixed(hash, word);
      }
    }
    known = hash;
    return hash;
  }

  bool areEqual(int a, int b) const {
    if (a == b) return true;
    if (a < 0 || b < 0) return false;
    if (at(a).type != at(b).type || at(a).componentType != at(b).componentType ||
        at(a).normalized != at(b).normalized || at(a).count != at(b).count)
      return false;
    const Elements left = asset::detail::baseElements(model_, a, kNoLimit);
    const Elements right = asset::detail::baseElements(model_, b, kNoLimit);
    const std::size_t size = elementSize(a);
    for (std::uint64_t i = 0; i < left.count; ++i)
      if (std::memcmp(left.data + i * left.stride, right.data + i * right.stride, size) != 0) return false;
    return true;
  }

  bool areEqual(const tinygltf::Primitive& a, const tinygltf::Primitive& b) const {
    if (a.mode != b.mode || a.material != b.material || a.attributes.size() != b.attributes.size() ||
        !(a.extensions == b.extensions) || !(a.extras == b.extras) || !areEqual(a.indices, b.indices))
      return false;
    for (const auto& [name, accessor] : a.attributes) {
      const auto other = b.attributes.find(name);
      if (other == b.attributes.end() || !areEqual(accessor, other->second)) return false;
    }
    return true;
  }

  const tinygltf::Model& model_;
  std::vector<std::optional<std::uint64_t>> hashes_;  ///< by accessor
};

}  // namespace

std::vector<std::size_t> findEqualMeshes(const tinygltf::Model& model, std::span<const std::size_t> meshes) {
  Comparison comparison(model);
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> places;
  std::vector<std::size_t> first(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    first[i] = i;
    const tinygltf::Mesh& mesh = model.meshes[meshes[i]];
    if (meshes.size() < 2 || !comparison.mayEqual(mesh)) continue;
    std::vector<std::size_t>& known = places[comparison.hash(mesh)];
    const auto equal = std::find_if(known.begin(), known.end(), [&](std::size_t place) {
      return comparison.areEqual(model.meshes[meshes[place]], mesh);
    });
    if (equal != known.end()) {
      first[i] = *equal;
    } else if (known.size() < kMostOfOneHash) {
      known.push_back(i);
    }
  }
  return first;
}

}  // namespace jalousie::bake
