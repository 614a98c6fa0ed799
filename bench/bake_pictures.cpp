// bake_pictures: how different files of any tool look from a reference, in 26 pictures each.
//
//   bake_pictures [--sheet PNG] REFERENCE FILE[@LOD]...      prints one JSON object per FILE
//
// `silhouette`: samples that only one of both pictures covers, % of those that the reference covers. `colour`: mean
// absolute difference of red, green and blue where both are, % of the range of sRGB. `triangles`: of all instances.
// Pictures have 512 x 512 samples; each view is fitted to the reference. LOD chooses a level of files with MSFT_lod, or
// the last one of chains with fewer levels; default 0. The sheet has a row for each of three directions: the
// reference, then the files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "asset/image_io.h"
#include "asset/scene_file.h"
#include "bake/pipeline/threads.h"
#include "cli/program.h"
#include "core/error.h"
#include "picture_difference.h"

namespace {

using namespace jalousie;

constexpr std::uint32_t kSide = 256;
/// Of the sheet, among pictureDirections(): a corner, an edge and a face.
constexpr std::array<std::size_t, 3> kSheetViews = {25, 24, 13};

std::vector<ImageRgba8> picturesOf(const bench::PictureScene& scene, const std::vector<bake::RasterView>& views) {
  std::vector<ImageRgba8> pictures(views.size());
  bake::threadedTasks(0)(views.size(), [&](std::size_t i) { pictures[i] = bench::drawPicture(scene, views[i]); });
  return pictures;
}

bench::PictureScene load(const std::string& name) {
  const std::size_t at = name.rfind('@');
  const std::size_t lod = at == std::string::npos ? 0 : std::stoul(name.substr(at + 1));
  return {asset::readSceneFile(name.substr(0, at)), lod};
}

/// A sheet of equal cells on white.
class Sheet {
 public:
  explicit Sheet(std::size_t columns)
      : image_{
            static_cast<std::uint32_t>(columns) * kSide, static_cast<std::uint32_t>(kSheetViews.size()) * kSide, {}} {
    image_.pixels.assign(std::size_t{image_.width} * image_.height * 4, 255);
  }

  void add(std::size_t column, const std::vector<ImageRgba8>& pictures) {
    for (std::size_t row = 0; row < kSheetViews.size(); ++row) {
      const ImageRgba8 cell = asset::resizeImage(pictures[kSheetViews[row]], kSide, kSide, asset::ImageEdge::kClamp);
      for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
          const std::uint8_t* from = &cell.pixels[cell.offset(x, y)];
          std::uint8_t* to = &image_.pixels[image_.offset(static_cast<std::uint32_t>(column) * kSide + x,
                                                          static_cast<std::uint32_t>(row) * kSide + y)];
          for (int k = 0; k < 3; ++k)
            to[k] = static_cast<std::uint8_t>((from[k] * from[3] + 255 * (255 - from[3])) / 255);
        }
      }
    }
  }

  const ImageRgba8& image() const { return image_; }

 private:
  ImageRgba8 image_;
};

void run(const std::vector<std::string>& names, const std::string& sheetFile) {
  const bench::PictureScene reference = load(names[0]);
  if (reference.mesh().corners.empty()) throw Error(ErrorCode::kMalformed, "has no triangles", names[0]);
  const std::vector<bake::RasterView> views = bench::fittedViews(reference, kSide);
  const std::vector<ImageRgba8> expected = picturesOf(reference, views);
  Sheet sheet(names.size());
  sheet.add(0, expected);
  for (std::size_t i = 1; i < names.size(); ++i) {
    const bench::PictureScene scene = load(names[i]);
    const std::vector<ImageRgba8> pictures = picturesOf(scene, views);
    bench::PictureDifference difference;
    for (std::size_t k = 0; k < views.size(); ++k)
      difference.add(expected[k], pictures[k]);
    sheet.add(i, pictures);
    const nlohmann::ordered_json json = {{"file", names[i]},
                                         {"triangles", scene.mesh().triangles()},
                                         {"silhouette", difference.silhouettePercent()},
                                         {"colour", difference.colorPercent()}};
    fmt::print("{}\n", json.dump());
    std::fflush(stdout);
  }
  if (!sheetFile.empty()) asset::savePng(sheet.image(), sheetFile);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  std::string sheet;
  if (names.size() > 1 && names[0] == "--sheet") {
    sheet = names[1];
    names.erase(names.begin(), names.begin() + 2);
  }
  if (names.size() < 2 || names[0].starts_with("-")) {
    fmt::print(stderr,
               "usage: bake_pictures [--sheet PNG] REFERENCE FILE[@LOD]...\n"
               "example: bake_pictures dragon.glb levels.glb@1 levels.glb@2\n");
    return 2;
  }
  return cli::runProgram("bake_pictures", [&] {
    run(names, sheet);
    return 0;
  });
}
