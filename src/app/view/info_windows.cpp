// Windows that only show: inspection, frame graph, help.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/view/overlay.h"
#include "app/view/panel.h"
#include "visibility/lod_policy.h"

namespace jalousie::app {
namespace {

constexpr ImU32 kLine = IM_COL32(255, 255, 255, 40);
constexpr ImU32 kPositive = IM_COL32(90, 170, 255, 255);
constexpr ImU32 kNegative = IM_COL32(255, 120, 90, 255);

float unit() {
  return ImGui::GetFontSize();
}

void row(const char* name, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", name);
  ImGui::TableNextColumn();
  ImGui::TextWrapped("%s", value.c_str());
}

std::string triangleText(std::uint64_t count) {
  return count >= 10'000'000 ? fmt::format("{:.1f} M", static_cast<double>(count) / 1e6)
         : count >= 10'000   ? fmt::format("{:.1f} k", static_cast<double>(count) / 1e3)
                             : fmt::format("{}", count);
}

/// The texels as squares: white = covered, black = open, as in the view of the map. Row 0 is at the bottom.
void drawBlock(const visibility::AnalysedBlock& block, float side) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float texel = std::floor(side / static_cast<float>(std::max(block.x.count, block.y.count)));
  const float width = texel * static_cast<float>(block.x.count);
  const float height = texel * static_cast<float>(block.y.count);
  for (std::uint32_t j = 0; j < block.y.count; ++j)
    for (std::uint32_t i = 0; i < block.x.count; ++i) {
      const auto grey = static_cast<int>(255.0F * block.opacity[j * block.x.count + i] + 0.5F);
      const float x = origin.x + texel * static_cast<float>(i);
      const float y = origin.y + height - texel * static_cast<float>(j + 1);
      list.AddRectFilled({x, y}, {x + texel, y + texel}, IM_COL32(grey, grey, grey, 255));
      list.AddRect({x, y}, {x + texel + 1.0F, y + texel + 1.0F}, kLine);
    }
  list.AddRect(origin, {origin.x + width, origin.y + height}, IM_COL32(255, 160, 40, 255));
  ImGui::Dummy({side, height});
}

/// One bar per coefficient with u + v <= 3, up for positive; its length goes with the root of the value, or nothing
/// would be seen beside the first.
void drawSpectrum(const InspectedBlock& b, float width, float height) {
  struct Bar {
    std::uint32_t u, v;
    double value;
  };
  std::vector<Bar> bars;
  for (std::uint32_t sum = 0; sum <= 3; ++sum)
    for (std::uint32_t v = 0; v <= sum; ++v)
      if (const std::uint32_t u = sum - v; u < b.block.x.count && v < b.block.y.count)
        bars.push_back({u, v, b.spectrum[v * b.block.x.count + u]});
  double largest = 1e-6;
  for (const Bar& bar : bars)
    largest = std::max(largest, std::abs(bar.value));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float middle = origin.y + 0.5F * height;
  const float step = width / static_cast<float>(bars.size());
  list.AddLine({origin.x, middle}, {origin.x + width, middle}, kLine);
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const float x = origin.x + step * static_cast<float>(i);
    const auto share = static_cast<float>(std::sqrt(std::abs(bars[i].value) / largest));
    const float length = std::copysign(share, static_cast<float>(bars[i].value)) * (0.5F * height - 1.1F * unit());
    list.AddRectFilled({x + 0.12F * step, std::min(middle, middle - length)},
                       {x + 0.88F * step, std::max(middle, middle - length) + 1.0F},
                       bars[i].value >= 0.0 ? kPositive : kNegative);
    const std::string name = fmt::format("{}{}", bars[i].u, bars[i].v);
    list.AddText({x + 0.5F * (step - ImGui::CalcTextSize(name.c_str()).x), origin.y + height - unit()},
                 ImGui::GetColorU32(ImGuiCol_TextDisabled), name.c_str());
  }
  ImGui::InvisibleButton("spectrum", {width, height});
  if (!ImGui::IsItemHovered()) return;
  const auto index = static_cast<std::size_t>((ImGui::GetIO().MousePos.x - origin.x) / step);
  if (index < bars.size()) ImGui::SetTooltip("F(%u,%u) = %.4f", bars[index].u, bars[index].v, bars[index].value);
}

void drawBlockSection(const Inspection& i, const RenderOptions& options) {
  if (!i.block) {
    ImGui::TextWrapped(i.hasRect ? "This mode has no map or pyramid to look at: use hom, hom-depth or hiz."
                                 : "No finite rectangle on the screen: there is no block to look at.");
    return;
  }
  const InspectedBlock& b = *i.block;
  ImGui::Text("Block of %u x %u texels at level %u (LOM %u, four levels below)", b.block.x.count, b.block.y.count,
              b.block.level, b.lom);
  drawBlock(b.block, 11.0F * unit());
  ImGui::SameLine();
  ImGui::BeginGroup();
  ImGui::TextDisabled("DCT F(u,v), root scale");
  drawSpectrum(b, 15.0F * unit(), 9.5F * unit());
  ImGui::EndGroup();
  if (!ImGui::BeginTable("measures", 4, ImGuiTableFlags_SizingStretchSame)) return;
  for (const char* title : {"measure", "LV", "hidden", "budget x"}) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", title);
  }
  for (gpu::uint measure = 1; measure < gpu::kLvCount; ++measure) {
    const bool counted = measure == gpu::kLvPixels;
    const bool known = !counted || i.countedLv.has_value();
    const float lv = counted ? i.countedLv.value_or(0.0F) : b.lv[measure];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool used = options.lv == measureName(measure);
    ImGui::Text("%s%s", measureName(measure), used ? "  (in use)" : "");
    ImGui::TableNextColumn();
    known ? ImGui::Text("%.4f", static_cast<double>(lv)) : ImGui::TextDisabled("not counted");
    ImGui::TableNextColumn();
    if (known) ImGui::Text("%.1f %%", static_cast<double>(100.0F * visibility::hiddenShare(lv)));
    ImGui::TableNextColumn();
    if (known) ImGui::Text("%.2f", static_cast<double>(visibility::relaxedBudget(lv, options.frameOptions.relax)));
  }
  ImGui::EndTable();
  ImGui::TextDisabled("open %.1f %%   fineness %.3f   mean hole %s", static_cast<double>(100.0F * b.openShare),
                      static_cast<double>(b.fineness),
                      std::isinf(b.chordPixels) ? "endless" : fmt::format("{:.3g} px", b.chordPixels).c_str());
}

void drawLevels(const Inspection& i) {
  if (!ImGui::BeginTable("levels", 4, ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_RowBg)) return;
  for (const char* title : {"level", "triangles", "error, object", "error, px"}) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", title);
  }
  for (std::size_t level = 0; level < i.levels.size(); ++level) {
    ImGui::TableNextRow();
    if (level == i.chosen) ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, IM_COL32(60, 110, 180, 140));
    ImGui::TableNextColumn();
    ImGui::Text("%zu%s", level, level == i.chosen ? "  chosen" : "");
    ImGui::TableNextColumn();
    ImGui::Text("%u", i.levels[level].triangles);
    ImGui::TableNextColumn();
    ImGui::Text("%.3g", static_cast<double>(i.levels[level].errorObject));
    ImGui::TableNextColumn();
    ImGui::Text("%.3g", static_cast<double>(i.levels[level].errorPixels));
  }
  ImGui::EndTable();
}

void plot(const FrameHistory& history, const char* name, const std::function<double(const FrameSample&)>& value,
          const std::string& now) {
  std::vector<float> values;
  for (const FrameSample& sample : history.samples())
    values.push_back(static_cast<float>(value(sample)));
  const float largest = values.empty() ? 1.0F : *std::max_element(values.begin(), values.end());
  const std::string text = fmt::format("{}: {}", name, now);
  ImGui::PushStyleColor(ImGuiCol_FrameBg, IM_COL32(255, 255, 255, 14));
  ImGui::PlotLines(fmt::format("##{}", name).c_str(), values.data(), static_cast<int>(values.size()), 0, text.c_str(),
                   0.0F, 1.1F * std::max(largest, 1e-3F), {ImGui::GetContentRegionAvail().x, 3.4F * unit()});
  ImGui::PopStyleColor();
}

void drawPasses(const FrameSample& sample) {
  double longest = 1e-6;
  for (const auto& [name, ms] : sample.passes)
    longest = std::max(longest, ms);
  for (const auto& [name, ms] : sample.passes) {
    ImGui::ProgressBar(static_cast<float>(ms / longest), {9.0F * unit(), 0.95F * unit()}, "");
    ImGui::SameLine();
    ImGui::Text("%7.2f ms  %s", ms, name.c_str());
  }
}

}  // namespace

void drawInspection(const Inspection& i, const RenderOptions& options) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x - 0.6F * unit(), 0.6F * unit()}, ImGuiCond_FirstUseEver, {1.0F, 0.0F});
  ImGui::SetNextWindowSize({29.0F * unit(), std::min(53.0F * unit(), display.y - 1.2F * unit())},
                           ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Object")) {
    const gpu::ScreenBox& box = i.readout.box;
    if (ImGui::BeginTable("facts", 2)) {
      ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed);
      ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
      row("object", fmt::format("{} of the file, chain {}", i.instance, i.chain));
      row("verdict", i.verdict);
      row("AABR", i.hasRect ? fmt::format("{:.1f}, {:.1f} to {:.1f}, {:.1f} px ({:.1f} x {:.1f})", box.minX, box.minY,
                                          box.maxX, box.maxY, box.maxX - box.minX, box.maxY - box.minY)
                            : std::string("none"));
      row("LV", fmt::format("{:.4f} ({})", i.readout.state.lv, options.lv));
      if (i.countedLv) row("pixels", fmt::format("{} showed it when they were last counted", i.readout.pixels));
      row("budget", fmt::format("{:.3g} px x {:.2f} = {:.3g} px{}", i.tau, i.relaxed, i.tau * i.relaxed,
                                i.importance < 1.0F ? fmt::format(" (importance {:.2f})", i.importance) : ""));
      row("level", fmt::format("{}", i.chosen));
      row("why", i.why);
      ImGui::EndTable();
    }
    ImGui::Separator();
    drawBlockSection(i, options);
    ImGui::Separator();
    drawLevels(i);
  }
  ImGui::End();
}

void drawFrameGraph(const FrameHistory& history) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({24.4F * unit(), display.y - 0.6F * unit()}, ImGuiCond_FirstUseEver, {0.0F, 1.0F});
  ImGui::SetNextWindowSize({24.0F * unit(), std::min(28.0F * unit(), display.y - 1.2F * unit())},
                           ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Frames") && !history.samples().empty()) {
    const FrameSample& last = history.samples().back();
    const render::FrameStatistics& s = last.statistics;
    plot(
        history, "frame", [](const FrameSample& f) { return f.frameMs; }, fmt::format("{:.2f} ms", last.frameMs));
    plot(
        history, "triangles", [](const FrameSample& f) { return static_cast<double>(f.statistics.triangles); },
        fmt::format("{} of {}", triangleText(s.triangles), triangleText(s.trianglesFull)));
    plot(
        history, "drawn", [](const FrameSample& f) { return static_cast<double>(f.statistics.drawn); },
        fmt::format("{} of {} objects", s.drawn, s.objects));
    plot(
        history, "culled",
        [](const FrameSample& f) {
          return static_cast<double>(f.statistics.culledFrustum + f.statistics.culledOcclusion +
                                     f.statistics.culledSmall);
        },
        fmt::format("{} outside, {} hidden, {} small", s.culledFrustum, s.culledOcclusion, s.culledSmall));
    drawPasses(last);
  }
  ImGui::End();
}

void drawHelp(bool* open) {
  ImGui::SetNextWindowPos({0.5F * ImGui::GetIO().DisplaySize.x, 0.5F * ImGui::GetIO().DisplaySize.y},
                          ImGuiCond_Appearing, {0.5F, 0.5F});
  if (ImGui::Begin("Keys", open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings) &&
      ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    const auto line = [](const char* keys, const char* what) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(keys);
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", what);
    };
    for (const PointerHelp& help : pointerHelp())
      line(help.how, help.what);
    for (const Binding& binding : bindings())
      line(binding.keys, binding.what);
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace jalousie::app
