// One row per option, and what is read out of a row.
#include "app/render_option_table.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string_view>

#include "app/option_checks.h"
#include "core/check.h"

namespace jalousie::app {
namespace {

using Options = RenderOptions;

/// A bound that says nothing to people.
constexpr double kEndless = 1e6;

bool drawsMap(const Options& o) {
  return o.mode == "hom" || o.mode == "hom-depth";
}
bool followsError(const Options& o) {
  return o.lod == "pixel-error" || o.lod == "lv-error";
}
bool isCalm(const Options& o) {
  return followsError(o) && o.frameOptions.calm;
}
bool usesLv(const Options& o) {
  return o.lod == "linear" || o.lod == "lv-error" || o.view == "lv";
}
bool countsPixels(const Options& o) {
  return usesLv(o) && (o.lv == "pixels" || (o.lv.empty() && o.lod != "linear"));
}

std::vector<RenderOption> cullingRows() {
  return {
      {"--mode", "mode", "",
       "Culling: full = none, frustum, hom = hierarchical occlusion map as in the thesis, hom-depth = the same where "
       "the "
       "occluders are in front, hiz = two phases against depth, never hides what can be seen",
       OptionGroup::kCulling,
       ChoiceValue{[](Options& o) -> std::string& { return o.mode; }, {"full", "frustum", "hom", "hom-depth", "hiz"}}},
      {"--min-pixels", "smallest rectangle", "pixels of area",
       "Contribution culling: leave out objects whose rectangle covers fewer pixels; 0 = none", OptionGroup::kCulling,
       NumberValue{[](Options& o) -> float& { return o.frameOptions.minPixels; }, 0.0F, 1e6F},
       "a mode that culls; --mode full does not", [](const Options& o) { return o.mode != "full"; }},
      {"--importance", "importance mask", "",
       "Grey image stretched over the screen: white keeps --tau and --min-pixels, darker divides by its value, down to "
       "1/16",
       OptionGroup::kCulling, FileValue{[](Options& o) -> std::filesystem::path& { return o.importance; }, "MASK.png"}},
      {"--occluder-distance", "occluder distance", "world units",
       "Objects nearer than this are occluders [distance to the scene + 12 % of its diagonal]", OptionGroup::kCulling,
       MaybeNumberValue{[](Options& o) -> std::optional<float>& { return o.frameOptions.occluderDistance; }, 0.0F,
                        1e30F},
       "--mode hom or hom-depth", drawsMap},
      {"--occluder-tau", "occluder error", "pixels",
       "Error of the levels drawn into the occlusion map [hom: 0, hom-depth: 0.5]", OptionGroup::kCulling,
       MaybeNumberValue{[](Options& o) -> std::optional<float>& { return o.frameOptions.occluderTau; }, 0.0F, 1000.0F},
       "--mode hom or hom-depth", drawsMap},
      {"--cull-threshold", "cull threshold", "opacity",
       "Opacity from which a texel of the map hides; below 1 visible pixels can be lost", OptionGroup::kCulling,
       NumberValue{[](Options& o) -> float& { return o.frameOptions.cullThreshold; }, 0.01F, 1.0F},
       "--mode hom or hom-depth", drawsMap},
  };
}

std::vector<RenderOption> detailRows() {
  return {
      {"--lod", "level rule", "",
       "Detail: finest, linear = by level of visibility, pixel-error = coarsest level within --tau, lv-error = the "
       "same, "
       "relaxed where the object is hidden",
       OptionGroup::kDetail,
       ChoiceValue{[](Options& o) -> std::string& { return o.lod; }, {"finest", "linear", "pixel-error", "lv-error"}}},
      {"--tau", "error budget", "pixels", "Error that --lod pixel-error and lv-error allow", OptionGroup::kDetail,
       NumberValue{[](Options& o) -> float& { return o.frameOptions.tau; }, 0.0F, 1000.0F},
       "--lod pixel-error or lv-error", followsError},
      {"--lv", "hiddenness", "",
       "Measure of hiddenness: thesis = level of visibility, spectral = how finely divided the opening is, chord = how "
       "short its mean chord, coverage = covered share alone, pixels = counted in the last frame, none [linear: "
       "thesis, "
       "lv-error and --view lv: pixels]",
       OptionGroup::kDetail,
       ChoiceValue{[](Options& o) -> std::string& { return o.lv; },
                   {"none", "thesis", "spectral", "chord", "coverage", "pixels"}},
       "--lod linear, --lod lv-error or --view lv", [](const Options& o) { return usesLv(o) || o.lv == "none"; }},
      {"--relax", "relaxation", "times tau",
       "With --lod lv-error, tau grows with (visible share)^(-1/4), up to 1 + RELAX times", OptionGroup::kDetail,
       NumberValue{[](Options& o) -> float& { return o.frameOptions.relax; }, 0.0F, 1000.0F}, "--lod lv-error",
       [](const Options& o) { return o.lod == "lv-error"; }},
      {"--calm", "calm", "",
       "Levels keep within a margin of the budget (hysteresis), change one at a time and are cross-faded, as in a "
       "moving "
       "picture; without it they follow from the view alone",
       OptionGroup::kDetail, FlagValue{[](Options& o) -> bool& { return o.frameOptions.calm; }},
       "--lod pixel-error or lv-error", followsError},
      {"--hysteresis", "hysteresis", "times tau",
       "A calm level stays while tau times and tau over this allow it; 1 = no margin", OptionGroup::kDetail,
       NumberValue{[](Options& o) -> float& { return o.frameOptions.hysteresis; }, 1.0F, 16.0F}, "--calm", isCalm},
      {"--fade", "cross-fade", "frames", "How long a calm level fades into the next one; 0 = it switches at once",
       OptionGroup::kDetail,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.fadeFrames; }, 0, gpu::kMaxFadeFrames},
       "--calm", isCalm},
      {"--detail", "detail path", "", "discrete = LOD chain, tessellation = Phong patches over the coarsest level",
       OptionGroup::kDetail,
       ChoiceValue{[](Options& o) -> std::string& { return o.detail; }, {"discrete", "tessellation"}}},
      {"--max-tessellation", "finest patches", "edges per edge", "Finest tessellation level", OptionGroup::kDetail,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.maxTessellation; }, 1,
                  gpu::kMaxTessellationLevel},
       "--detail tessellation", [](const Options& o) { return o.detail == "tessellation"; }},
  };
}

std::vector<RenderOption> drawingRows() {
  return {
      {"--draws", "draw commands", "",
       "instanced = one command per mesh and level, per-object = one per object; same image", OptionGroup::kDrawing,
       ChoiceValue{[](Options& o) -> std::string& { return o.draws; }, {"instanced", "per-object"}}},
      {"--capacity", "list capacity", "objects",
       "Most objects one draw list holds; more are left out, counted and reported [all]", OptionGroup::kDrawing,
       MaybeCountValue{[](Options& o) -> std::optional<std::uint32_t>& { return o.rendererOptions.capacity; }, 1,
                       0x3fffffffU}},
      {"--core", "core only", "", "OpenGL 4.5 core only, no extension; same image", OptionGroup::kDrawing,
       FlagValue{[](Options& o) -> bool& { return o.coreOnly; }}},
  };
}

std::vector<RenderOption> viewRows() {
  return {
      {"--view", "view", "",
       "shaded; lod = occluders red, others blue, lighter = coarser; lv = heat map of hiddenness; coverage = heat map "
       "of "
       "the covered share, holes = of the mean hole in front of it; occlusion = the map or depth pyramid itself; phase "
       "= "
       "drawn before the test grey, after it orange, before it in vain red; wireframe = the triangles, coloured by "
       "level; "
       "overdraw = surfaces per pixel; ghosts = what was culled, see-through over the rest",
       OptionGroup::kView, ChoiceValue{[](Options& o) -> std::string& { return o.view; }, viewNames()}},
      {"--map-level", "map level", "pyramid level", "Level that --view occlusion shows; one texel is 2^level pixels",
       OptionGroup::kView, CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.mapLevel; }, 0, 14},
       "--view occlusion", [](const Options& o) { return o.view == "occlusion"; }},
      {"--boxes", "rectangles", "",
       "Draw every object's rectangle on the screen (AABR) over the view: open green, partly covered yellow, hidden "
       "red, "
       "occluders white",
       OptionGroup::kView, FlagValue{[](Options& o) -> bool& { return o.frameOptions.boxes; }}},
      {"--settle", "settle", "frames",
       "With --mode hiz or --lv pixels, frames from the same camera before the picture; 0 shows the first frame after "
       "a "
       "cut",
       OptionGroup::kView, CountValue{[](Options& o) -> std::uint32_t& { return o.settle; }, 0, 1000},
       "--mode hiz or --lv pixels", [](const Options& o) { return o.mode == "hiz" || countsPixels(o); }},
  };
}

std::vector<RenderOption> makeTable() {
  std::vector<RenderOption> rows;
  for (std::vector<RenderOption>& some : std::array{cullingRows(), detailRows(), drawingRows(), viewRows()})
    for (RenderOption& row : some)
      rows.push_back(std::move(row));
  return rows;
}

/// visit with one callable per kind.
template <class... Calls>
struct Overloaded : Calls... {
  using Calls::operator()...;
};

}  // namespace

const std::vector<std::string>& viewNames() {
  static const std::vector<std::string> kNames = {"shaded",   "lod",   "lv",        "occlusion", "phase",
                                                  "coverage", "holes", "wireframe", "overdraw",  "ghosts"};
  return kNames;
}

std::span<const RenderOption> renderOptionTable() {
  static const std::vector<RenderOption> kTable = makeTable();
  return kTable;
}

const RenderOption& renderOption(std::string_view name) {
  for (const RenderOption& row : renderOptionTable())
    if (name == row.name) return row;
  JAL_CHECK(name == "an option of the table");
  return renderOptionTable().front();
}

std::string optionHelp(const RenderOption& option) {
  return *option.unit == '\0' ? std::string(option.help) : fmt::format("{}; {}", option.help, option.unit);
}

bool applies(const RenderOption& option, const RenderOptions& options) {
  return option.applies == nullptr || option.applies(options);
}

bool isSet(const RenderOption& option, const RenderOptions& options) {
  return options.given.contains(option.name) || valueText(option, options) != valueText(option, RenderOptions{});
}

std::string valueText(const RenderOption& option, const RenderOptions& options) {
  RenderOptions copy = options;
  return std::visit(
      Overloaded{
          [&](const ChoiceValue& v) { return v.of(copy); },
          [&](const NumberValue& v) { return fmt::format("{}", v.of(copy)); },
          [&](const MaybeNumberValue& v) { return v.of(copy) ? fmt::format("{}", *v.of(copy)) : std::string(); },
          [&](const CountValue& v) { return fmt::format("{}", v.of(copy)); },
          [&](const MaybeCountValue& v) { return v.of(copy) ? fmt::format("{}", *v.of(copy)) : std::string(); },
          [&](const FlagValue& v) { return std::string(v.of(copy) ? "on" : ""); },
          [&](const FileValue& v) { return v.of(copy).string(); },
      },
      option.value);
}

void reset(const RenderOption& option, RenderOptions& options) {
  RenderOptions fresh;
  std::visit([&](const auto& v) { v.of(options) = v.of(fresh); }, option.value);
  options.given.erase(option.name);
}

void dropInapplicable(RenderOptions& options) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const RenderOption& row : renderOptionTable()) {
      if (!isSet(row, options) || applies(row, options)) continue;
      reset(row, options);
      changed = true;
    }
  }
}

void addToCommandLine(CLI::App& command, const RenderOption& option, RenderOptions& options) {
  const std::string help = optionHelp(option);
  const auto add = [&]<class Value>(const auto& v, Value /*kind*/) {
    return command.add_option_function<Value>(
        option.name,
        [&options, &option, of = v.of](const Value& value) {
          of(options) = value;
          options.given.insert(option.name);
        },
        help);
  };
  // The type says what may be given; the checks need not say it again.
  const auto number = [](CLI::Option* of, auto least, auto most, const char* endless) {
    const auto from = static_cast<double>(least);
    const auto to = static_cast<double>(most);
    return of->check(inRange(from, to).description(""))
        ->type_name(to < kEndless ? fmt::format("{:g}..{:g}", from, to) : std::string(endless));
  };
  CLI::Option* added = std::visit(
      Overloaded{
          [&](const ChoiceValue& v) {
            return add(v, std::string())
                ->check(CLI::IsMember(v.names).description(""))
                ->type_name(fmt::format("{}", fmt::join(v.names, "|")));
          },
          [&](const NumberValue& v) { return number(add(v, float()), v.least, v.most, "NUMBER"); },
          [&](const MaybeNumberValue& v) { return number(add(v, float()), v.least, v.most, "NUMBER"); },
          [&](const CountValue& v) { return number(add(v, std::uint32_t()), v.least, v.most, "COUNT"); },
          [&](const MaybeCountValue& v) { return number(add(v, std::uint32_t()), v.least, v.most, "COUNT"); },
          [&](const FlagValue& v) { return command.add_flag(option.name, v.of(options), help); },
          [&](const FileValue& v) { return add(v, std::string())->type_name(v.type); },
      },
      option.value);
  const std::string standard = valueText(option, RenderOptions{});
  if (!standard.empty()) added->default_str(standard);
}

}  // namespace jalousie::app
