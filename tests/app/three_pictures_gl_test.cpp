// Pictures of jalousie render beside those of three.js: texture placement, colours, poses and cameras mean the same.
//
// JALOUSIE_PICTURE_SHEET=FILE.png writes the pairs of pictures, ours on the left.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "asset/image_io.h"
#include "core/file.h"
#include "support/node.h"
#include "support/run_program.h"

namespace jalousie {
namespace {

using nlohmann::json;
using test::ProgramResult;

constexpr const char* kSize = "192x144";
constexpr std::array<std::uint8_t, 3> kBackground = {0x85, 0x93, 0xA2};
constexpr const char* kBackgroundText = "8593a2";

/// Share of the covered pixels that one picture covers and the other does not. Rasterisers decide differently about
/// pixels on an edge, and a float key of a spline moves it by half a pixel.
constexpr double kMostSilhouette = 0.015;
/// Mean absolute difference of a channel over the pixels that both cover, 0 to 255. Colours of inclined squares differ
/// by the rounding of texture coordinates.
constexpr double kMostDifference = 1.0;

struct Agreement {
  double silhouette = 0.0;
  double difference = 0.0;
  std::size_t covered = 0;  ///< pixels of either picture
};

Agreement agreementOf(const ImageRgba8& a, const ImageRgba8& b) {
  Agreement agreement;
  std::size_t both = 0;
  std::size_t one = 0;
  double sum = 0.0;
  for (std::size_t at = 0; at < a.pixels.size(); at += 4) {
    const auto shows = [&](const ImageRgba8& image) {
      return !std::equal(kBackground.begin(), kBackground.end(), &image.pixels[at]);
    };
    if (!shows(a) && !shows(b)) continue;
    ++agreement.covered;
    if (shows(a) != shows(b)) {
      ++one;
      continue;
    }
    ++both;
    for (std::size_t c = 0; c < 3; ++c)
      sum += std::abs(int{a.pixels[at + c]} - int{b.pixels[at + c]}) / 3.0;
  }
  if (agreement.covered > 0) agreement.silhouette = static_cast<double>(one) / static_cast<double>(agreement.covered);
  if (both > 0) agreement.difference = sum / static_cast<double>(both);
  return agreement;
}

/// The pairs of pictures, four in a row.
void writeSheet(const std::vector<ImageRgba8>& pictures, const std::string& file) {
  constexpr std::uint32_t kColumns = 8;
  const std::uint32_t width = pictures.front().width;
  const std::uint32_t height = pictures.front().height;
  const auto rows = static_cast<std::uint32_t>((pictures.size() + kColumns - 1) / kColumns);
  ImageRgba8 sheet{kColumns * width, rows * height, {}};
  sheet.pixels.assign(std::size_t{4} * sheet.width * sheet.height, 255);
  for (std::uint32_t i = 0; i < pictures.size(); ++i)
    for (std::uint32_t y = 0; y < height; ++y)
      std::copy_n(&pictures[i].pixels[pictures[i].offset(0, y)], std::size_t{4} * width,
                  &sheet.pixels[sheet.offset(i % kColumns * width, i / kColumns * height + y)]);
  asset::savePng(sheet, file);
}

std::string pointText(const json& point) {
  return std::to_string(point[0].get<double>()) + "," + std::to_string(point[1].get<double>()) + "," +
         std::to_string(point[2].get<double>());
}

ProgramResult render(const json& drawn, const std::string& folder) {
  const std::string name = folder + "/" + drawn["name"].get<std::string>();
  std::vector<std::string> words = {"render", name + ".glb", "-o",     name + ".png", "--size",
                                    kSize,    "--lod",       "finest", "-q"};
  const auto add = [&](const char* option, const std::string& value) { words.insert(words.end(), {option, value}); };
  if (drawn.contains("time")) add("--time", std::to_string(drawn["time"].get<double>()));
  if (drawn.contains("camera")) add("--camera", drawn["camera"].get<std::string>());
  if (drawn.contains("frame")) add("--frame", std::to_string(drawn["frame"].get<int>()));
  if (drawn.contains("eye")) add("--eye", pointText(drawn["eye"]));
  if (drawn.contains("look")) add("--look", pointText(drawn["look"]));
  return test::runProgram(JALOUSIE_PROGRAM, words);
}

TEST(ThreePictures, AgreeOnPlacementColoursPosesAndCameras) {
  const std::string three = JALOUSIE_SOURCE_DIR "/assets/fetched/three";
  if (!std::filesystem::exists(three)) GTEST_SKIP() << "assets/fetch three gets three.js from the npm registry";
  const std::optional<std::filesystem::path> node = test::findNode();
  if (!node) GTEST_SKIP() << "there is no Node.js";
  const test::TemporaryFolder folder;
  const std::string path = folder.path().string();
  const std::string scripts = JALOUSIE_SOURCE_DIR "/tests/project/";
  ASSERT_EQ(test::runProgram(*node, {scripts + "picture_cases.mjs", path}).exitCode, 0);
  const ProgramResult drawn =
      test::runProgram(*node, {scripts + "three_pictures.mjs", three, path, kSize, kBackgroundText});
  if (drawn.exitCode == 77) GTEST_SKIP() << drawn.standardOutput;
  ASSERT_EQ(drawn.exitCode, 0) << drawn.standardOutput << drawn.standardError;
  const std::vector<std::byte> text = readFile(folder / "cases.json", 1U << 20U);
  const json cases =
      json::parse(reinterpret_cast<const char*>(text.data()), reinterpret_cast<const char*>(text.data()) + text.size());
  EXPECT_GE(cases.size(), 25U);
  std::vector<ImageRgba8> pictures;
  std::size_t covering = 0;
  for (const json& one : cases) {
    SCOPED_TRACE(one["name"].get<std::string>());
    const ProgramResult ours = render(one, path);
    if (ours.exitCode == 9) GTEST_SKIP() << "no OpenGL here: " << ours.standardError;
    ASSERT_EQ(ours.exitCode, 0) << ours.standardError;
    for (const char* ending : {".png", ".three.png"})
      pictures.push_back(asset::loadImage(folder / (one["name"].get<std::string>() + ending)));
    const Agreement agreement = agreementOf(pictures[pictures.size() - 2], pictures.back());
    EXPECT_LT(agreement.silhouette, kMostSilhouette);
    EXPECT_LT(agreement.difference, kMostDifference);
    covering += agreement.covered > 1000 ? 1 : 0;
  }
  EXPECT_EQ(covering + 1, cases.size()) << "all but the hidden back cover a part of the picture";
  if (const char* sheet = std::getenv("JALOUSIE_PICTURE_SHEET")) writeSheet(pictures, sheet);
}

}  // namespace
}  // namespace jalousie
