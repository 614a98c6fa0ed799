// The window of the frame graph: three stacked plots and the times of the passes.
#include "app/view/frame_graph.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "app/view/actions.h"
#include "app/view/drawing.h"
#include "shared/palette.h"

namespace jalousie::app {
namespace {

constexpr ImU32 kDrawn = IM_COL32(90, 170, 255, 255);
/// A colour of --view ghosts.
ImU32 ghost(const gpu::vec4& linear) {
  return srgb(glm::vec3(linear));
}

std::string triangleText(std::uint64_t count) {
  return count >= 10'000'000 ? fmt::format("{:.1f} M", static_cast<double>(count) / 1e6)
         : count >= 10'000   ? fmt::format("{:.1f} k", static_cast<double>(count) / 1e3)
                             : fmt::format("{}", count);
}

/// One layer of a stacked plot: its colour, and its height for each frame.
struct Layer {
  ImU32 color;
  std::function<double(const FrameSample&)> value;
};

constexpr std::size_t kMostColumns = 240;

/// Heights of the layers in each column, oldest first. A column has the mean of the samples that it stands for.
std::vector<std::vector<double>> columnsOf(const FrameHistory& history, const std::vector<Layer>& layers) {
  const auto& samples = history.samples();
  const std::size_t count = std::min(samples.size(), kMostColumns);
  std::vector<std::vector<double>> columns(count, std::vector<double>(layers.size(), 0.0));
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t from = samples.size() * c / count;
    const std::size_t to = samples.size() * (c + 1) / count;
    for (std::size_t i = from; i < to; ++i)
      for (std::size_t k = 0; k < layers.size(); ++k)
        columns[c][k] += layers[k].value(samples[i]) / static_cast<double>(to - from);
  }
  return columns;
}

/// Stacks layers over the frames of the history, the newest frame at the right, below a line of text.
void drawPlot(const FrameHistory& history, const std::string& text, const std::vector<Layer>& layers, float height) {
  ImGui::TextUnformatted(text.c_str());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0F);
  list.AddRectFilled(origin, {origin.x + width, origin.y + height}, IM_COL32(255, 255, 255, 14));
  const std::vector<std::vector<double>> columns = columnsOf(history, layers);
  double largest = 1e-9;
  for (const std::vector<double>& column : columns)
    largest = std::max(largest, std::accumulate(column.begin(), column.end(), 0.0));
  const float step = width / static_cast<float>(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const float x = origin.x + step * static_cast<float>(c);
    float bottom = origin.y + height;
    for (std::size_t k = 0; k < layers.size(); ++k) {
      const float top = bottom - height * static_cast<float>(columns[c][k] / largest);
      list.AddRectFilled({x, top}, {x + step, bottom}, layers[k].color);
      bottom = top;
    }
  }
  ImGui::Dummy({width, height});
}

/// Neighbouring colours differ in lightness, so that colour-blind users can tell them apart.
ImU32 passColor(std::size_t pass) {
  static constexpr std::array kColors = {IM_COL32(68, 119, 170, 255), IM_COL32(238, 221, 136, 255),
                                         IM_COL32(170, 51, 119, 255), IM_COL32(102, 204, 238, 255),
                                         IM_COL32(153, 85, 30, 255),  IM_COL32(187, 204, 51, 255),
                                         IM_COL32(102, 37, 104, 255), IM_COL32(238, 136, 102, 255),
                                         IM_COL32(34, 136, 51, 255),  IM_COL32(221, 221, 221, 255)};
  return kColors[pass % kColors.size()];
}

void drawPasses(const FrameHistory& history, const std::vector<std::string>& names) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = names.size(); i-- > 0;) {  // the topmost layer first, as in the plot
    const ImVec2 at = ImGui::GetCursorScreenPos();
    list.AddRectFilled({at.x, at.y + 0.15F * unit()}, {at.x + 0.8F * unit(), at.y + 0.95F * unit()}, passColor(i));
    ImGui::Dummy({0.8F * unit(), unit()});
    ImGui::SameLine();
    ImGui::Text("%7.2f ms  %s", passMs(history.samples().back(), names[i]).value_or(0.0), names[i].c_str());
  }
}

void plotPasses(const FrameHistory& history, const std::vector<std::string>& names) {
  std::vector<Layer> layers;
  for (std::size_t i = 0; i < names.size(); ++i)
    layers.push_back(
        {passColor(i), [&name = names[i]](const FrameSample& f) { return passMs(f, name).value_or(0.0); }});
  drawPlot(history, fmt::format("frame: {:.2f} ms", history.samples().back().frameMs), layers, 5.5F * unit());
}

void plotTriangles(const FrameHistory& history) {
  const render::FrameStatistics& s = history.samples().back().statistics;
  drawPlot(history, fmt::format("triangles: {} of {}", triangleText(s.triangles), triangleText(s.trianglesFinest)),
           {{kDrawn, [](const FrameSample& f) { return static_cast<double>(f.statistics.triangles); }}}, 3.0F * unit());
}

void plotObjects(const FrameHistory& history) {
  using Count = std::uint64_t render::FrameStatistics::*;
  const auto layer = [](ImU32 color, Count count) {
    return Layer{color, [count](const FrameSample& f) { return static_cast<double>(f.statistics.*count); }};
  };
  const render::FrameStatistics& s = history.samples().back().statistics;
  drawPlot(history,
           fmt::format("objects: {} drawn, {} occluded, {} too small, {} outside", s.drawn, s.culledOcclusion,
                       s.culledSmall, s.culledFrustum),
           {layer(kDrawn, &render::FrameStatistics::drawn),
            layer(ghost(gpu::kColorGhostOccluded), &render::FrameStatistics::culledOcclusion),
            layer(ghost(gpu::kColorGhostSmall), &render::FrameStatistics::culledSmall),
            layer(ghost(gpu::kColorGhostOutside), &render::FrameStatistics::culledFrustum)},
           3.0F * unit());
}

}  // namespace

bool drawFrameGraph(const FrameHistory& history) {
  bool saves = false;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({24.4F * unit(), display.y - 0.6F * unit()}, ImGuiCond_FirstUseEver, {0.0F, 1.0F});
  ImGui::SetNextWindowSize({24.0F * unit(), std::min(34.0F * unit(), display.y - 1.2F * unit())},
                           ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Frames") && !history.samples().empty()) {
    const std::vector<std::string> names = history.passNames();
    ImGui::TextDisabled("%zu frames in the last %.1f s", history.samples().size(),
                        history.samples().back().seconds - history.samples().front().seconds);
    ImGui::SameLine();
    saves = ImGui::SmallButton("CSV");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", helpText(Action::kSaveFrames).c_str());
    plotPasses(history, names);
    plotTriangles(history);
    plotObjects(history);
    drawPasses(history, names);
  }
  ImGui::End();
  return saves;
}

}  // namespace jalousie::app
