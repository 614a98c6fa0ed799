// Computes PSNR, SSIM, FLIP and Butteraugli of two files, prints them and writes the error map.
#include "app/diff_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "app/command_memory.h"
#include "app/number_option.h"
#include "asset/image_io.h"
#include "cli/force_option.h"
#include "cli/memory_option.h"
#include "cli/program.h"
#include "compare/butteraugli.h"
#include "core/error.h"
#include "core/file.h"
#include "core/memory_estimate.h"
#include "core/output_files.h"
#include "core/progress.h"
#include "core/standard_streams.h"

namespace jalousie::app {
namespace {

std::string text(const DiffOptions& options, const nlohmann::ordered_json& figures) {
  const nlohmann::ordered_json& psnr = figures.at("psnr");
  const auto number = [&](const char* key) { return figures.at(key).get<double>(); };
  return fmt::format(
      "FLIP         {:.6f}  mean; largest {:.4f} ({:.2f} pixels per degree)\n"
      "Butteraugli  {:.6f}  3-norm; largest {:.4f}\nSSIM         {:.6f}\nPSNR         {}\n",
      number("flip"), number("flip_largest"), options.pixelsPerDegree, number("butteraugli"),
      number("butteraugli_largest"), number("ssim"),
      psnr.is_null() ? "equal pictures" : fmt::format("{:.4f} dB", psnr.get<double>()));
}

/// Bytes of the largest picture file read.
constexpr std::uint64_t kMaxPictureBytes = 1ULL << 30U;

/// A picture that is not decoded yet.
struct EncodedPicture {
  std::filesystem::path file;
  std::vector<std::byte> bytes;
  asset::ImageSize size;

  explicit EncodedPicture(const std::filesystem::path& path)
      : file(path), bytes(readFile(path, kMaxPictureBytes)), size(asset::imageSize(bytes, {}, path)) {}
  ImageRgba8 decoded() const { return asset::decodeImage(bytes, {}, file); }
};

/// Errors: kUsage.
void checkSizes(const EncodedPicture& reference, const EncodedPicture& test) {
  const asset::ImageSize a = reference.size;
  const asset::ImageSize b = test.size;
  if (a.width != b.width || a.height != b.height) {
    throw Error(ErrorCode::kUsage,
                fmt::format("has {}x{} pixels and the reference {}x{}; pictures must have the same size to be compared",
                            b.width, b.height, a.width, a.height),
                test.file);
  }
  if (std::min(a.width, a.height) < compare::kLeastSsimSide)
    throw Error(ErrorCode::kUsage, fmt::format("has fewer than {0}x{0} pixels", compare::kLeastSsimSide),
                reference.file);
}

/// Both pictures, the decoder's copy of the second one, what FLIP and Butteraugli take one after the other, and the
/// error map as a picture.
MemoryEstimate diffNeeds(const asset::ImageSize& size, const DiffOptions& options) {
  constexpr std::uint64_t kStripBytes = 2 * 20 + 40;  // two prepared pictures, and what preparing one takes
  constexpr std::uint64_t kMapBytes = 4 + 16;         // picture and encoder
  const std::uint64_t pixels = std::uint64_t{size.width} * size.height;
  const std::uint64_t rows = std::min<std::uint64_t>(
      size.height, compare::kFlipStripRows + 2 * compare::flipMarginRows(options.pixelsPerDegree));
  MemoryEstimate needs;
  needs.add(pixels, 3 * 4, fmt::format("two pictures of {}x{} pixels", size.width, size.height));
  const std::uint64_t flipBytes = rows * size.width * kStripBytes;
  const std::uint64_t butteraugliBytes = compare::butteraugliBytes(size.width, size.height);
  needs.add(1, std::max(flipBytes, butteraugliBytes),
            flipBytes > butteraugliBytes ? "FLIP of a strip" : "Butteraugli of a tile");
  if (!options.output.empty()) needs.add(pixels, kMapBytes, "the error map");
  return needs;
}

/// FLIP of all pixels. @param picture  of the errors, appended to if not null
struct FlipFigures {
  double sum = 0.0;
  float largest = 0.0F;
};
FlipFigures measureFlip(const ImageRgba8& reference, const ImageRgba8& test, double pixelsPerDegree,
                        ImageRgba8* picture) {
  FlipFigures figures;
  Progress progress("comparing", reference.height);
  std::uint64_t rowsDone = 0;
  compare::flipStrips(reference, test, pixelsPerDegree, [&](std::span<const float> values) {
    for (const float value : values) {
      figures.sum += value;
      figures.largest = std::max(figures.largest, value);
    }
    progress.update(rowsDone += values.size() / reference.width);
    if (picture == nullptr) return;
    const auto rows = static_cast<std::uint32_t>(values.size() / reference.width);
    const ImageRgba8 strip = compare::errorPicture({values.begin(), values.end()}, reference.width, rows);
    picture->pixels.insert(picture->pixels.end(), strip.pixels.begin(), strip.pixels.end());
  });
  return figures;
}

/// The two files, which are read before their headers are. Errors: kLimit.
void requireFiles(const DiffOptions& options) {
  MemoryEstimate needs;
  for (const std::filesystem::path& file : {options.reference, options.test}) {
    std::error_code absent;
    const std::uintmax_t bytes = std::filesystem::file_size(file, absent);
    needs.add(absent ? 0 : bytes, 1, "the encoded pictures");
  }
  needs.require(options.memory, options.reference);
}

void diff(const DiffOptions& options) {
  requireFiles(options);
  const EncodedPicture encodedReference(options.reference);
  const EncodedPicture encodedTest(options.test);
  checkSizes(encodedReference, encodedTest);
  MemoryEstimate needs = diffNeeds(encodedReference.size, options);
  needs.add(encodedReference.bytes.size() + encodedTest.bytes.size(), 1, "the encoded pictures");
  needs.require(options.memory, options.reference);
  const ImageRgba8 reference = encodedReference.decoded();
  const ImageRgba8 test = encodedTest.decoded();
  ImageRgba8 map{reference.width, reference.height, {}};
  if (!options.output.empty()) map.pixels.reserve(reference.pixels.size());
  const FlipFigures flip =
      measureFlip(reference, test, options.pixelsPerDegree, options.output.empty() ? nullptr : &map);
  const compare::ButteraugliError butteraugli = compare::butteraugli(reference, test);
  const double psnr = compare::psnr(reference, test);
  nlohmann::ordered_json figures;
  figures["width"] = reference.width;
  figures["height"] = reference.height;
  figures["flip"] = flip.sum / (static_cast<double>(reference.width) * reference.height);
  figures["flip_largest"] = static_cast<double>(flip.largest);
  figures["pixels_per_degree"] = options.pixelsPerDegree;
  figures["butteraugli"] = butteraugli.mean;
  figures["butteraugli_largest"] = butteraugli.largest;
  figures["ssim"] = compare::ssim(reference, test);
  figures["psnr"] = std::isfinite(psnr) ? nlohmann::ordered_json(psnr) : nlohmann::ordered_json();
  if (!options.output.empty()) asset::savePng(map, options.output);
  if (!options.json.empty()) writeText(options.json, figures.dump(2) + "\n");
  if (options.json != kStandardOutput) printOutput(text(options, figures));
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
  cli::addForceOption(command, o.replace);
  cli::addMemoryOption(command, o.memory);
  command.footer(R"(The alpha channel is ignored. SSIM needs pictures of at least 8x8 pixels.
Examples:
  jalousie diff finest.png lod.png
  jalousie diff finest.png lod.png -o error.png --json figures.json
  jalousie diff finest.png lod.png --ppd 40
      assumes viewers who sit nearer
)");
}

void runDiff(const DiffOptions& options) {
  checkOutputs(std::vector<NamedFile>{{"-o", options.output, OutputKind::kPicture},
                                      {"--json", options.json, OutputKind::kReport, true}},
               std::vector{options.reference, options.test}, options.replace);
  cli::withFile(options.reference, [&] { diff(options); });
}

}  // namespace jalousie::app
