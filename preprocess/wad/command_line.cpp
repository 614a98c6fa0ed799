// The command line of jalousie-wad.
#include <CLI/CLI.hpp>

#include "cli/force_option.h"
#include "cli/program.h"
#include "wad/options.h"

namespace jalousie::wad {
namespace {

constexpr const char* kDescription =
    "Converts a level of a WAD file (Doom, Freedoom) to glTF with rooms and portals: sectors become rooms, lines with "
    "two sides portals";
constexpr const char* kFooter = R"(Examples:
  assets/fetch freedoom
  jalousie-wad assets/fetched/freedoom/freedoom1.wad --map E1M1 -o e1m1.glb
      convert the first level
  jalousie render e1m1.glb --frame 200 --mode portals -o e1m1.png
      draw what is seen through portals
  jalousie-wad freedoom2.wad --map MAP01 --doors closed --json report.json -o map01.glb
      leave doors closed, and write counts

Surfaces have the mean colours of their textures. Skies are closed by their ceiling. Monsters and items become boxes.
The camera "walk" goes from the first player's start to the farthest place that can be walked to.)";

}  // namespace

std::optional<Options> parseCommandLine(int argc, const char* const* argv) {
  CLI::App app(kDescription, "jalousie-wad");
  app.footer(kFooter);
  Options options;
  std::string doors = "open";
  app.add_option("WAD", options.input, "Read this WAD file")->required()->type_name("FILE");
  app.add_option("--map", options.map, "Convert this level, such as E1M1 or MAP01; an unknown name lists all")
      ->required()
      ->type_name("NAME");
  app.add_option("-o,--output", options.output, "Write this GLB file")->required()->type_name("OUT.glb");
  app.add_option(
         "--doors", doors,
         "Open doors up to 4 units below the lowest ceiling beside them, or leave them closed: closed doors have "
         "no portals")
      ->check(CLI::IsMember({"open", "closed"}))
      ->capture_default_str();
  app.add_option("--json", options.report, "Write counts of the level and of the scene as JSON; - for standard output")
      ->type_name("REPORT");
  cli::addForceOption(app, options.replace);
  app.add_flag("-q,--quiet", options.quiet, "Print no summary");
  if (!cli::parse(app, argc, argv)) return std::nullopt;
  options.opensDoors = doors == "open";
  return options;
}

}  // namespace jalousie::wad
