// Looks names up; shortens them for people.
#include "scene/scene_names.h"

#include <algorithm>

namespace jalousie::scene {
namespace {

/// The longest start of a text that fits and does not end within a character of UTF-8.
std::string_view startOf(std::string_view text, std::size_t most) {
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
    --end;
  return text.substr(0, end);
}

}  // namespace

std::string_view SceneNames::nodeName(std::uint32_t instance) const {
  if (instance >= nodeOf.size() || nodeOf[instance] >= nodes.size()) return {};
  return nodes[nodeOf[instance]];
}

std::string_view SceneNames::meshName(std::uint32_t chain) const {
  return chain < meshes.size() ? std::string_view(meshes[chain]) : std::string_view();
}

std::string shownName(const SceneNames& names, std::uint32_t instance, std::uint32_t chain) {
  std::string_view name = names.nodeName(instance);
  if (name.empty()) name = names.meshName(chain);
  if (name.empty()) return "object " + std::to_string(instance);
  constexpr std::string_view kEllipsis = "...";
  std::string text(name.size() <= kLongestShownName ? name : startOf(name, kLongestShownName - kEllipsis.size()));
  if (text.size() < name.size()) text += kEllipsis;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }, ' ');
  return text;
}

}  // namespace jalousie::scene
