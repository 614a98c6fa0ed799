// Declares and checks the options of `jalousie compare`.
#include "app/compare_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/number_option.h"
#include "app/option_values.h"
#include "app/path_camera.h"
#include "app/render_command_line.h"
#include "cli/force_option.h"
#include "cli/memory_option.h"
#include "compare/report_folder.h"
#include "core/error.h"

namespace jalousie::app {
namespace {

constexpr std::uint32_t kMostKept = 20;
constexpr std::uint32_t kMostLead = 1000;
constexpr std::uint32_t kMostObjects = 2000;
constexpr std::size_t kMostTaus = 24;
constexpr float kMostTau = 1000.0F;
constexpr std::size_t kMostConfigurations = 16;
constexpr std::size_t kMostNameBytes = 64;

[[noreturn]] void refuse(const std::string& reason) {
  throw Error(ErrorCode::kUsage, reason);
}

template <class Value>
Value number(const std::string& text, const char* option) {
  Value value{};
  if (!CLI::detail::lexical_cast(text, value)) refuse(fmt::format("{}: \"{}\" is not a number", option, text));
  return value;
}

/// Errors: kUsage for names that would share picture files, or that are empty or too long.
void checkNames(const std::vector<ConfigurationText>& chosen) {
  const auto file = [](const std::string& name) { return compare::pictureName(0, name, compare::Picture::kImage); };
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::string& name = chosen[i].name;
    if (file(name) == file(compare::kReferenceName))
      refuse(fmt::format("\"{}\": this name is reserved for the reference", name));
    for (std::size_t k = 0; k < i; ++k)
      if (file(name) == file(chosen[k].name))
        refuse(fmt::format("\"{}\" and \"{}\": these names would give the same picture files", chosen[k].name, name));
  }
  for (const ConfigurationText& c : chosen)
    if (c.name.empty() || c.name.size() > kMostNameBytes)
      refuse(fmt::format("\"{}\": a configuration's name must have 1 to {} bytes", c.name, kMostNameBytes));
}

void addSceneOptions(CLI::App& command, CompareOptions& o) {
  command.add_option("scene", o.scene, "Baked glTF or GLB file")->required()->type_name("SCENE.glb");
  command
      .add_option("-o,--output", o.output, "Write index.html, summary.json, frames.csv and pictures/ into this folder")
      ->required()
      ->type_name("REPORT");
  command.add_option("--path", o.path, "Follow the camera animation of this glTF or GLB file [the scene's own]")
      ->type_name("PATH.glb");
  addCameraOption(command, o.camera);
  addTimeOption(command, o.time);
}

void addConfigurationOptions(CLI::App& command, CompareOptions& o) {
  command
      .add_option("--configs", o.configurations,
                  "Compare these sets and configurations (listed below), separated by commas, or those of a .json file")
      ->type_name("LIST|FILE.json")
      ->capture_default_str();
  command
      .add_option("--config", o.moreConfigurations,
                  "Add a configuration: a name and options of `jalousie render`; can be given several times")
      ->type_name("NAME=OPTIONS")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--baseline", o.baseline, "Form ratios against this configuration [the first one]")
      ->type_name("NAME");
}

void addFrameOptions(CLI::App& command, CompareOptions& o) {
  command
      .add_option("--frames", o.frames,
                  "Measure the frames A to B of the path, both included, in steps of STEP; a second has 30 frames "
                  "[the whole path, in steps that give at most 60 frames]")
      ->type_name("A:B:STEP");
  addSize(command, o.width, o.height);
  addNumber(command, "--lead", o.lead, {0, kMostLead},
            "Render this many frames, unmeasured, before each measured frame whose predecessor was left out, so that "
            "its history is complete; frames");
}

void addPictureOptions(CLI::App& command, CompareOptions& o) {
  command
      .add_option("--reference", o.reference,
                  "Compare pictures with a reference that has every object at its finest level: lod0 = with two-phase "
                  "culling, which never culls a visible pixel; full = without culling, slow; none = no reference and "
                  "no pictures, only triangle counts and times of the culling passes")
      ->check(CLI::IsMember({"lod0", "full", "none"}).description(""))
      ->type_name("lod0|full|none")
      ->capture_default_str();
  command
      .add_option("--sweep", o.sweep,
                  "Render the kept frames again at tau = A, 2A, 4A, up to B, for the configurations that use --tau, "
                  "and show error over cost; tau=A,B,C lists the values; 0 < tau <= 1000 pixels")
      ->type_name("tau=A:B");
  addNumber(command, "--keep", o.keep, {0, kMostKept},
            "Store pictures of this many frames, evenly spread over the measured ones; frames");
  addNumber(command, "--objects", o.objects, {0, kMostObjects},
            "List this many objects of each configuration, those with the largest error in the measured frame with the "
            "largest error: level, error allowed and used, pixels, triangles; 0 turns this off; objects");
  addNumber(command, "--ppd", o.pixelsPerDegree, {compare::kLeastPixelsPerDegree, compare::kMostPixelsPerDegree},
            "Resolution at the viewing distance that FLIP assumes; pixels per degree of visual angle");
  command.add_flag("--butteraugli", o.butteraugli,
                   "Measure the Butteraugli distance too, which models masking: an error in a busy place counts less. "
                   "This takes about 0.7 s a megapixel, three times as long as the other errors");
}

void addRunOptions(CLI::App& command, CompareOptions& o) {
  command.add_flag("--resume", o.resume, "Continue the interrupted report in REPORT");
  cli::addForceOption(command, o.replace, "Replace the report in REPORT");
  command.add_option("--json", o.json, "Print summary.json on standard output as well")
      ->check(CLI::IsMember({"-"}).description(""))
      ->type_name("-");
  cli::addMemoryOption(command, o.memory);
  command.add_flag("-q,--quiet", o.quiet, "Print no progress, no summary and no warnings");
}

constexpr const char* kExamples = R"(Examples:
  jalousie compare scene.glb -o report
      compares the default with frustum culling and with two-phase culling, along the scene's camera path
  jalousie compare scene.glb --configs ab --sweep tau=0.25:8 --frames 900:1199:10 -o report
      compares the LOD chain with tessellation: error over triangles, and pictures side by side
  jalousie compare scene.glb --configs hiz --config "coarse=--tau 4" --config "calm=--tau 4 --calm" -o report
      compares configurations of your own with hiz
  jalousie compare scene.glb --configs thesis --reference none --size 1280x720 -o report
      counts triangles over the whole path in minutes: only the culling passes run
  jalousie compare scene.glb --configs all -o report --resume
      continues after an interruption
After a signal the report holds what was measured. Two runs cannot use one folder at a time.
)";

}  // namespace

compare::FrameRange parseFrames(const std::string& text, std::uint32_t frameCount) {
  if (text.empty()) return {0, frameCount - 1, (frameCount + kDefaultFrames - 1) / kDefaultFrames};
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() > 3) refuse(fmt::format("--frames {}: expected A:B:STEP", text));
  compare::FrameRange range;
  range.first = number<std::uint32_t>(parts[0], "--frames");
  range.last = parts.size() > 1 ? number<std::uint32_t>(parts[1], "--frames") : range.first;
  range.step = parts.size() > 2 ? number<std::uint32_t>(parts[2], "--frames") : 1;
  if (range.step == 0 || range.first > range.last)
    refuse(fmt::format("--frames {}: A must not exceed B, and STEP must be at least 1", text));
  if (range.last >= frameCount)
    refuse(fmt::format("--frames {}: the camera path has the frames 0 to {}", text, frameCount - 1));
  return range;
}

std::vector<float> parseSweep(const std::string& text) {
  if (text.empty()) return {};
  constexpr std::string_view kHead = "tau=";
  if (!text.starts_with(kHead)) refuse(fmt::format("--sweep {}: expected tau=A:B or tau=A,B,C", text));
  const std::string values = text.substr(kHead.size());
  std::vector<float> taus;
  if (const std::vector<std::string> ends = split(values, ':'); ends.size() == 2) {
    const auto last = number<float>(ends[1], "--sweep");
    auto tau = number<float>(ends[0], "--sweep");
    if (!(tau > 0.0F) || !(tau <= last)) refuse(fmt::format("--sweep {}: A and B must satisfy 0 < A <= B", text));
    for (; tau <= last * 1.0001F && taus.size() <= kMostTaus; tau *= 2.0F)
      taus.push_back(tau);
  } else {
    for (const std::string& value : split(values, ','))
      taus.push_back(number<float>(value, "--sweep"));
  }
  if (!std::all_of(taus.begin(), taus.end(), [](float tau) { return tau > 0.0F && tau <= kMostTau; }))
    refuse(fmt::format("--sweep {}: tau must be above 0 and at most {} pixels", text, kMostTau));
  std::sort(taus.begin(), taus.end());
  taus.erase(std::unique(taus.begin(), taus.end()), taus.end());
  if (taus.size() > kMostTaus) refuse(fmt::format("--sweep {}: has more than {} values", text, kMostTaus));
  return taus;
}

void CompareOptions::finish() {
  if (resume && replace == Replace::kAnything) refuse("choose either --resume or --force");
  chosen = chosenConfigurations(configurations);
  for (const std::string& text : moreConfigurations)
    chosen.push_back(parseConfiguration(text));
  if (chosen.size() > kMostConfigurations)
    throw Error(ErrorCode::kLimit,
                fmt::format("{} configurations were given; the limit is {}", chosen.size(), kMostConfigurations));
  checkNames(chosen);
  if (!baseline.empty() &&
      std::none_of(chosen.begin(), chosen.end(), [&](const auto& c) { return c.name == baseline; }))
    refuse(fmt::format("--baseline {}: no chosen configuration has this name", baseline));
  taus = parseSweep(sweep);
  if (reference == "none" && !taus.empty()) refuse("--sweep measures image errors; it needs --reference lod0 or full");
  if (reference == "none" && butteraugli)
    refuse("--butteraugli measures image errors; it needs --reference lod0 or full");
  if (width < compare::kLeastSsimSide || height < compare::kLeastSsimSide)
    refuse(fmt::format("--size: pictures must have at least {0}x{0} pixels to be compared", compare::kLeastSsimSide));
}

void addCompareOptions(CLI::App& command, CompareOptions& options) {
  addSceneOptions(command, options);
  addConfigurationOptions(command, options);
  addFrameOptions(command, options);
  addPictureOptions(command, options);
  addRunOptions(command, options);
  command.footer(describeConfigurations() + kExamples);
}

}  // namespace jalousie::app
