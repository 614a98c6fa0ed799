// Declares and checks the options with CLI11.
#include "bake/command_line.h"

#include <CLI/CLI.hpp>

#include "core/error.h"

namespace jalousie::bake {
namespace {

constexpr const char* kExamples = R"(Examples:
  jalousie-bake bunny.ply -o bunny.glb
      ten levels, each with half the triangles of the one before
  jalousie-bake bunny.ply -o bunny.glb --subdivide 2 --coarsest 98
      the thesis' asset: 58,784 triangles down to 98
  jalousie-bake city.gltf -o city.glb --levels 6 --ratio 0.4 --json report.json
      every mesh of a scene; hierarchy, materials and textures stay

The output is standard glTF 2.0 with MSFT_lod; each level's mesh carries triangles, vertices and the measured
deviation from LOD 0 (object units) in extras.jalousie.)";

}  // namespace

std::optional<CommandLine> parseCommandLine(int argc, const char* const* argv) {
  CommandLine result;
  CLI::App program{"Bakes meshes into glTF with discrete LOD chains and a measured error per level", "jalousie-bake"};
  program.get_formatter()->column_width(32);
  program.set_version_flag("--version", "0.1.0");
  program.add_option("inputs", result.inputs, "PLY or OBJ files, or one glTF or GLB file")
      ->required()
      ->type_name("IN...");
  program.add_option("-o,--output", result.output, "Baked file")->required()->type_name("OUT.glb");
  program.add_option("--levels", result.bake.chain.levels, "Most levels of a chain, LOD 0 included")
      ->check(CLI::Range(1U, kMaxLevels))
      ->capture_default_str();
  auto* ratio =
      program.add_option("--ratio", result.bake.chain.ratio, "Triangles of a level over those of the one before")
          ->check(CLI::Range(0.05, 0.95))
          ->capture_default_str();
  program
      .add_option("--coarsest", result.bake.chain.coarsest,
                  "Triangles of the last level; the others are spaced evenly in ratio. Replaces --ratio")
      ->check(CLI::Range(kMinLevelTriangles, 100'000'000U))
      ->excludes(ratio);
  program.add_option("--subdivide", result.bake.subdivide, "Loop subdivision steps before baking; manifold meshes")
      ->check(CLI::Range(0U, 4U))
      ->capture_default_str();
  program.add_option("--samples", result.bake.chain.samples, "Points per surface for the measured error")
      ->check(CLI::Range(100U, 10'000'000U))
      ->capture_default_str();
  program.add_option("--json", result.json, "Write a report as JSON; - for standard output")->type_name("REPORT");
  program.add_flag("-q,--quiet", result.quiet, "No progress, no table");
  program.footer(kExamples);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& answer) {
    program.exit(answer);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::kUsage, std::string(error.what()) + " (see jalousie-bake --help)");
  }
  return result;
}

}  // namespace jalousie::bake
