// Parses the options. Precedence: explicit options, then the preset, then the defaults.
#include "scatter/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "asset/gltf_file.h"
#include "cli/force_option.h"
#include "cli/memory_option.h"
#include "cli/program.h"
#include "core/error.h"
#include "scatter/city.h"

namespace jalousie::scatter {
namespace {

/// Side of the thesis' first cube in diagonals of the object's box: 5001 objects (about 17 to a side), 0.6 of a
/// diagonal apart, so that neighbours touch or overlap slightly. The thesis gives no number, only "relatively small"
/// and "tightly packed" (4.2.1).
constexpr float kThesisSideDiagonals = 17.0F * 0.6F;
/// The second cube is "much larger" (4.2.2): three times the side, 27 times the volume for twice the objects.
constexpr float kThesisLargeSideDiagonals = 3.0F * kThesisSideDiagonals;
/// Range of the second scene's random scale, which the thesis leaves open.
constexpr ScaleRange kThesisScale{0.5F, 1.5F};
/// Without preset and --side: distance of neighbours in diagonals, so that few objects overlap.
constexpr double kDefaultSpacing = 1.2;

constexpr const char* kDescription =
    "Scatters copies of a baked object in a cube or on the ground: instances, LOD chain, camera path and optional "
    "occluder in one GLB";
constexpr const char* kFooter = R"(Examples:
  jalousie-scatter bunny.glb --preset thesis-5001 -o bunnies.glb
      scatter 5001 objects, as in the first scene of the thesis
  jalousie-scatter bunny.glb --preset thesis-10001 --seed 7 --json report.json -o sparse.glb
      scatter 10001 objects of random size with other random numbers, and write a report
  jalousie-scatter rock.glb --count 300 --side 80 --rotate any --scale 0.5,2 -o rocks.glb
      scatter 300 objects with random rotation and scale
  jalousie-scatter tree.glb --count 800 --layout ground --scale 0.5,2 -o wood.glb
      let 800 objects stand on the ground
  jalousie-scatter bunny.glb --count 2000 --layout city --built 0.3 -o town.glb
      let 2000 objects stand in the streets and courtyards of a sparse city
  jalousie-scatter bunny.glb --count 1 --occluder foliage --cover 0.8 -o behind_leaves.glb
      place one object behind leaves that cover 80 % of the occluder's area

The same input and options give the same bytes. The first object is in the middle.
Every scene has an animated camera with 1800 frames at 30 per second. Several objects: around them (frames 0-899),
towards it (900-1199), a circle inside (1200-1799). A single object: circles around it, or an arc in front of the
occluder. A city has three cameras: walk, flight and drive.)";

/// The options as given; absent ones come from the preset or the defaults.
struct Given {
  std::string preset;
  std::optional<std::uint32_t> count;
  std::optional<float> side;
  std::optional<std::string> rotate;
  std::optional<std::string> scale;
  std::string layout = "cube";
  std::string occluder;
  float cover = 0.75F;
  float moving = 0.0F;
  std::optional<float> built;
};

[[noreturn]] void usage(const std::string& message) {
  throw Error(ErrorCode::kUsage, message);
}

Rotation rotationFor(const std::string& name) {
  if (name == "x") return Rotation::kX;
  return name == "any" ? Rotation::kAny : Rotation::kNone;
}

OccluderKind occluderFor(const std::string& name) {
  static const std::map<std::string, OccluderKind> kKinds = {{"foliage", OccluderKind::kFoliage},
                                                             {"grid", OccluderKind::kGrid},
                                                             {"fence", OccluderKind::kFence},
                                                             {"plane", OccluderKind::kPlane}};
  return kKinds.at(name);
}

float parseFloat(std::string_view text) {
  float value = 0.0F;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    usage(fmt::format("--scale: \"{}\" is not a number", text));
  return value;
}

ScaleRange parseScale(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) usage("--scale needs MIN,MAX");
  const ScaleRange range{parseFloat(text.substr(0, comma)), parseFloat(text.substr(comma + 1))};
  if (!(range.min > 0.0F) || range.min > range.max) usage("--scale needs 0 < MIN <= MAX");
  return range;
}

Layout presetLayout(const std::string& preset) {
  Layout layout;
  if (preset == "thesis-5001") {
    layout.count = 5001;
    layout.sideDiagonals = kThesisSideDiagonals;
    layout.rotation = Rotation::kX;
  } else if (preset == "thesis-10001") {
    layout.count = 10001;
    layout.sideDiagonals = kThesisLargeSideDiagonals;
    layout.rotation = Rotation::kX;
    layout.scale = kThesisScale;
  }
  return layout;
}

/// What a city needs beside what all layouts need.
void resolveCity(const Given& given, Layout& layout) {
  if (layout.shape != Shape::kCity) {
    if (given.built) usage("--built needs --layout city");
    return;
  }
  if (!given.occluder.empty()) usage("--layout city has buildings, and no --occluder");
  if (layout.scale.max > kLargestInStreets)
    usage(fmt::format("--layout city needs a --scale of at most {}: streets have a width", kLargestInStreets));
  layout.built = given.built.value_or(1.0F);
  if (!(layout.built >= 0.0F && layout.built <= 1.0F)) usage("--built must be 0 to 1");
}

/// Merges preset, explicit options and defaults; checks the ranges.
Layout resolveLayout(const Given& given, std::uint64_t seed) {
  if (given.preset.empty() && !given.count) usage("--count or --preset is required");
  Layout layout = presetLayout(given.preset);
  layout.seed = seed;
  if (given.count) layout.count = *given.count;
  const std::uint64_t most = asset::Limits{}.maxInstances;
  if (layout.count < 1 || layout.count > most) usage(fmt::format("--count must be 1 to {}", most));
  if (given.layout == "ground") layout.shape = Shape::kGround;
  if (given.layout == "city") layout.shape = Shape::kCity;
  if (given.preset.empty() || layout.isOnGround()) {
    const auto count = static_cast<double>(layout.count);
    const double along = layout.isOnGround() ? std::sqrt(count) : std::cbrt(count);
    layout.sideDiagonals = static_cast<float>(kDefaultSpacing * along);
  }
  if (given.side) {
    if (!std::isfinite(*given.side) || !(*given.side > 0.0F)) usage("--side must be a positive length");
    layout.side = given.side;
  }
  if (given.rotate) layout.rotation = rotationFor(*given.rotate);
  if (given.scale) layout.scale = parseScale(*given.scale);
  if (!(given.moving >= 0.0F && given.moving <= 1.0F)) usage("--moving must be 0 to 1");
  layout.moving = given.moving;
  resolveCity(given, layout);
  return layout;
}

std::optional<Occluder> resolveOccluder(const Given& given, bool coverGiven) {
  if (!(given.cover >= 0.0F && given.cover <= 1.0F)) usage("--cover must be 0 to 1");
  if (given.occluder.empty()) {
    if (coverGiven) usage("--cover needs --occluder");
    return std::nullopt;
  }
  return Occluder{occluderFor(given.occluder), given.cover};
}

void addLayoutOptions(CLI::App& app, Given& given, std::uint64_t& seed) {
  app.add_option("--count", given.count, "Scatter this many objects, the one in the middle included [from --preset]")
      ->type_name(fmt::format("1..{}", asset::Limits{}.maxInstances));
  app.add_option("--layout", given.layout,
                 "Place objects in a cube, let them stand on a square of ground, or in the streets and courtyards of a "
                 "city of closed buildings")
      ->check(CLI::IsMember({"cube", "ground", "city"}))
      ->capture_default_str();
  app.add_option("--built", given.built,
                 "Build on this share of the lots around each block of the city; one lot of a block is its gate")
      ->type_name("0..1")
      ->default_str("1");
  app.add_option("--side", given.side,
                 "Set the side of the cube or square of the objects' centres, world units "
                 "[1.2 diagonals of the object per object along a side; a city: rounded up to whole blocks, with 60 "
                 "objects a block]")
      ->type_name("LENGTH");
  app.add_option("--rotate", given.rotate, "Rotate objects at random: x (about the global x axis), any, none")
      ->check(CLI::IsMember({"x", "any", "none"}))
      ->default_str("none");
  app.add_option("--scale", given.scale, "Scale objects at random by a factor from MIN to MAX, 0 < MIN <= MAX")
      ->type_name("MIN,MAX")
      ->default_str("1,1");
  app.add_option("--moving", given.moving,
                 "Let this share of the objects bounce in the cube or on the ground; the one in the middle stays")
      ->type_name("0..1")
      ->capture_default_str();
  app.add_option("--seed", seed, "Set the seed of all random numbers")->capture_default_str();
  app.add_option("--preset", given.preset,
                 "Use a scene of the thesis: thesis-5001 (dense cube), thesis-10001 (sparse cube, random scale); "
                 "given options override it [none]")
      ->check(CLI::IsMember({"thesis-5001", "thesis-10001"}));
}

/// @return  the option --cover
CLI::Option* addOccluderOptions(CLI::App& app, Given& given) {
  app.add_option("--occluder", given.occluder,
                 "Place an occluder before the objects, as seen from the first frame: "
                 "foliage, grid (small holes), fence (wide slots), plane (one large hole) [none]")
      ->check(CLI::IsMember({"foliage", "grid", "fence", "plane"}));
  return app.add_option("--cover", given.cover, "Cover this share of the occluder's area; approximate for foliage")
      ->type_name("0..1")
      ->default_str("0.75");
}

}  // namespace

std::optional<Options> parseCommandLine(int argc, const char* const* argv) {
  CLI::App app(kDescription, "jalousie-scatter");
  app.footer(kFooter);
  Options options;
  Given given;
  std::uint64_t seed = 1;
  app.add_option("BAKED", options.input,
                 "Read this glTF or GLB file and scatter copies of its scene: all meshes with their LOD chains")
      ->required()
      ->type_name("FILE");
  app.add_option("-o,--output", options.output, "Write this GLB file")->required()->type_name("OUT.glb");
  addLayoutOptions(app, given, seed);
  const CLI::Option* cover = addOccluderOptions(app, given);
  app.add_option("--json", options.report, "Write counts, sizes and bounds of the scene as JSON; - for standard output")
      ->type_name("REPORT");
  cli::addForceOption(app, options.replace);
  cli::addMemoryOption(app, options.memory);
  app.add_flag("-q,--quiet", options.quiet, "Print no progress and no summary");
  if (!cli::parse(app, argc, argv)) return std::nullopt;
  options.layout = resolveLayout(given, seed);
  options.occluder = resolveOccluder(given, cover->count() > 0);
  return options;
}

}  // namespace jalousie::scatter
