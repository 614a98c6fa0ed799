// Declares and checks the options with CLI11.
#include "bake/pipeline/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <system_error>

#include "bake/pipeline/build_identity.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

constexpr const char* kExamples = R"(Examples:
  jalousie-bake bunny.ply -o bunny.glb
      ten levels, each with half the triangles of the one before
  jalousie-bake bunny.ply -o bunny.glb --subdivide 2 --coarsest 98
      the thesis' asset: 58,784 triangles down to 98
  jalousie-bake dragon.ply -o dragon.glb --preset fast --ratios 0.25,0.05 --sheet dragon.html
      two levels at 25 and 5 % of the triangles, and a page that shows them
  jalousie-bake inspect dragon.glb
      the chain of any glTF file
  jalousie-bake city.gltf -o city.glb --levels 6 --ratio 0.4 --json report.json
      every mesh of a scene; hierarchy, materials and textures stay
  jalousie-bake models 'extra/**/*.obj' -o baked/ --cache ~/.cache/jalousie --json baked.json
      every file below models and extra into the folder baked; unchanged ones are not baked again
  jalousie-bake chair.gltf -o chair.glb --depfile chair.d
      for Make and Ninja: chair.d names every buffer and image that chair.glb depends on

The output is standard glTF 2.0 with MSFT_lod; each level's mesh carries triangles, vertices and the measured
deviation from LOD 0 (object units) in extras.jalousie.

Exit codes: 0 done, 2 command line, 3 file not found, 4 cannot be read, 5 malformed, 6 not supported, 7 over a limit,
8 cannot be written, 11 some files of a batch failed, 70 a defect, 130 interrupted. A failure is one line on standard
error; what was there before is intact.)";

constexpr const char* kInspectExamples = R"(Examples:
  jalousie-bake inspect city.glb
      triangles, errors and screen coverage of every chain
  jalousie-bake inspect other_tools.glb --sheet sheet.html
      a page with every level beside the original; levels without measures are measured)";

constexpr const char* kBaking = "Baking";    // options that decide what the bytes of the output are
constexpr const char* kRunning = "Running";  // options that do not
constexpr const char* kOutputs = "Files";

/// "512M" as bytes, without CLI11's list of units in the help.
CLI::Validator bytesWithUnit() {
  CLI::Validator validator = CLI::AsSizeValue(false);
  validator.description("");
  return validator;
}

/// The options of one group that were given, with their values.
std::string chosenOptions(const CLI::App& program, const char* group) {
  std::string text;
  for (const CLI::Option* option : program.get_options()) {
    if (option->get_group() != group || option->count() == 0) continue;
    text += option->get_name();
    for (const std::string& value : option->results())
      text += " " + value;
    text += "\n";
  }
  return text;
}

/// False after --help or --version was answered.
bool parse(CLI::App& program, int argc, const char* const* argv, const char* help) {
  try {
    program.parse(argc, argv);
    return true;
  } catch (const CLI::Success& answer) {
    program.exit(answer);
    return false;
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::kUsage, fmt::format("{} (see {} --help)", error.what(), help));
  }
}

std::optional<CommandLine> parseInspect(int argc, const char* const* argv) {
  CommandLine result;
  result.inspect = true;
  bool json = false;
  CLI::App program{"Shows the LOD chains of a glTF file, whatever tool made them", "jalousie-bake inspect"};
  program.get_formatter()->column_width(32);
  program.add_option("input", result.inputs, "glTF or GLB file")->required()->expected(1)->type_name("FILE");
  program.add_flag("--json", json, "JSON instead of tables");
  program.add_option("--sheet", result.sheet, "Write a page with pictures of every level")->type_name("OUT.html");
  program.add_flag("-q,--quiet", result.quiet, "No tables");
  program.footer(kInspectExamples);
  if (!parse(program, argc, argv, "jalousie-bake inspect")) return std::nullopt;
  if (json) result.json = "-";
  return result;
}

/// Which files, and how the work is done.
void addRunOptions(CLI::App& program, CommandLine& result, double& timeout) {
  program.option_defaults()->group(kOutputs);
  program
      .add_option("inputs", result.inputs,
                  "PLY, OBJ, glTF or GLB files; into a folder also folders and quoted patterns with *, ? and **")
      ->type_name("IN...");
  program
      .add_option(
          "-o,--output", result.output,
          "Baked file; several PLY and OBJ files become one scene. A folder, existing or with a slash at the end, "
          "gets a file for each input")
      ->required()
      ->type_name("OUT.glb|FOLDER/");
  program
      .add_option("--files-from", result.filesFrom, "Read more inputs from a file, one a line; - for standard input")
      ->type_name("LIST");
  program.add_flag("--keep-extension", result.keepExtension, "Into a folder: chair.obj becomes chair.obj.glb");
  program.add_option("--json", result.json, "Write a report as JSON; - for standard output")->type_name("REPORT");
  program
      .add_option(
          "--sheet", result.sheet,
          "Write a page with every level beside the original and its error as a heat map; a folder for a folder")
      ->type_name("OUT.html|FOLDER/");
  program.add_option("--depfile", result.depfile, "Write what the output depends on, for Make and Ninja")
      ->type_name("FILE");
  program.option_defaults()->group(kRunning);
  program
      .add_option("-j,--jobs", result.jobs, "Threads in all; files of a folder are baked side by side (default: cores)")
      ->check(CLI::Range(1U, 256U));
  program
      .add_option("--cache", result.cache,
                  "Keep results here by content, and take them instead of baking again; may be shared")
      ->type_name("DIR");
  program.add_option("--cache-limit", result.cacheLimit, "Forget what was not used for longest beyond this size")
      ->transform(bytesWithUnit())
      ->type_name("SIZE")
      ->default_str("10G");
  program
      .add_option(
          "--max-memory", result.maxMemory,
          "Memory of one bake, e.g. 512M; 0 for no limit (default: nine tenths of the machine's, shared by the jobs)")
      ->transform(bytesWithUnit())
      ->type_name("SIZE");
  program.add_option("--timeout", timeout, "Give up on a file after this many seconds")
      ->check(CLI::Range(0.001, 1e6))
      ->type_name("SECONDS");
  program.add_flag("-q,--quiet", result.quiet, "No progress, no table");
}

/// What CLI11 cannot check by itself.
void checkOptions(const CLI::App& program, const CommandLine& result) {
  const ChainOptions& chain = result.bake.chain;
  for (const char* weight : {"--weight-normal", "--weight-uv", "--weight-color"})
    if (chain.preset == Preset::kDraft && program.count(weight) > 0)
      throw Error(ErrorCode::kUsage, fmt::format("{} means nothing to --preset draft; take best or fast", weight));
  if (std::adjacent_find(chain.ratios.begin(), chain.ratios.end(), std::less_equal<>()) != chain.ratios.end())
    throw Error(ErrorCode::kUsage, "--ratios must descend, e.g. 0.5,0.25,0.1");
  if (chain.ratios.size() >= kMaxLevels)
    throw Error(ErrorCode::kUsage, fmt::format("--ratios: at most {} levels below LOD 0", kMaxLevels - 1));
  if (result.inputs.empty() && result.filesFrom.empty())
    throw Error(ErrorCode::kUsage, "inputs is required (see jalousie-bake --help)");
  if (program.count("--cache-limit") > 0 && result.cache.empty())
    throw Error(ErrorCode::kUsage, "--cache-limit means nothing without --cache");
  if (result.keepExtension && !isBatch(result))
    throw Error(ErrorCode::kUsage, "--keep-extension means nothing when the output is one file");
}

/// Limits on what a file may ask for, so that most bombs are named before they meet the limit on memory.
void limitDemands(std::uint64_t maxMemory, asset::Limits& limits) {
  if (maxMemory == 0) return;
  limits.maxFileBytes = std::min(limits.maxFileBytes, maxMemory / 3);
  limits.maxJsonElements = std::min<std::uint64_t>(limits.maxJsonElements, maxMemory / 512);
  limits.maxAccessorElements = std::min(limits.maxAccessorElements, maxMemory / 32);
}

}  // namespace

bool isBatch(const CommandLine& command) {
  std::error_code absent;
  return command.output.string().ends_with('/') || std::filesystem::is_directory(command.output, absent);
}

std::optional<CommandLine> parseCommandLine(int argc, const char* const* argv) {
  if (argc > 1 && std::string_view(argv[1]) == "inspect") return parseInspect(argc - 1, argv + 1);
  CommandLine result;
  double timeout = 0.0;
  ChainOptions& chain = result.bake.chain;
  CLI::App program{"Bakes meshes into glTF with discrete LOD chains and a measured error per level", "jalousie-bake"};
  program.get_formatter()->column_width(32);
  program.set_version_flag("--version", kVersion);
  addRunOptions(program, result, timeout);
  program.option_defaults()->group(kBaking);
  program.add_option("--levels", chain.levels, "Most levels of a chain, LOD 0 included")
      ->check(CLI::Range(1U, kMaxLevels))
      ->capture_default_str();
  auto* ratio = program.add_option("--ratio", chain.ratio, "Triangles of a level over those of the one before")
                    ->check(CLI::Range(0.05, 0.95))
                    ->capture_default_str();
  program
      .add_option("--coarsest", chain.coarsest,
                  "Triangles of the last level; the others are spaced evenly in ratio. Replaces --ratio")
      ->check(CLI::Range(kMinLevelTriangles, 100'000'000U))
      ->excludes(ratio);
  program.add_option("--ratios", chain.ratios, "Triangles of LOD 1, 2, ... over those of LOD 0, e.g. 0.5,0.25,0.1")
      ->delimiter(',')
      ->check(CLI::Range(1e-6, 1.0))
      ->type_name("R,...")
      ->excludes(ratio);
  program.add_option("--until-error", chain.untilError, "No level with a larger error, % of the diagonal")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  program.add_option("--until-triangles", chain.untilTriangles, "No level with fewer triangles")
      ->check(CLI::Range(kMinLevelTriangles, 100'000'000U));
  program
      .add_option("--preset", chain.preset,
                  "best: position and attributes, two rounds of refit; fast: position, one round; draft: meshoptimizer")
      ->transform(CLI::Validator(CLI::CheckedTransformer(
                                     std::map<std::string, Preset>{
                                         {"best", Preset::kBest}, {"fast", Preset::kFast}, {"draft", Preset::kDraft}},
                                     CLI::ignore_case))
                      .description(""))
      ->type_name("best|fast|draft")
      ->default_str("best");
  program
      .add_option("--weight-normal", chain.collapse.normalWeight,
                  "Weight of normals beside distance, 0 = ignore (best 1, fast 0)")
      ->check(CLI::Range(0.0, 100.0));
  program.add_option("--weight-uv", chain.collapse.uvWeight, "Weight of texture coordinates")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  program.add_option("--weight-color", chain.collapse.colorWeight, "Weight of vertex colours")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  program.add_flag("--lock-border", chain.collapse.lockBorder, "Open borders stay where they are, for tiles");
  program
      .add_option("--hard-angle", result.bake.hardAngle,
                  "Rebuild normals: edges that bend by more degrees stay hard, all others are smooth")
      ->check(CLI::Range(0.0, 180.0))
      ->type_name("DEG");
  program
      .add_option("--pixels", result.bake.screen.pixels, "Error on screen that MSFT_screencoverage allows, in pixels")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  program.add_option("--height", result.bake.screen.height, "Height in pixels of that screen, 16:9")
      ->check(CLI::Range(16.0, 100'000.0))
      ->capture_default_str();
  program.add_option("--subdivide", result.bake.subdivide, "Loop subdivision steps before baking; manifold meshes")
      ->check(CLI::Range(0U, 4U))
      ->capture_default_str();
  program
      .add_option("--samples", chain.samples,
                  "Points per surface for the measures (best 100000, fast 12000, draft 10000)")
      ->check(CLI::Range(100U, 10'000'000U));
  program.add_flag("--quantize", result.quantize, "Positions 16, normals 8, UVs 16 bits (KHR_mesh_quantization)");
  program.add_flag("--compress", result.compress, "Compress vertices and indices (EXT_meshopt_compression)");
  program.footer(kExamples);
  if (!parse(program, argc, argv, "jalousie-bake")) return std::nullopt;
  checkOptions(program, result);
  result.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(timeout * 1000.0));
  result.chosen = chosenOptions(program, kBaking);
  limitDemands(result.maxMemory.value_or(0), result.bake.limits);
  return result;
}

}  // namespace jalousie::bake
