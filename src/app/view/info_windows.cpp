// Windows that only show: inspection, frame graph, help.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

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
  // In the order of their numbers.
  const std::vector<std::string>& names = std::get<ChoiceValue>(renderOption("--lv").value).names;
  for (gpu::uint measure = 1; measure < gpu::kLvCount; ++measure) {
    const bool counted = measure == gpu::kLvPixels;
    const bool known = !counted || i.countedLv.has_value();
    const float lv = counted ? i.countedLv.value_or(0.0F) : b.lv[measure];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool used = options.lv == names[measure];
    ImGui::Text("%s%s", names[measure].c_str(), used ? "  (in use)" : "");
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

/// Part of a stacked plot.
struct Layer {
  ImU32 color;
  std::function<double(const FrameSample&)> value;
};

constexpr std::size_t kMostColumns = 240;

/// Heights of the layers in each column, oldest first: the mean of the samples that share one.
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

/// Layers on each other over the frames that are remembered, the newest at the right, and a line of text above.
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

/// Told apart also by those who see fewer colours: they differ in lightness from one to the next.
ImU32 passColor(std::size_t pass) {
  static constexpr std::array kColors = {IM_COL32(68, 119, 170, 255), IM_COL32(238, 221, 136, 255),
                                         IM_COL32(170, 51, 119, 255), IM_COL32(102, 204, 238, 255),
                                         IM_COL32(153, 85, 30, 255),  IM_COL32(187, 204, 51, 255),
                                         IM_COL32(102, 37, 104, 255), IM_COL32(238, 136, 102, 255),
                                         IM_COL32(34, 136, 51, 255),  IM_COL32(221, 221, 221, 255)};
  return kColors[pass % kColors.size()];
}

double passMs(const FrameSample& sample, const std::string& name) {
  for (const auto& [pass, ms] : sample.passes)
    if (pass == name) return ms;
  return 0.0;
}

/// Every pass that some frame had, in frame order as far as frames agree.
std::vector<std::string> passNames(const FrameHistory& history) {
  std::vector<std::string> names;
  for (const FrameSample& sample : history.samples()) {
    auto at = names.begin();
    for (const auto& [name, ms] : sample.passes) {
      const auto known = std::find(names.begin(), names.end(), name);
      at = (known != names.end() ? known : names.insert(at, name)) + 1;
    }
  }
  return names;
}

void drawPasses(const FrameHistory& history, const std::vector<std::string>& names) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = names.size(); i-- > 0;) {  // the topmost layer first, as in the plot
    const ImVec2 at = ImGui::GetCursorScreenPos();
    list.AddRectFilled({at.x, at.y + 0.15F * unit()}, {at.x + 0.8F * unit(), at.y + 0.95F * unit()}, passColor(i));
    ImGui::Dummy({0.8F * unit(), unit()});
    ImGui::SameLine();
    ImGui::Text("%7.2f ms  %s", passMs(history.samples().back(), names[i]), names[i].c_str());
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
      row("level",
          i.cuts > 0 ? fmt::format("patches over {}, edges in {}", i.chosen, i.cuts) : fmt::format("{}", i.chosen));
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
  ImGui::SetNextWindowSize({24.0F * unit(), std::min(34.0F * unit(), display.y - 1.2F * unit())},
                           ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Frames") && !history.samples().empty()) {
    const FrameSample& last = history.samples().back();
    const render::FrameStatistics& s = last.statistics;
    const std::vector<std::string> names = passNames(history);
    std::vector<Layer> passes;
    for (std::size_t i = 0; i < names.size(); ++i)
      passes.push_back({passColor(i), [&name = names[i]](const FrameSample& f) { return passMs(f, name); }});
    ImGui::TextDisabled("%zu frames in the last %.1f s", history.samples().size(),
                        last.seconds - history.samples().front().seconds);
    drawPlot(history, fmt::format("frame: {:.2f} ms", last.frameMs), passes, 5.5F * unit());
    drawPlot(history, fmt::format("triangles: {} of {}", triangleText(s.triangles), triangleText(s.trianglesFull)),
             {{kPositive, [](const FrameSample& f) { return static_cast<double>(f.statistics.triangles); }}},
             3.0F * unit());
    // The colours of the ghosts.
    drawPlot(history,
             fmt::format("objects: {} drawn, {} hidden, {} small, {} outside", s.drawn, s.culledOcclusion,
                         s.culledSmall, s.culledFrustum),
             {{kPositive, [](const FrameSample& f) { return static_cast<double>(f.statistics.drawn); }},
              {IM_COL32(244, 64, 176, 255),
               [](const FrameSample& f) { return static_cast<double>(f.statistics.culledOcclusion); }},
              {IM_COL32(244, 216, 64, 255),
               [](const FrameSample& f) { return static_cast<double>(f.statistics.culledSmall); }},
              {IM_COL32(137, 168, 209, 255),
               [](const FrameSample& f) { return static_cast<double>(f.statistics.culledFrustum); }}},
             3.0F * unit());
    drawPasses(history, names);
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
