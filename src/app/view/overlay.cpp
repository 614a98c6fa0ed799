// Overlays over pictures, in the draw list behind the windows; notices are in front of the windows.
#include "app/view/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/view/drawing.h"

namespace jalousie::app {
namespace {

constexpr ImU32 kFrustumLine = IM_COL32(255, 210, 90, 255);
constexpr ImU32 kFrustumFace = IM_COL32(255, 210, 90, 22);
constexpr ImU32 kBoxLine = IM_COL32(255, 255, 255, 200);
constexpr ImU32 kGridLine = IM_COL32(255, 160, 40, 90);
constexpr ImU32 kDividerColor = IM_COL32(255, 255, 255, 220);

/// Projects points from the world to the window and clips segments at the plane of the eye.
class Projection {
 public:
  Projection(const Region& region, const scene::Camera& camera)
      : region_(region), clipFromWorld_(scene::clipFromWorld(camera, region.width / region.height)) {}

  void line(ImDrawList& list, const glm::vec3& from, const glm::vec3& to, ImU32 color, float thickness) const {
    glm::vec4 a = clipFromWorld_ * glm::vec4(from, 1.0F);
    glm::vec4 b = clipFromWorld_ * glm::vec4(to, 1.0F);
    constexpr float kLeastW = 1e-5F;
    if (a.w < kLeastW && b.w < kLeastW) return;
    if (a.w < kLeastW) a = glm::mix(a, b, (kLeastW - a.w) / (b.w - a.w));
    if (b.w < kLeastW) b = glm::mix(b, a, (kLeastW - b.w) / (a.w - b.w));
    list.AddLine(window(a), window(b), color, thickness);
  }
  /// A convex polygon; it is left out unless all of it is in front of the eye.
  void face(ImDrawList& list, const std::array<glm::vec3, 4>& corners, ImU32 color) const {
    std::array<ImVec2, 4> points;
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::vec4 clip = clipFromWorld_ * glm::vec4(corners[i], 1.0F);
      if (clip.w < 1e-4F) return;
      points[i] = window(clip);
    }
    list.AddConvexPolyFilled(points.data(), 4, color);
  }

 private:
  ImVec2 window(const glm::vec4& clip) const {
    const glm::vec2 ndc = glm::clamp(glm::vec2(clip) / clip.w, glm::vec2(-50.0F), glm::vec2(50.0F));
    return {region_.x + (0.5F + 0.5F * ndc.x) * region_.width, region_.y + (0.5F - 0.5F * ndc.y) * region_.height};
  }
  Region region_;
  glm::mat4 clipFromWorld_;
};

/// Corners of a frustum in world space: those of the near plane, then those of the far plane, each counter-clockwise
/// from the lower left.
/// @param reachWorld  distance of the far plane if the camera has none
std::array<glm::vec3, 8> frustumCorners(const scene::Camera& camera, float aspect, float reachWorld) {
  std::array<glm::vec3, 8> corners;
  const float tanY = std::tan(0.5F * camera.fovY);
  const float distances[] = {camera.zNear, std::max(camera.zFar.value_or(reachWorld), 2.0F * camera.zNear)};
  constexpr glm::vec2 kSigns[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t plane = 0; plane < 2; ++plane) {
    const float d = distances[plane];
    const float half = camera.isOrthographic() ? scene::halfHeight(camera, aspect) : tanY * d;
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::vec4 p(kSigns[i].x * half * aspect, kSigns[i].y * half, -d, 1.0F);
      corners[4 * plane + i] = glm::vec3(camera.worldFromCamera * p);
    }
  }
  return corners;
}

/// The twelve edges of a box.
void drawBox(ImDrawList& list, const Projection& projection, const Aabb& box) {
  const auto corner = [&](unsigned i) {
    return glm::vec3((i & 1U) != 0 ? box.max.x : box.min.x, (i & 2U) != 0 ? box.max.y : box.min.y,
                     (i & 4U) != 0 ? box.max.z : box.min.z);
  };
  for (unsigned i = 0; i < 8; ++i)
    for (const unsigned axis : {1U, 2U, 4U})
      if ((i & axis) == 0) projection.line(list, corner(i), corner(i | axis), kBoxLine, 1.0F);
}

/// From pixels with the origin at the lower left, as kernels count them, to the window.
ImVec2 fromLowerLeft(const Region& region, float x, float y) {
  return {region.x + x, region.y + region.height - y};
}

/// The texels of a block as a grid.
void drawTexels(ImDrawList& list, const Region& region, const visibility::AnalysedBlock& block) {
  const auto texel = static_cast<float>(1U << block.level);
  const auto x = [&](std::uint32_t column) { return static_cast<float>(block.x.first + column) * texel; };
  const auto y = [&](std::uint32_t row) { return static_cast<float>(block.y.first + row) * texel; };
  for (std::uint32_t i = 0; i <= block.x.count; ++i)
    list.AddLine(fromLowerLeft(region, x(i), y(0)), fromLowerLeft(region, x(i), y(block.y.count)), kGridLine);
  for (std::uint32_t j = 0; j <= block.y.count; ++j)
    list.AddLine(fromLowerLeft(region, x(0), y(j)), fromLowerLeft(region, x(block.x.count), y(j)), kGridLine);
}

}  // namespace

void drawFrustum(const Region& region, const scene::Camera& cull, const scene::Camera& draw, float reachWorld) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Clip clip(list, region);
  const Projection projection(region, draw);
  const std::array<glm::vec3, 8> c = frustumCorners(cull, region.width / region.height, reachWorld);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    projection.face(list, {c[i], c[next], c[4 + next], c[4 + i]}, kFrustumFace);
    projection.line(list, c[i], c[next], kFrustumLine, 1.5F);
    projection.line(list, c[4 + i], c[4 + next], kFrustumLine, 1.5F);
    projection.line(list, c[i], c[4 + i], kFrustumLine, 1.5F);
  }
}

void drawSelection(const Region& region, const Inspection& inspection, const scene::Camera& draw, bool frozen) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Clip clip(list, region);
  drawBox(list, Projection(region, draw), inspection.boundsWorld);
  if (frozen || !inspection.hasRect) return;
  if (inspection.block) drawTexels(list, region, inspection.block->block);
  const gpu::ScreenBox& rect = inspection.readout.box;
  list.AddRect(fromLowerLeft(region, rect.minX, rect.maxY), fromLowerLeft(region, rect.maxX, rect.minY), kAccentColor,
               0.0F, 0, 2.0F);
}

void drawDivider(const Region& right, float scale) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float middle = 0.5F * right.height;
  list.AddLine({right.x, 0.0F}, {right.x, right.height}, kDividerColor, 2.0F * scale);
  list.AddCircleFilled({right.x, middle}, 7.0F * scale, kDividerColor);
  list.AddText({right.x - 1.4F * unit(), middle - 2.0F * unit()}, IM_COL32_WHITE, "A");
  list.AddText({right.x + 0.8F * unit(), middle - 2.0F * unit()}, IM_COL32_WHITE, "B");
}

void drawFileName(const Region& region, const std::string& name, bool isCurrent) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Clip clip(list, region);
  if (region.x > 0.0F)
    list.AddLine({region.x + 0.5F, 0.0F}, {region.x + 0.5F, region.height}, kPlateColor, 0.15F * unit());
  const ImVec2 size = ImGui::CalcTextSize(name.c_str());
  const float x = region.x + region.width - size.x - 1.4F * unit();
  drawPlate(list, {x - 0.6F * unit(), 0.6F * unit()}, {x + size.x + 0.6F * unit(), 2.1F * unit()});
  list.AddText({x, 0.85F * unit()}, isCurrent ? kAccentColor : kTextColor, name.c_str());
}

void drawNotice(const Region& region, const std::string& title, const std::string& text) {
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const Clip clip(list, region);
  const float wrap = std::max(std::min(0.7F * region.width, 50.0F * unit()), 6.0F * unit());
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  const ImVec2 titleSize = ImGui::CalcTextSize(title.c_str());
  const float width = std::max(size.x, titleSize.x) + 2.0F * unit();
  const float height = size.y + 3.2F * unit();
  const float x = region.x + 0.5F * (region.width - width);
  const float y = region.y + 0.4F * (region.height - height);
  drawPlate(list, {x, y}, {x + width, y + height});
  list.AddText({x + unit(), y + 0.7F * unit()}, kAccentColor, title.c_str());
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x + unit(), y + 2.2F * unit()}, kTextColor, text.c_str(),
               nullptr, wrap);
}

void drawMessage(const Region& region, const std::string& message) {
  ImGui::SetNextWindowPos({region.x + 0.5F * region.width, region.y + region.height - unit()}, ImGuiCond_Always,
                          {0.5F, 1.0F});
  ImGui::Begin("message", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoSavedSettings);
  ImGui::TextUnformatted(message.c_str());
  ImGui::End();
}

}  // namespace jalousie::app
