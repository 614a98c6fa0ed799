// Units, colours and clipping that overlays and windows share.
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>

#include "app/view/region.h"

namespace jalousie::app {

inline constexpr ImU32 kTextColor = IM_COL32(235, 238, 242, 255);
inline constexpr ImU32 kPlateColor = IM_COL32(22, 24, 28, 215);
/// The selection: its AABR, the outline of its block, and the name of the current document.
inline constexpr ImU32 kAccentColor = IM_COL32(255, 160, 40, 255);

/// A colour of shaders/shared/palette.h as the interface draws it: encoded as sRGB, 8 bits a component.
ImU32 srgb(const glm::vec3& linear);

/// Height of the font in pixels; sizes of the interface are multiples of it.
inline float unit() {
  return ImGui::GetFontSize();
}

/// A dark plate below text.
inline void drawPlate(ImDrawList& list, const ImVec2& from, const ImVec2& to) {
  list.AddRectFilled(from, to, kPlateColor, 0.3F * unit());
}

/// Clips a draw list to a region for its own lifetime.
class Clip {
 public:
  Clip(ImDrawList& list, const Region& region) : list_(list) {
    list_.PushClipRect({region.x, region.y}, {region.x + region.width, region.y + region.height});
  }
  ~Clip() { list_.PopClipRect(); }
  Clip(const Clip&) = delete;
  Clip& operator=(const Clip&) = delete;

 private:
  ImDrawList& list_;
};

}  // namespace jalousie::app
