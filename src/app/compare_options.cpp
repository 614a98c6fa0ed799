// Declaration and checks of the options of `jalousie compare`.
#include "app/compare_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "app/option_checks.h"
#include "app/option_values.h"
#include "core/error.h"

namespace jalousie::app {
namespace {

constexpr std::uint32_t kMostKept = 20;
constexpr std::size_t kMostTaus = 24;
constexpr float kMostTau = 1000.0F;
constexpr std::size_t kMostConfigurations = 16;

[[noreturn]] void refuse(const std::string& reason) {
  throw Error(ErrorCode::kUsage, reason);
}

template <class Value>
Value number(const std::string& text, const char* option) {
  Value value{};
  if (!CLI::detail::lexical_cast(text, value)) refuse(fmt::format("{}: {} is no number", option, text));
  return value;
}

}  // namespace

compare::FrameRange parseFrames(const std::string& text, std::uint32_t frameCount) {
  if (text.empty()) return {0, frameCount - 1, (frameCount + kDefaultFrames - 1) / kDefaultFrames};
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() > 3) refuse(fmt::format("--frames {}: say A:B:STEP", text));
  compare::FrameRange range;
  range.first = number<std::uint32_t>(parts[0], "--frames");
  range.last = parts.size() > 1 ? number<std::uint32_t>(parts[1], "--frames") : range.first;
  range.step = parts.size() > 2 ? number<std::uint32_t>(parts[2], "--frames") : 1;
  if (range.step == 0 || range.first > range.last)
    refuse(fmt::format("--frames {}: A must not exceed B, STEP is at least 1", text));
  if (range.last >= frameCount)
    refuse(fmt::format("--frames {}: the camera path has the frames 0 to {}", text, frameCount - 1));
  return range;
}

std::vector<float> parseSweep(const std::string& text) {
  if (text.empty()) return {};
  constexpr std::string_view kHead = "tau=";
  if (!text.starts_with(kHead)) refuse(fmt::format("--sweep {}: say tau=A:B or tau=A,B,C", text));
  const std::string values = text.substr(kHead.size());
  std::vector<float> taus;
  if (const std::vector<std::string> ends = split(values, ':'); ends.size() == 2) {
    const auto last = number<float>(ends[1], "--sweep");
    auto tau = number<float>(ends[0], "--sweep");
    if (!(tau > 0.0F) || !(tau <= last)) refuse(fmt::format("--sweep {}: 0 < A <= B", text));
    for (; tau <= last * 1.0001F && taus.size() <= kMostTaus; tau *= 2.0F)
      taus.push_back(tau);
  } else {
    for (const std::string& value : split(values, ','))
      taus.push_back(number<float>(value, "--sweep"));
  }
  if (!std::all_of(taus.begin(), taus.end(), [](float tau) { return tau > 0.0F && tau <= kMostTau; }))
    refuse(fmt::format("--sweep {}: tau is in (0, {}]", text, kMostTau));
  std::sort(taus.begin(), taus.end());
  taus.erase(std::unique(taus.begin(), taus.end()), taus.end());
  if (taus.size() > kMostTaus) refuse(fmt::format("--sweep {}: more than {} values", text, kMostTaus));
  return taus;
}

void CompareOptions::finish() {
  chosen = chosenConfigurations(configurations);
  for (const std::string& text : moreConfigurations)
    chosen.push_back(parseConfiguration(text));
  if (chosen.size() > kMostConfigurations)
    throw Error(ErrorCode::kLimit, fmt::format("{} configurations, at most {}", chosen.size(), kMostConfigurations));
  const auto file = [](const std::string& name) { return compare::pictureName(0, name, compare::Picture::kImage); };
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::string& name = chosen[i].name;
    if (file(name) == file(compare::kReferenceName))
      refuse(fmt::format("\"{}\" is the name of what is compared with", name));
    for (std::size_t k = 0; k < i; ++k)
      if (file(name) == file(chosen[k].name))
        refuse(fmt::format("\"{}\" and \"{}\" are called alike", chosen[k].name, name));
  }
  for (const ConfigurationText& c : chosen)
    if (c.name.empty() || c.name.size() > 64)
      refuse(fmt::format("a configuration's name has 1 to 64 characters: \"{}\"", c.name));
  if (!baseline.empty() &&
      std::none_of(chosen.begin(), chosen.end(), [&](const auto& c) { return c.name == baseline; }))
    refuse(fmt::format("--baseline {}: no chosen configuration has this name", baseline));
  taus = parseSweep(sweep);
  if (reference == "none" && !taus.empty()) refuse("--sweep measures image errors; it needs --reference lod0 or full");
  if (width < compare::kLeastSsimSide || height < compare::kLeastSsimSide)
    refuse(fmt::format("--size: pictures are compared from {0}x{0} pixels on", compare::kLeastSsimSide));
}

void addCompareOptions(CLI::App& command, CompareOptions& o) {
  command.add_option("scene", o.scene, "glTF or GLB file, baked")->required()->type_name("SCENE.glb");
  command.add_option("-o,--output", o.output, "Folder of the report: index.html, summary.json, frames.csv, pictures/")
      ->required()
      ->type_name("REPORT");
  command.add_option("--path", o.path, "glTF or GLB file whose camera animation is followed [the scene's own]")
      ->type_name("PATH.glb");
  command.add_option("--camera", o.camera, "Name or number of the camera to follow [0]");
  command
      .add_option("--configs", o.configurations,
                  "Sets and configurations (below), separated by commas, or a .json file")
      ->type_name("LIST|FILE.json")
      ->capture_default_str();
  command
      .add_option("--config", o.moreConfigurations,
                  "One more configuration: a name and options of `jalousie render`; can be given several times")
      ->type_name("NAME=OPTIONS")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--baseline", o.baseline, "Configuration that ratios refer to [the first]")->type_name("NAME");
  command
      .add_option("--frames", o.frames,
                  "Frames of the path, the last one included, 30 a second [the whole path, 60 of its frames at most]")
      ->type_name("A:B:STEP");
  addSize(command, o.width, o.height);
  command
      .add_option("--reference", o.reference,
                  "What pictures are compared with: lod0 = every object at its finest, culled without loss; full = the "
                  "same without culling; none = no pictures, triangles and times of the culling passes alone")
      ->check(CLI::IsMember({"lod0", "full", "none"}))
      ->capture_default_str();
  command
      .add_option("--sweep", o.sweep,
                  "Curves of error over cost: tau doubles from A to B, at the kept frames, where a configuration has a "
                  "budget")
      ->type_name("tau=A:B");
  command.add_option("--keep", o.keep, "Frames whose pictures go into the report, evenly spread")
      ->check(CLI::Range(0U, kMostKept))
      ->capture_default_str();
  command
      .add_option("--lead", o.lead,
                  "Where frames are left out, history starts this many frames before each measured one")
      ->check(CLI::Range(0U, 1000U))
      ->capture_default_str();
  command.add_option("--ppd", o.pixelsPerDegree, "Pixels per degree of visual angle, for FLIP [67.02]")
      ->check(inRange(compare::kLeastPixelsPerDegree, compare::kMostPixelsPerDegree));
  command.add_flag("--resume", o.resume, "Go on with the interrupted report in REPORT");
  command.add_option("--json", o.json, "- writes summary.json to standard output as well")
      ->check(CLI::IsMember({"-"}))
      ->type_name("-");
  command.add_flag("-q,--quiet", o.quiet, "No progress and no summary");
  command.footer(describeConfigurations() + R"(Examples:
  jalousie compare scene.glb -o report
      the default against frustum culling and two-phase culling with a pixel error, along the scene's camera path
  jalousie compare scene.glb --configs ab --sweep tau=0.25:8 --frames 900:1199:10 -o report
      LOD chain or tessellation? Error over triangles, and pictures to slide between
  jalousie compare scene.glb --configs hiz --config "coarse=--tau 4" --config "calm=--tau 4 --calm" -o report
      options of your own
  jalousie compare scene.glb --configs thesis --reference none --size 1280x720 -o report
      triangle counts over the whole path in minutes: nothing but the culling passes runs
  jalousie compare scene.glb --configs all -o report --resume
      after an interruption
Exit codes: 0 done; 130 interrupted, the report holds what was measured; others as in docs/formats.md.
)");
}

}  // namespace jalousie::app
