// Everything goes to the interface library's background list: under the windows, over the picture.
#include "app/view/overlay.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace jalousie::app {
namespace {

constexpr ImU32 kFrustumLine = IM_COL32(255, 210, 90, 255);
constexpr ImU32 kFrustumFace = IM_COL32(255, 210, 90, 22);
constexpr ImU32 kBoxLine = IM_COL32(255, 255, 255, 200);
constexpr ImU32 kRectLine = IM_COL32(255, 160, 40, 255);
constexpr ImU32 kGridLine = IM_COL32(255, 160, 40, 90);
constexpr ImU32 kText = IM_COL32(235, 238, 242, 255);
constexpr ImU32 kPlate = IM_COL32(22, 24, 28, 215);

/// Clips a list to a region while it lives.
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

/// From world to the window; clips segments at the near plane.
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
  /// A convex polygon, only if all of it is in front of the eye.
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

/// Corners of a frustum: near, then far, each counter-clockwise from the lower left.
std::array<glm::vec3, 8> frustumCorners(const scene::Camera& camera, float aspect, float reachWorld) {
  std::array<glm::vec3, 8> corners;
  const float tanY = std::tan(0.5F * camera.fovY);
  const float distances[] = {camera.zNear, std::max(camera.zFar.value_or(reachWorld), 2.0F * camera.zNear)};
  constexpr glm::vec2 kSigns[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t plane = 0; plane < 2; ++plane)
    for (std::size_t i = 0; i < 4; ++i) {
      const float d = distances[plane];
      const glm::vec4 p(kSigns[i].x * tanY * aspect * d, kSigns[i].y * tanY * d, -d, 1.0F);
      corners[4 * plane + i] = glm::vec3(camera.worldFromCamera * p);
    }
  return corners;
}

float unit() {
  return ImGui::GetFontSize();
}

void plate(ImDrawList& list, const ImVec2& from, const ImVec2& to) {
  list.AddRectFilled(from, to, kPlate, 0.3F * unit());
}

/// A swatch with a text behind it; returns the x behind the text.
float swatch(ImDrawList& list, float x, float y, ImU32 color, const char* text) {
  const float side = 0.9F * unit();
  list.AddRectFilled({x, y}, {x + side, y + side}, color, 2.0F);
  list.AddText({x + 1.35F * unit(), y - 0.05F * unit()}, kText, text);
  return x + 1.35F * unit() + ImGui::CalcTextSize(text).x + unit();
}

struct Swatch {
  ImU32 color;
  const char* text;
};

void drawSwatches(const Region& region, const char* title, const std::vector<Swatch>& swatches) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Clip clip(list, region);
  float width = ImGui::CalcTextSize(title).x + 2.0F * unit();
  for (const Swatch& s : swatches)
    width += ImGui::CalcTextSize(s.text).x + 2.35F * unit();
  const float x = region.x + region.width - 0.8F * unit() - width;
  const float y = region.y + region.height - 2.6F * unit();
  plate(list, {x, y}, {x + width, y + 1.9F * unit()});
  list.AddText({x + 0.6F * unit(), y + 0.4F * unit()}, kText, title);
  float at = x + ImGui::CalcTextSize(title).x + 1.6F * unit();
  for (const Swatch& s : swatches)
    at = swatch(list, at, y + 0.5F * unit(), s.color, s.text);
}

struct Tick {
  float at;  ///< in [0, 1]
  std::string text;
};

void drawScale(const Region& region, const std::string& title, const std::vector<Tick>& ticks) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Clip clip(list, region);
  const float width = 18.0F * unit();
  const float x = region.x + region.width - 3.8F * unit() - width;
  const float y = region.y + region.height - 5.0F * unit();
  plate(list, {x, y}, {x + width + 3.0F * unit(), y + 4.3F * unit()});
  list.AddText({x + 1.5F * unit(), y + 0.3F * unit()}, kText, title.c_str());
  const float barX = x + 1.5F * unit();
  const float barY = y + 1.7F * unit();
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const float from = static_cast<float>(i) / kSteps;
    list.AddRectFilled({barX + from * width, barY},
                       {barX + (from + 1.0F / kSteps) * width + 0.5F, barY + 0.8F * unit()},
                       heatBytes(from + 0.5F / kSteps));
  }
  for (const Tick& tick : ticks) {
    const float at = barX + tick.at * width;
    list.AddLine({at, barY + 0.8F * unit()}, {at, barY + 1.1F * unit()}, kText);
    const float textWidth = ImGui::CalcTextSize(tick.text.c_str()).x;
    const float textX = std::clamp(at - 0.5F * textWidth, x + 0.3F * unit(), x + width + 2.7F * unit() - textWidth);
    list.AddText({textX, barY + 1.15F * unit()}, kText, tick.text.c_str());
  }
}

std::uint8_t srgbByte(float linear) {
  const float c = linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::clamp(c, 0.0F, 1.0F) * 255.0F + 0.5F);
}

ImU32 bytesOf(const glm::vec3& linear) {
  return IM_COL32(srgbByte(linear.x), srgbByte(linear.y), srgbByte(linear.z), 255);
}

/// Ticks at every second doubling.
std::vector<Tick> doublings(float most, const char* unitText) {
  std::vector<Tick> ticks;
  for (float value = 1.0F; value <= most; value *= 4.0F)
    ticks.push_back(
        {std::log2(value) / std::log2(most), fmt::format("{:g}{}{}", value, value >= most ? "+" : "", unitText)});
  return ticks;
}

}  // namespace

std::uint32_t heatBytes(float t) {
  // As heatColor() of shaders/lib/palette.glsl.
  const glm::vec3 low(0.06F, 0.01F, 0.14F);
  const glm::vec3 mid(0.02F, 0.27F, 0.26F);
  const glm::vec3 high(0.98F, 0.80F, 0.05F);
  return bytesOf(t < 0.5F ? glm::mix(low, mid, 2.0F * t) : glm::mix(mid, high, 2.0F * t - 1.0F));
}

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
  const Projection projection(region, draw);
  const Aabb& box = inspection.boundsWorld;
  const auto corner = [&](unsigned i) {
    return glm::vec3((i & 1U) != 0 ? box.max.x : box.min.x, (i & 2U) != 0 ? box.max.y : box.min.y,
                     (i & 4U) != 0 ? box.max.z : box.min.z);
  };
  for (unsigned i = 0; i < 8; ++i)
    for (const unsigned axis : {1U, 2U, 4U})
      if ((i & axis) == 0) projection.line(list, corner(i), corner(i | axis), kBoxLine, 1.0F);
  if (frozen || !inspection.hasRect) return;
  const auto at = [&](float x, float y) { return ImVec2(region.x + x, region.y + region.height - y); };
  if (inspection.block) {
    const visibility::AnalysedBlock& block = inspection.block->block;
    const auto texel = static_cast<float>(1U << block.level);
    const float left = static_cast<float>(block.x.first) * texel;
    const float bottom = static_cast<float>(block.y.first) * texel;
    const float width = static_cast<float>(block.x.count) * texel;
    const float height = static_cast<float>(block.y.count) * texel;
    for (std::uint32_t i = 0; i <= block.x.count; ++i)
      list.AddLine(at(left + static_cast<float>(i) * texel, bottom),
                   at(left + static_cast<float>(i) * texel, bottom + height), kGridLine);
    for (std::uint32_t j = 0; j <= block.y.count; ++j)
      list.AddLine(at(left, bottom + static_cast<float>(j) * texel),
                   at(left + width, bottom + static_cast<float>(j) * texel), kGridLine);
  }
  const gpu::ScreenBox& rect = inspection.readout.box;
  list.AddRect(at(rect.minX, rect.maxY), at(rect.maxX, rect.minY), kRectLine, 0.0F, 0, 2.0F);
}

void drawLegend(const Region& region, const RenderOptions& options) {
  const std::string& view = options.view;
  if (view == "lod" || view == "wireframe") {
    std::vector<Swatch> swatches = {{bytesOf({0.005F, 0.02F, 0.35F}), "fine"},
                                    {bytesOf({0.55F, 0.85F, 1.0F}), "coarse"}};
    if (options.mode == "hom" || options.mode == "hom-depth") {
      swatches.push_back({bytesOf({0.55F, 0.02F, 0.02F}), "occluder, fine"});
      swatches.push_back({bytesOf({1.0F, 0.45F, 0.40F}), "coarse"});
    }
    drawSwatches(region, view == "lod" ? "level" : "triangles by level", swatches);
  }
  if (view == "lv")
    drawScale(region, fmt::format("level of visibility ({})", options.lv),
              {{0.0F, "-1 open"}, {0.5F, "0"}, {1.0F, "1 hidden"}});
  if (view == "coverage")
    drawScale(region, "covered share of its rectangle", {{0.0F, "0 %"}, {0.5F, "50 %"}, {1.0F, "100 %"}});
  if (view == "holes") drawScale(region, "mean hole in front of it", doublings(gpu::kHoleScalePixels, " px"));
  if (view == "overdraw")
    drawScale(region, "drawn surfaces per pixel; black: none", doublings(gpu::kOverdrawScale, ""));
  if (view == "phase")
    drawSwatches(region, "drawn",
                 {{bytesOf({0.32F, 0.36F, 0.40F}), "before the test"},
                  {bytesOf({0.95F, 0.38F, 0.02F}), "after it"},
                  {bytesOf({0.75F, 0.03F, 0.03F}), "before it, in vain"}});
  if (view == "ghosts")
    drawSwatches(region, "not drawn",
                 {{bytesOf({0.90F, 0.05F, 0.45F}), "hidden"},
                  {bytesOf({0.90F, 0.70F, 0.05F}), "too small"},
                  {bytesOf({0.25F, 0.40F, 0.65F}), "outside"}});
  if (view == "occlusion")
    drawSwatches(region, options.mode == "hiz" ? "farthest depth of a texel" : "covered by occluders",
                 {{IM_COL32_WHITE, options.mode == "hiz" ? "near" : "covered"},
                  {IM_COL32(0, 0, 0, 255), options.mode == "hiz" ? "nothing" : "open"}});
}

void drawFileName(const Region& region, const std::string& name, bool isCurrent) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Clip clip(list, region);
  if (region.x > 0.0F) list.AddLine({region.x + 0.5F, 0.0F}, {region.x + 0.5F, region.height}, kPlate, 0.15F * unit());
  const ImVec2 size = ImGui::CalcTextSize(name.c_str());
  const float x = region.x + region.width - size.x - 1.4F * unit();
  plate(list, {x - 0.6F * unit(), 0.6F * unit()}, {x + size.x + 0.6F * unit(), 2.1F * unit()});
  list.AddText({x, 0.85F * unit()}, isCurrent ? kRectLine : kText, name.c_str());
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
  plate(list, {x, y}, {x + width, y + height});
  list.AddText({x + unit(), y + 0.7F * unit()}, kRectLine, title.c_str());
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x + unit(), y + 2.2F * unit()}, kText, text.c_str(), nullptr,
               wrap);
}

}  // namespace jalousie::app
