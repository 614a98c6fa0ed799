// Computes PSNR, SSIM and FLIP of two files, prints them and writes the error map.
#include "app/diff_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/number_option.h"
#include "asset/image_io.h"
#include "core/error.h"
#include "core/output_files.h"
#include "core/standard_streams.h"

namespace jalousie::app {
namespace {

std::string text(const DiffOptions& options, const nlohmann::ordered_json& figures) {
  const nlohmann::ordered_json& psnr = figures.at("psnr");
  return fmt::format("FLIP  {:.6f}  mean; largest {:.4f} ({:.2f} pixels per degree)\nSSIM  {:.6f}\nPSNR  {}\n",
                     figures.at("flip").get<double>(), figures.at("flip_largest").get<double>(),
                     options.pixelsPerDegree, figures.at("ssim").get<double>(),
                     psnr.is_null() ? "equal pictures" : fmt::format("{:.4f} dB", psnr.get<double>()));
}

}  // namespace

void addDiffOptions(CLI::App& command, DiffOptions& o) {
  command.add_option("reference", o.reference, "Reference picture, PNG, JPEG or WebP")->required()->type_name("A.png");
  command.add_option("test", o.test, "Picture to compare with it, of the same size")->required()->type_name("B.png");
  command
      .add_option("-o,--output", o.output,
                  "Write FLIP's error map as PNG: black = 0, no visible difference; pale yellow = 1")
      ->type_name("MAP.png");
  command.add_option("--json", o.json, "Write the figures as JSON; - = standard output")->type_name("FIGURES");
  addNumber(command, "--ppd", o.pixelsPerDegree, {compare::kLeastPixelsPerDegree, compare::kMostPixelsPerDegree},
            "Resolution at the viewing distance that FLIP assumes; 67.02 is that of a 4K monitor, 0.7 m wide, seen "
            "from 0.7 m; pixels per degree of visual angle");
  command.footer(R"(The alpha channel is ignored.
Examples:
  jalousie diff finest.png lod.png
  jalousie diff finest.png lod.png -o error.png --json figures.json
  jalousie diff finest.png lod.png --ppd 40
      assumes viewers who sit nearer
)");
}

void runDiff(const DiffOptions& options) {
  checkOutputs(std::vector<NamedFile>{{"-o", options.output}, {"--json", options.json, true}},
               std::vector{options.reference, options.test});
  const ImageRgba8 reference = asset::loadImage(options.reference);
  const ImageRgba8 test = asset::loadImage(options.test);
  if (reference.width != test.width || reference.height != test.height)
    throw Error(ErrorCode::kUsage,
                fmt::format("has {}x{} pixels and the reference {}x{}; pictures must have the same size to be compared",
                            test.width, test.height, reference.width, reference.height),
                options.test);
  if (std::min(reference.width, reference.height) < compare::kLeastSsimSide)
    throw Error(ErrorCode::kUsage, fmt::format("has fewer than {0}x{0} pixels", compare::kLeastSsimSide),
                options.reference);
  const std::vector<float> map = compare::flipMap(compare::FlipImage(reference, options.pixelsPerDegree),
                                                  compare::FlipImage(test, options.pixelsPerDegree));
  const double psnr = compare::psnr(reference, test);
  nlohmann::ordered_json figures;
  figures["width"] = reference.width;
  figures["height"] = reference.height;
  figures["flip"] = compare::mean(map);
  figures["flip_largest"] = static_cast<double>(*std::max_element(map.begin(), map.end()));
  figures["pixels_per_degree"] = options.pixelsPerDegree;
  figures["ssim"] = compare::ssim(reference, test);
  figures["psnr"] = std::isfinite(psnr) ? nlohmann::ordered_json(psnr) : nlohmann::ordered_json();
  if (!options.output.empty())
    asset::savePng(compare::errorPicture(map, reference.width, reference.height), options.output);
  if (!options.json.empty()) writeText(options.json, figures.dump(2) + "\n");
  if (options.json != kStandardOutput) printOutput(text(options, figures));
}

}  // namespace jalousie::app
