// A three-way merge. Recursion is bounded by the nesting of a document that has been read.
#include "asset/gltf_merge.h"

#include <algorithm>

namespace jalousie::asset::detail {
namespace {

using nlohmann::json;

bool holdsObjects(const json& list) {
  return std::all_of(list.begin(), list.end(), [](const json& element) { return element.is_object(); });
}

void changeObject(json& original, const json& before, const json& after) {
  for (const auto& [key, member] : before.items())
    if (!after.contains(key)) original.erase(key);
  for (const auto& [key, member] : after.items()) {
    const auto old = before.find(key);
    if (old == before.end() || !original.contains(key)) {
      if (old == before.end() || *old != member) original[key] = member;
    } else if (key == "primitives" && old->size() != member.size()) {
      original[key] = member;
    } else {
      applyChanges(original[key], *old, member);
    }
  }
}

}  // namespace

void applyChanges(json& original, const json& before, const json& after) {
  if (before == after) return;
  if (original.is_object() && before.is_object() && after.is_object()) return changeObject(original, before, after);
  const bool isList = original.is_array() && before.is_array() && after.is_array() &&
                      original.size() == before.size() && after.size() >= before.size() && holdsObjects(original) &&
                      holdsObjects(before) && holdsObjects(after);
  if (!isList) {
    original = after;
    return;
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    applyChanges(original[i], before[i], after[i]);
  original.insert(original.end(), after.begin() + static_cast<std::ptrdiff_t>(before.size()), after.end());
}

}  // namespace jalousie::asset::detail
