// Legends: swatches for classes, a heat scale for quantities.
#include "app/view/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/view/drawing.h"

namespace jalousie::app {
namespace {

struct Swatch {
  ImU32 color;
  const char* text;
};

/// Mark on a scale. @param at  in [0, 1]
struct Tick {
  float at;
  std::string text;
};

/// Left end of a swatch's text, from the left end of the swatch.
float textOffset() {
  return 1.35F * unit();
}

/// Draws a swatch with its text to the right. @return x of the next swatch
float drawSwatch(ImDrawList& list, const ImVec2& at, const Swatch& swatch) {
  const float side = 0.9F * unit();
  list.AddRectFilled(at, {at.x + side, at.y + side}, swatch.color, 2.0F);
  list.AddText({at.x + textOffset(), at.y - 0.05F * unit()}, kTextColor, swatch.text);
  return at.x + textOffset() + ImGui::CalcTextSize(swatch.text).x + unit();
}

void drawSwatches(const Region& region, const char* title, const std::vector<Swatch>& swatches) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Clip clip(list, region);
  float width = ImGui::CalcTextSize(title).x + 2.0F * unit();
  for (const Swatch& swatch : swatches)
    width += textOffset() + ImGui::CalcTextSize(swatch.text).x + unit();
  const float x = region.x + region.width - 0.8F * unit() - width;
  const float y = region.y + region.height - 2.6F * unit();
  drawPlate(list, {x, y}, {x + width, y + 1.9F * unit()});
  list.AddText({x + 0.6F * unit(), y + 0.4F * unit()}, kTextColor, title);
  float at = x + ImGui::CalcTextSize(title).x + 1.6F * unit();
  for (const Swatch& swatch : swatches)
    at = drawSwatch(list, {at, y + 0.5F * unit()}, swatch);
}

std::uint8_t srgbByte(float linear) {
  const float c = linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::clamp(c, 0.0F, 1.0F) * 255.0F + 0.5F);
}

ImU32 srgb(const glm::vec3& linear) {
  return IM_COL32(srgbByte(linear.x), srgbByte(linear.y), srgbByte(linear.z), 255);
}

/// The heat scale of the views: heatColor() of shaders/lib/palette.glsl. @param t  in [0, 1]
ImU32 heatColor(float t) {
  const glm::vec3 low(0.06F, 0.01F, 0.14F);
  const glm::vec3 mid(0.02F, 0.27F, 0.26F);
  const glm::vec3 high(0.98F, 0.80F, 0.05F);
  return srgb(t < 0.5F ? glm::mix(low, mid, 2.0F * t) : glm::mix(mid, high, 2.0F * t - 1.0F));
}

void drawHeatBar(ImDrawList& list, const ImVec2& from, const ImVec2& size) {
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const float t = static_cast<float>(i) / kSteps;
    list.AddRectFilled({from.x + t * size.x, from.y}, {from.x + (t + 1.0F / kSteps) * size.x + 0.5F, from.y + size.y},
                       heatColor(t + 0.5F / kSteps));
  }
}

void drawScale(const Region& region, const std::string& title, const std::vector<Tick>& ticks) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Clip clip(list, region);
  const float width = 18.0F * unit();
  const float x = region.x + region.width - 3.8F * unit() - width;
  const float y = region.y + region.height - 5.0F * unit();
  drawPlate(list, {x, y}, {x + width + 3.0F * unit(), y + 4.3F * unit()});
  list.AddText({x + 1.5F * unit(), y + 0.3F * unit()}, kTextColor, title.c_str());
  const float barX = x + 1.5F * unit();
  const float barY = y + 1.7F * unit();
  drawHeatBar(list, {barX, barY}, {width, 0.8F * unit()});
  for (const Tick& tick : ticks) {
    const float at = barX + tick.at * width;
    list.AddLine({at, barY + 0.8F * unit()}, {at, barY + 1.1F * unit()}, kTextColor);
    const float textWidth = ImGui::CalcTextSize(tick.text.c_str()).x;
    const float textX = std::clamp(at - 0.5F * textWidth, x + 0.3F * unit(), x + width + 2.7F * unit() - textWidth);
    list.AddText({textX, barY + 1.15F * unit()}, kTextColor, tick.text.c_str());
  }
}

/// Ticks at 1, 4, 16, ... on a logarithmic scale from 1 to `most`.
std::vector<Tick> powersOfFour(float most, const char* unitText) {
  std::vector<Tick> ticks;
  for (float value = 1.0F; value <= most; value *= 4.0F)
    ticks.push_back(
        {std::log2(value) / std::log2(most), fmt::format("{:g}{}{}", value, value >= most ? "+" : "", unitText)});
  return ticks;
}

void drawLevelLegend(const Region& region, const char* title, bool hasOccluders) {
  std::vector<Swatch> swatches = {{srgb({0.005F, 0.02F, 0.35F}), "finest"}, {srgb({0.55F, 0.85F, 1.0F}), "coarsest"}};
  if (hasOccluders) {
    swatches.push_back({srgb({0.55F, 0.02F, 0.02F}), "occluders: finest"});
    swatches.push_back({srgb({1.0F, 0.45F, 0.40F}), "coarsest"});
  }
  drawSwatches(region, title, swatches);
}

}  // namespace

void drawLegend(const Region& region, const RenderOptions& options) {
  const std::string& view = options.view;
  const bool hasOccluders = options.mode == "hom" || options.mode == "hom-depth";
  const bool showsDepth = options.mode == "hiz";
  if (view == "lod") drawLevelLegend(region, "level", hasOccluders);
  if (view == "wireframe") drawLevelLegend(region, "triangles by level", hasOccluders);
  if (view == "lv")
    drawScale(region, fmt::format("level of visibility ({})", options.lv),
              {{0.0F, "-1 visible"}, {0.5F, "0"}, {1.0F, "1 occluded"}});
  if (view == "coverage")
    drawScale(region, "occluded share of the AABR", {{0.0F, "0 %"}, {0.5F, "50 %"}, {1.0F, "100 %"}});
  if (view == "holes")
    drawScale(region, "mean size of the openings in the AABR", powersOfFour(gpu::kHoleScalePixels, " px"));
  if (view == "overdraw")
    drawScale(region, "surfaces drawn per pixel; black: none", powersOfFour(gpu::kOverdrawScale, ""));
  if (view == "phase")
    drawSwatches(region, "drawn in",
                 {{srgb({0.32F, 0.36F, 0.40F}), "phase 1"},
                  {srgb({0.95F, 0.38F, 0.02F}), "phase 2"},
                  {srgb({0.75F, 0.03F, 0.03F}), "phase 1 although occluded"}});
  if (view == "ghosts")
    drawSwatches(region, "culled as",
                 {{srgb({0.90F, 0.05F, 0.45F}), "occluded"},
                  {srgb({0.90F, 0.70F, 0.05F}), "too small"},
                  {srgb({0.25F, 0.40F, 0.65F}), "outside the frustum"}});
  if (view == "occlusion")
    drawSwatches(region, showsDepth ? "farthest depth per texel" : "covered by occluders",
                 {{IM_COL32_WHITE, showsDepth ? "near" : "covered"},
                  {IM_COL32(0, 0, 0, 255), showsDepth ? "nothing drawn" : "open"}});
}

}  // namespace jalousie::app
