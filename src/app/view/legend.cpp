// Legends: swatches for classes, a heat scale for quantities.
#include "app/view/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/view/drawing.h"
#include "shared/limits.h"
#include "shared/palette.h"

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

/// The heat scale of the views: heatColor() of shaders/lib/palette.glsl. @param t  in [0, 1]
ImU32 heatColor(float t) {
  const glm::vec3 low(gpu::kColorHeatLow);
  const glm::vec3 mid(gpu::kColorHeatMiddle);
  const glm::vec3 high(gpu::kColorHeatHigh);
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

/// A class of the view, by its colour in shaders/shared/palette.h.
Swatch swatch(const gpu::vec4& color, const char* name) {
  return {srgb(glm::vec3(color)), name};
}

void drawLevelLegend(const Region& region, const char* title, bool hasOccluders) {
  std::vector<Swatch> swatches = {swatch(gpu::kColorFinestLod, "finest"), swatch(gpu::kColorCoarsestLod, "coarsest")};
  if (hasOccluders) {
    swatches.push_back(swatch(gpu::kColorFinestOccluder, "occluders: finest"));
    swatches.push_back(swatch(gpu::kColorCoarsestOccluder, "coarsest"));
  }
  drawSwatches(region, title, swatches);
}

/// The colour of a level: levelColor() of shaders/lib/palette.glsl.
ImU32 levelColor(std::uint32_t level) {
  static constexpr std::array kColors = {&gpu::kColorLevel0, &gpu::kColorLevel1,  &gpu::kColorLevel2,
                                         &gpu::kColorLevel3, &gpu::kColorLevel4,  &gpu::kColorLevel5,
                                         &gpu::kColorLevel6, &gpu::kColorLevel7,  &gpu::kColorLevel8,
                                         &gpu::kColorLevel9, &gpu::kColorLevel10, &gpu::kColorLevel11};
  static_assert(kColors.size() == gpu::kLevelColors);
  return srgb(glm::vec3(*kColors[level % kColors.size()]));
}

/// One swatch per colour; a colour that stands for several levels names them all.
void drawLevels(const Region& region, std::uint32_t levelCount) {
  std::vector<std::string> texts(std::min(levelCount, gpu::kLevelColors));
  for (std::uint32_t level = 0; level < levelCount; ++level)
    texts[level % texts.size()] += fmt::format("{}{}", texts[level % texts.size()].empty() ? "" : ", ", level);
  std::vector<Swatch> swatches;
  for (std::uint32_t i = 0; i < texts.size(); ++i)
    swatches.push_back({levelColor(i), texts[i].c_str()});
  drawSwatches(region, "level, 0: finest", swatches);
}

/// Ticks at every fourth power of two of the scale of the density view.
std::vector<Tick> densityTicks() {
  const float range = std::log2(gpu::kMostDensity / gpu::kLeastDensity);
  std::vector<Tick> ticks;
  for (float density = gpu::kLeastDensity; density <= gpu::kMostDensity; density *= 4.0F)
    ticks.push_back({std::log2(density / gpu::kLeastDensity) / range,
                     density < 1.0F ? fmt::format("1/{:g}", 1.0F / density)
                                    : fmt::format("{:g}{}", density, density >= gpu::kMostDensity ? "+" : "")});
  return ticks;
}

void drawPhaseLegend(const Region& region) {
  drawSwatches(region, "drawn in",
               {swatch(gpu::kColorPhase1, "phase 1"), swatch(gpu::kColorPhase2, "phase 2"),
                swatch(gpu::kColorStale, "phase 1 although occluded")});
}

void drawGhostLegend(const Region& region) {
  drawSwatches(region, "culled as",
               {swatch(gpu::kColorGhostOccluded, "occluded"), swatch(gpu::kColorGhostSmall, "too small"),
                swatch(gpu::kColorGhostOutside, "outside the frustum")});
}

void drawCoverLegend(const Region& region, bool showsMap) {
  drawSwatches(
      region, showsMap ? "covered by occluders" : "farthest depth per texel",
      {{IM_COL32_WHITE, showsMap ? "covered" : "near"}, {IM_COL32(0, 0, 0, 255), showsMap ? "open" : "nothing drawn"}});
}

}  // namespace

void drawLegend(const Region& region, const RenderOptions& options, std::uint32_t levelCount) {
  const FramePolicy& policy = options.frameOptions;
  const bool usesMap = rowOf(policy.cullMode).usesMap;
  switch (policy.view) {
    case View::kShaded:
      return;
    case View::kLod:
      return drawLevelLegend(region, "level", usesMap);
    case View::kLevels:
      return drawLevels(region, levelCount);
    case View::kDensity:
      return drawScale(region, "triangles per pixel; black: none", densityTicks());
    case View::kWireframe:
      return drawLevelLegend(region, "triangles by level", usesMap);
    case View::kLv:
      return drawScale(region, fmt::format("level of visibility ({})", rowOf(policy.lvMeasure).name),
                       {{0.0F, "-1 visible"}, {0.5F, "0"}, {1.0F, "1 occluded"}});
    case View::kCoverage:
      return drawScale(region, "occluded share of the AABR", {{0.0F, "0 %"}, {0.5F, "50 %"}, {1.0F, "100 %"}});
    case View::kHoles:
      return drawScale(region, "mean size of the openings in the AABR", powersOfFour(gpu::kHoleScalePixels, " px"));
    case View::kOverdraw:
      return drawScale(region, "surfaces drawn per pixel; black: none", powersOfFour(gpu::kOverdrawScale, ""));
    case View::kPhase:
      return drawPhaseLegend(region);
    case View::kGhosts:
      return drawGhostLegend(region);
    case View::kOcclusion:
      return drawCoverLegend(region, usesMap);
  }
}

}  // namespace jalousie::app
