// Declares and checks the options with CLI11.
#include "bake/pipeline/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <system_error>

#include "asset/lod_faces.h"
#include "bake/pipeline/build_identity.h"
#include "cli/force_option.h"
#include "cli/memory_option.h"
#include "cli/option_checks.h"
#include "cli/program.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

/// "LEAST..MOST", as every help text of the project writes a range.
template <class Number>
std::string rangeText(Number least, Number most) {
  return fmt::format("{:g}..{:g}", static_cast<double>(least), static_cast<double>(most));
}

constexpr const char* kExamples = R"(Examples:
  jalousie-bake bunny.ply -o bunny.glb
      bake ten levels, each with half the triangles of the level before
  jalousie-bake bunny.ply -o bunny.glb --subdivide 2 --coarsest 98
      bake the asset of the thesis: from 58,784 triangles down to 98
  jalousie-bake dragon.ply -o dragon.glb --preset fast --ratios 0.25,0.05 --sheet dragon.html
      bake two levels with 25 and 5 % of the triangles, and a page that shows them
  jalousie-bake dragon.ply -o dragon.glb --error 0.1%,0.5%,2%
      bake three levels, each with as few triangles as its error allows
  jalousie-bake inspect dragon.glb
      print the LOD chain of any glTF file
  jalousie-bake cut bunny.glb -o near.glb --from 0,0.1,0.3
      choose a level for each cell of a file baked with --cell-levels, for one place of the eye
  jalousie-bake city.gltf -o city.glb --levels 6 --ratio 0.4 --json report.json
      bake every mesh of a scene; hierarchy, materials and textures are kept
  jalousie-bake models 'extra/**/*.obj' -o baked/ --cache ~/.cache/jalousie --json baked.json
      bake every file below models and extra into the folder baked; unchanged files are taken from the cache
  jalousie-bake chair.gltf -o chair.glb --depfile chair.d
      write a rule for Make and Ninja: chair.d names every buffer and image that chair.glb depends on

The output is glTF 2.0 with MSFT_lod. The mesh of each level stores its triangles, its vertices and the measured
deviation from LOD 0 (object units) in extras.jalousie.)";

constexpr const char* kInspectExamples = R"(Examples:
  jalousie-bake inspect city.glb
      print triangles, errors and screen coverage of every chain
  jalousie-bake inspect other_tools.glb --sheet sheet.html
      write a page with every level beside the original; levels without stored measures are measured)";

constexpr const char* kCutExamples = R"(Examples:
  jalousie-bake dragon.ply -o dragon.glb --cell-levels
  jalousie-bake cut dragon.glb -o near.glb --from 0,0.1,0.3 --pixels 1 --height 1080
      fine cells near the eye and coarse ones behind, in one mesh without cracks
  jalousie-bake cut dragon.glb -o flat.glb --error 0.05%
      the coarsest cells whose largest deviation is at most 0.05 % of the diagonal
  jalousie-bake cut city.glb -o street.glb --from 0,8,0 --mean --pixels 0.2
      by the mean deviation of each group of cells, at most 0.2 pixels
  jalousie-bake cut dragon.glb -o near.glb --from 0,0.1,0.3 --json report.json
      also write triangles and cells of each level

The levels of the input stay in the output as meshes that no node shows.)";

constexpr const char* kBaking = "Baking";    // options that change the bytes of the output
constexpr const char* kRunning = "Running";  // options that do not
constexpr const char* kOutputs = "Files";

/// A process that can report a failure needs this much.
constexpr std::uint64_t kLeastMemory = 16ULL << 20U;

/// The given options of one group with their values.
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

std::optional<CommandLine> parseInspect(int argc, const char* const* argv) {
  CommandLine result;
  result.inspect = true;
  bool json = false;
  CLI::App program{"Prints the LOD chains of a glTF file, made by any tool", "jalousie-bake inspect"};
  program.get_formatter()->column_width(32);
  program.add_option("input", result.inputs, "Read this glTF or GLB file")->required()->expected(1)->type_name("FILE");
  program.add_flag("--json", json, "Print JSON instead of tables");
  program.add_option("--sheet", result.sheet, "Write a page with pictures of every level")->type_name("OUT.html");
  cli::addForceOption(program, result.replace);
  program.add_flag("-q,--quiet", result.quiet, "Print no tables");
  program.footer(kInspectExamples);
  if (!cli::parse(program, argc, argv)) return std::nullopt;
  if (json) result.json = "-";
  return result;
}

/// Removes the sign of a percentage. @return  empty, or what is wrong with the number
std::string percentNumber(std::string& text) {
  constexpr double kMost = 100.0;
  const std::string digits = text.ends_with('%') ? text.substr(0, text.size() - 1) : text;
  double number = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || !(number > 0.0 && number <= kMost))
    return fmt::format("{} is not a percentage above 0, at most {:g}", text, kMost);
  text = digits;
  return {};
}

/// "X,Y,Z" as three finite numbers; nullopt if the text is none.
std::optional<glm::dvec3> placeIn(const std::string& text) {
  glm::dvec3 place(0.0);
  std::vector<std::string> parts = CLI::detail::split(text, ',');
  if (parts.size() != 3) return std::nullopt;
  for (int axis = 0; axis < 3; ++axis)
    if (!CLI::detail::lexical_cast(parts[static_cast<std::size_t>(axis)], place[axis]) || !std::isfinite(place[axis]))
      return std::nullopt;
  return place;
}

void addCutLimits(CLI::App& program, CutOptions& cut) {
  CLI::Option* const from = program
                                .add_option_function<std::string>(
                                    "--from", [&cut](const std::string& text) { cut.eye = placeIn(text); },
                                    "Choose levels for an eye at this place in the scene, e.g. 0,0.1,0.3")
                                ->check(CLI::Validator(
                                    [](const std::string& text) {
                                      return placeIn(text) ? std::string() : fmt::format("{} is not X,Y,Z", text);
                                    },
                                    ""))
                                ->type_name("X,Y,Z");
  program.add_option("--pixels", cut.pixels, "Allow this screen-space error, pixels")
      ->needs(from)
      ->check(cli::inRange(0.01, 1000.0).description(""))
      ->type_name(rangeText(0.01, 1000.0))
      ->capture_default_str();
  program.add_option("--height", cut.height, "Set the height of the screen, pixels")
      ->needs(from)
      ->check(cli::inRange(16.0, 100'000.0).description(""))
      ->type_name(rangeText(16.0, 100'000.0))
      ->capture_default_str();
  program.add_option("--fov", cut.fieldOfView, "Set the vertical field of view, degrees")
      ->needs(from)
      ->check(cli::inRange(1.0, 170.0).description(""))
      ->type_name(rangeText(1.0, 170.0))
      ->capture_default_str();
  program
      .add_option("--error", cut.errorPercent,
                  "Without --from: allow this error everywhere, % of the bounding box diagonal, e.g. 0.05%")
      ->transform(CLI::Validator(percentNumber, ""))
      ->excludes(from)
      ->type_name("E")
      ->capture_default_str();
  program.add_flag_callback(
      "--mean", [&cut] { cut.by = asset::CutBy::kMean; },
      "Compare the mean deviation of each group instead of its largest one: fewer triangles, but single places may "
      "deviate more");
}

std::optional<CommandLine> parseCut(int argc, const char* const* argv) {
  CommandLine result;
  CutOptions& cut = result.cut.emplace();
  CLI::App program{"Replaces chains baked with --cell-levels by one mesh each, whose cells have levels of their own",
                   "jalousie-bake cut"};
  program.get_formatter()->column_width(32);
  program.add_option("input", result.inputs, "Read this glTF or GLB file")->required()->expected(1)->type_name("FILE");
  program.add_option("-o,--output", result.output, "Write this file")->required()->type_name("OUT.glb");
  addCutLimits(program, cut);
  program.add_flag("--compress", result.compress, "Compress vertices and indices (EXT_meshopt_compression)");
  program.add_option("--json", result.json, "Write a report as JSON; - for standard output")->type_name("REPORT");
  cli::addForceOption(program, result.replace);
  program.add_flag("-q,--quiet", result.quiet, "Print no table");
  program.footer(kCutExamples);
  if (!cli::parse(program, argc, argv)) return std::nullopt;
  cut.limits = result.bake.limits;
  return result;
}

/// Inputs and outputs.
void addFileOptions(CLI::App& program, CommandLine& result) {
  program.option_defaults()->group(kOutputs);
  program
      .add_option("inputs", result.inputs,
                  "Read these PLY, OBJ, STL, glTF or GLB files; "
                  "if the output is a folder, also folders and quoted patterns with *, ? and **")
      ->type_name("IN...");
  program
      .add_option("-o,--output", result.output,
                  "Write the baked file; several PLY, OBJ and STL files become one scene. "
                  "A folder (one that exists, or with a slash at the end) gets one file for each input")
      ->required()
      ->type_name("OUT.glb|FOLDER/");
  program
      .add_option("--files-from", result.filesFrom,
                  "Read more inputs from a list with one path per line; - for standard input")
      ->type_name("LIST");
  program.add_flag("--keep-extension", result.keepExtension,
                   "Keep the extension of inputs in a folder's file names: chair.obj becomes chair.obj.glb");
  program.add_option("--json", result.json, "Write a report as JSON; - for standard output")->type_name("REPORT");
  program
      .add_option("--sheet", result.sheet,
                  "Write a page with every level beside the original and its error as a heat map; "
                  "a folder if the output is a folder")
      ->type_name("OUT.html|FOLDER/");
  program
      .add_option("--depfile", result.depfile,
                  "Write the files that the output depends on, as a rule for Make and Ninja")
      ->type_name("FILE");
  cli::addForceOption(program, result.replace);
}

/// Threads, cache and limits.
void addRunOptions(CLI::App& program, CommandLine& result, std::optional<double>& timeout) {
  program.option_defaults()->group(kRunning);
  program
      .add_option("-j,--jobs", result.jobs,
                  "Use this many threads; files of a folder are baked in parallel [all cores]")
      ->check(cli::inRange(1U, 256U).description(""))
      ->type_name(rangeText(1U, 256U));
  program
      .add_option("--cache", result.cache,
                  "Store results in this folder and reuse them for equal inputs and options; runs may share it [none]")
      ->type_name("DIR");
  program
      .add_option("--cache-limit", result.cacheLimit,
                  "Delete the least recently used results when the cache exceeds this size, bytes or with K, M, G")
      ->transform(CLI::Validator(cli::bytesOption(0), ""))
      ->type_name("SIZE")
      ->default_str("10G");
  program
      .add_option("--max-memory", result.maxMemory,
                  "Limit the memory of one bake, bytes or with K, M, G; 0: no limit "
                  "[4G and 64 bytes for each byte of input; at most 90 % of the machine's, shared by the jobs]")
      ->transform(CLI::Validator(cli::bytesOption(kLeastMemory), ""))
      ->type_name("SIZE");
  program
      .add_option("--timeout", timeout,
                  "Stop the bake of a file after this time, seconds; 0: no limit [600 and 60 for each MiB of input]")
      ->check(cli::inRange(0.0, 1e6).description(""))
      ->type_name(rangeText(0.0, 1e6));
  program.add_flag("-q,--quiet", result.quiet, "Print no progress and no table");
}

/// The levels of a chain and when it ends.
void addChainOptions(CLI::App& program, ChainOptions& chain) {
  program.add_option("--levels", chain.levels, "Make at most this many levels, LOD 0 included")
      ->check(cli::inRange(1U, kMaxLevels).description(""))
      ->type_name(rangeText(1U, kMaxLevels))
      ->capture_default_str();
  auto* ratio =
      program
          .add_option("--ratio", chain.ratio, "Set the triangles of a level, as a share of those of the level before")
          ->check(cli::inRange(0.05, 0.95).description(""))
          ->type_name(rangeText(0.05, 0.95))
          ->capture_default_str();
  program
      .add_option("--coarsest", chain.coarsest,
                  "Set the triangles of the last level and space the levels by a constant ratio; replaces --ratio")
      ->check(cli::inRange(kMinLevelTriangles, 100'000'000U).description(""))
      ->type_name(rangeText(kMinLevelTriangles, 100'000'000U))
      ->excludes(ratio);
  program
      .add_option("--ratios", chain.ratios,
                  "Set the triangles of LOD 1, 2, ... as shares of those of LOD 0, descending, e.g. 0.5,0.25,0.1")
      ->delimiter(',')
      ->check(cli::inRange(1e-6, 1.0).description(""))
      ->type_name("R,...")
      ->excludes(ratio);
  program
      .add_option("--error", chain.errors,
                  "Make one level for each of these errors instead of numbers of triangles: the stored error comes as "
                  "near as possible and is never larger; % of the bounding box diagonal, ascending, e.g. 0.1%,0.5%,2%")
      ->delimiter(',')
      ->transform(CLI::Validator(percentNumber, ""))
      ->type_name("E,...");
  program
      .add_option("--until-error", chain.untilError,
                  "End the chain before a level with a larger maximum error, % of the bounding box diagonal")
      ->check(cli::positive())
      ->capture_default_str();
  program
      .add_option("--until-triangles", chain.untilTriangles, "End the chain before a level with fewer triangles [4]")
      ->check(cli::inRange(kMinLevelTriangles, 100'000'000U).description(""))
      ->type_name(rangeText(kMinLevelTriangles, 100'000'000U));
}

/// Replaces the name of a preset by its number. @return  empty, or what is wrong with the name
std::string presetNumber(std::string& name) {
  constexpr std::pair<const char*, Preset> kPresets[] = {
      {"best", Preset::kBest}, {"fast", Preset::kFast}, {"draft", Preset::kDraft}};
  for (const auto& [known, preset] : kPresets) {
    if (CLI::detail::to_lower(name) != known) continue;
    name = std::to_string(static_cast<int>(preset));
    return {};
  }
  return fmt::format("{} is not best, fast or draft", name);
}

/// How levels are simplified.
void addSimplifyOptions(CLI::App& program, ChainOptions& chain) {
  program
      .add_option("--preset", chain.preset,
                  "Choose the simplification. best: collapse on position and attributes, two rounds of refit; "
                  "fast: collapse without weighting normals, one round of refit; draft: meshoptimizer, no refit")
      ->transform(CLI::Validator(presetNumber, ""))
      ->type_name("best|fast|draft")
      ->default_str("best");
  program
      .add_option("--weight-normal", chain.collapse.normalWeight,
                  "Weight deviations of normals against distances; 0: ignore normals [best 1, fast 0]")
      ->check(cli::inRange(0.0, 100.0).description(""))
      ->type_name(rangeText(0.0, 100.0));
  program
      .add_option("--weight-uv", chain.collapse.uvWeight,
                  "Weight deviations of texture coordinates against distances; 0: ignore them")
      ->check(cli::inRange(0.0, 100.0).description(""))
      ->type_name(rangeText(0.0, 100.0))
      ->capture_default_str();
  program
      .add_option("--weight-color", chain.collapse.colorWeight,
                  "Weight deviations of vertex colours against distances; 0: ignore them")
      ->check(cli::inRange(0.0, 100.0).description(""))
      ->type_name(rangeText(0.0, 100.0))
      ->capture_default_str();
  program.add_flag("--lock-border", chain.collapse.lockBorder,
                   "Keep the vertices of open borders with all their attributes, e.g. for terrain tiles");
}

constexpr std::uint32_t kLeastPerCell = 64;
constexpr std::uint32_t kMostPerCell = 65536;

/// auto, off or a number of triangles; nullopt if the text is none of them.
std::optional<CellOptions> cellOptions(const std::string& text) {
  if (CLI::detail::to_lower(text) == "auto") return CellOptions();
  if (CLI::detail::to_lower(text) == "off") return CellOptions{0, true, false};
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (number < kLeastPerCell || number > kMostPerCell) return std::nullopt;
  return CellOptions{number, false, false};
}

void addCellOption(CLI::App& program, CellOptions& cells) {
  const auto check = [](const std::string& text) {
    return cellOptions(text) ? std::string()
                             : fmt::format("{} is not auto, off or {}", text, rangeText(kLeastPerCell, kMostPerCell));
  };
  program
      .add_option_function<std::string>(
          "--cells",
          [&cells](const std::string& text) {
            const bool levels = cells.levels;
            cells = *cellOptions(text);
            cells.levels = levels;
          },
          "Order the triangles by spatial cells that are culled one by one, with at most this many triangles each; "
          "auto: 256, meshes of up to 512 triangles are not divided; off: no cells")
      ->check(CLI::Validator(check, ""))
      ->type_name(fmt::format("auto|{}|off", rangeText(kLeastPerCell, kMostPerCell)))
      ->default_str("auto");
  program.add_flag("--cell-levels", cells.levels,
                   "Make the levels so that each group of neighbouring cells can have a level of its own without a "
                   "crack, and store the groups and their errors, e.g. jalousie-bake bunny.ply -o bunny.glb "
                   "--cell-levels; not with --cells off, --error or --preset draft");
}

void addFaceOption(CLI::App& program, asset::FaceGrouping& faces) {
  using Grouping = asset::FaceGrouping;
  std::vector<std::string> names;
  for (const Grouping grouping : asset::kFaceGroupings)
    names.emplace_back(asset::nameOf(grouping));
  program
      .add_option_function<std::string>(
          "--backface",
          [&faces](const std::string& name) {
            for (const Grouping grouping : asset::kFaceGroupings)
              if (name == asset::nameOf(grouping)) faces = grouping;
          },
          "Order the triangles of each cell by groups that face alike, so that render --backface culls back faces "
          "before they are drawn. masks: by the direction of their normals; clusters: by direction and place, with a "
          "tree above them; meshlets: meshoptimizer's meshlets, to compare with; off: no groups")
      ->check(CLI::IsMember(names).description(""))
      ->type_name("off|masks|clusters|meshlets")
      ->default_str("off");
}

/// Replaces the name of a budget by whether it is the scene's. @return  empty, or what is wrong with the name
std::string budgetNumber(std::string& name) {
  const std::string known = CLI::detail::to_lower(name);
  if (known != "scene" && known != "mesh") return fmt::format("{} is not scene or mesh", name);
  name = known == "scene" ? "true" : "false";
  return {};
}

/// What is read from a document, and what its ratios refer to.
void addMeshOptions(CLI::App& program, BakeOptions& bake) {
  program
      .add_option(
          "--budget", bake.sceneBudget,
          "Apply the ratios to the scene as a whole, or to each mesh by itself. scene: the least error goes first "
          "in all meshes, small meshes may be left out of coarse levels, and vertices that the borders of meshes share "
          "stay; not with --preset draft")
      ->transform(CLI::Validator(budgetNumber, ""))
      ->type_name("scene|mesh")
      ->default_str("scene");
  program.add_option("--weld", bake.weld, "Weld vertices that are at most this far apart, object units [equal ones]")
      ->check(cli::positive())
      ->type_name("DISTANCE");
  program.add_flag(
      "--keep-unused", bake.keepUnused,
      "Keep attributes that no material uses in all levels, and weigh them; by default only LOD 0 has them");
}

/// What is done before and after the simplification.
void addDocumentOptions(CLI::App& program, CommandLine& result) {
  program
      .add_option(
          "--hard-angle", result.bake.hardAngle,
          "Rebuild normals: edges that bend by a larger angle are hard, all others smooth, degrees [keep normals]")
      ->check(cli::inRange(0.0, 180.0).description(""))
      ->type_name(rangeText(0.0, 180.0));
  program
      .add_option("--pixels", result.bake.screen.pixels,
                  "Set the screen-space error that MSFT_screencoverage allows, pixels")
      ->check(cli::inRange(0.01, 1000.0).description(""))
      ->type_name(rangeText(0.01, 1000.0))
      ->capture_default_str();
  program
      .add_option("--height", result.bake.screen.height,
                  "Set the height of the 16:9 screen that MSFT_screencoverage refers to, pixels")
      ->check(cli::inRange(16.0, 100'000.0).description(""))
      ->type_name(rangeText(16.0, 100'000.0))
      ->capture_default_str();
  program
      .add_option("--subdivide", result.bake.subdivide,
                  "Apply this many steps of Loop subdivision before baking; needs manifold meshes")
      ->check(cli::inRange(0U, 4U).description(""))
      ->type_name(rangeText(0U, 4U))
      ->capture_default_str();
  program
      .add_option("--samples", result.bake.chain.samples,
                  "Measure errors at this many points per surface [best 100000, fast 12000, draft 10000]")
      ->check(cli::inRange(100U, 10'000'000U).description(""))
      ->type_name(rangeText(100U, 10'000'000U));
  addMeshOptions(program, result.bake);
  addCellOption(program, result.bake.cells);
  addFaceOption(program, result.bake.faces);
  program.add_flag("--occluders", result.bake.occluders,
                   "Find convex occluders for jalousie render --mode solid and planar: up to three boxes inside each "
                   "closed opaque mesh, at all its levels, else up to four large flat rectangles of LOD 0");
  program.add_flag("--quantize", result.quantize,
                   "Store positions in 16, normals in 8 and texture coordinates in 16 bits (KHR_mesh_quantization)");
  program.add_flag("--compress", result.compress, "Compress vertices and indices (EXT_meshopt_compression)");
}

/// What a level per cell does not go with.
void checkCellLevels(const BakeOptions& bake) {
  if (!bake.cells.levels) return;
  const char* other = bake.cells.trianglesPerCell == 0      ? "--cells off; use --cells auto"
                      : bake.chain.preset == Preset::kDraft ? "--preset draft; use best or fast"
                      : !bake.chain.errors.empty()          ? "--error; use --ratio or --ratios"
                                                            : nullptr;
  if (other != nullptr) throw Error(ErrorCode::kUsage, fmt::format("--cell-levels cannot be used with {}", other));
}

/// Checks options against each other.
void checkOptions(const CLI::App& program, const CommandLine& result) {
  const ChainOptions& chain = result.bake.chain;
  for (const char* weight : {"--weight-normal", "--weight-uv", "--weight-color"})
    if (chain.preset == Preset::kDraft && program.count(weight) > 0)
      throw Error(ErrorCode::kUsage, fmt::format("{} has no effect with --preset draft; use best or fast", weight));
  checkCellLevels(result.bake);
  if (chain.preset == Preset::kDraft && program.count("--budget") > 0 && result.bake.sceneBudget)
    throw Error(ErrorCode::kUsage, "--budget scene has no effect with --preset draft; use best or fast");
  if (std::adjacent_find(chain.ratios.begin(), chain.ratios.end(), std::less_equal<>()) != chain.ratios.end())
    throw Error(ErrorCode::kUsage, "--ratios must descend, e.g. 0.5,0.25,0.1");
  if (chain.ratios.size() >= kMaxLevels)
    throw Error(ErrorCode::kUsage, fmt::format("--ratios: at most {} levels below LOD 0", kMaxLevels - 1));
  for (const char* other : {"--levels", "--ratio", "--coarsest", "--ratios", "--until-error"})
    if (!chain.errors.empty() && program.count(other) > 0)
      throw Error(ErrorCode::kUsage, fmt::format("--error already says which levels are made; leave out {}", other));
  if (std::adjacent_find(chain.errors.begin(), chain.errors.end(), std::greater_equal<>()) != chain.errors.end())
    throw Error(ErrorCode::kUsage, "--error must ascend, e.g. 0.1%,0.5%,2%");
  if (chain.errors.size() >= kMaxLevels)
    throw Error(ErrorCode::kUsage, fmt::format("--error: at most {} levels below LOD 0", kMaxLevels - 1));
  if (result.inputs.empty() && result.filesFrom.empty())
    throw Error(ErrorCode::kUsage, "inputs is required (see jalousie-bake --help)");
  if (program.count("--cache-limit") > 0 && result.cache.empty())
    throw Error(ErrorCode::kUsage, "--cache-limit has no effect without --cache");
  if (result.keepExtension && !isBatch(result))
    throw Error(ErrorCode::kUsage, "--keep-extension has no effect if the output is one file");
}

/// Lowers the limits on the input, so that most oversized files are refused with a reason before memory runs out.
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
  if (argc > 1 && std::string_view(argv[1]) == "cut") return parseCut(argc - 1, argv + 1);
  CommandLine result;
  std::optional<double> timeout;
  CLI::App program{"Bakes meshes into glTF with discrete LOD chains and a measured error per level", "jalousie-bake"};
  program.get_formatter()->column_width(32);
  program.set_version_flag("--version", kVersion);
  addFileOptions(program, result);
  addRunOptions(program, result, timeout);
  program.option_defaults()->group(kBaking);
  addChainOptions(program, result.bake.chain);
  addSimplifyOptions(program, result.bake.chain);
  addDocumentOptions(program, result);
  program.footer(kExamples);
  if (!cli::parse(program, argc, argv)) return std::nullopt;
  checkOptions(program, result);
  if (timeout) result.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(std::ceil(*timeout * 1000.0)));
  result.chosen = chosenOptions(program, kBaking);
  limitDemands(result.maxMemory.value_or(0), result.bake.limits);
  return result;
}

}  // namespace jalousie::bake
