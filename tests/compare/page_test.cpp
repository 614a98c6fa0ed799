// The report's page: it is whole whatever the data hold, and it embeds pictures as far as they fit.
#include "compare/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asset/image_io.h"
#include "compare/configuration.h"
#include "compare/page_pictures.h"
#include "compare/report_folder.h"
#include "compare/summary.h"
#include "core/error.h"
#include "core/random.h"
#include "scene/scene_names.h"
#include "support/run_program.h"

namespace jalousie::compare {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kUriHead = "data:image/webp;base64,";
constexpr std::string_view kHostileName = "</script><b>";

/// Smooth colours with some grain, as rendered pictures have them.
ImageRgba8 picture(std::uint32_t width, std::uint32_t height, std::uint64_t seed) {
  Random random(seed);
  ImageRgba8 image{width, height, {}};
  const std::uint32_t hue = random.below(128);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t grain = random.below(24);
      for (const std::uint32_t value :
           {x * 200 / width + grain, y * 200 / height + grain, hue + x / 8 % 2 * 60 + grain})
        image.pixels.push_back(static_cast<std::uint8_t>(value));
      image.pixels.push_back(255);
    }
  }
  return image;
}

constexpr std::uint32_t kWidth = 96;
constexpr std::uint32_t kHeight = 64;

/// A report's folder with the pictures of the frames 0 and 9.
class Report {
 public:
  explicit Report(const std::vector<std::string>& names) {
    plan_.range = {0, 9, 1};
    plan_.width = kWidth;
    plan_.height = kHeight;
    for (const std::string& name : names)
      configurations_.push_back({name, "--named " + name, {}, {}});
  }

  void addFrames() {
    for (std::uint32_t frame = 0; frame < 10; ++frame) {
      for (std::size_t c = 0; c < configurations_.size(); ++c) {
        Sample sample;
        sample.frame = frame;
        sample.configuration = c;
        sample.frameMs = 1.0;
        sample.statistics.triangles = 100;
        sample.error = ImageError{40.0, 0.9, 0.01, 0.02};
        sample.lost = sample.wrongPixels = c == 1 ? frame : 0;
        results_.samples.push_back(sample);
      }
    }
  }

  /// @param name  of the node that every object belongs to
  void addObjects(const std::string& name) {
    names_.nodes = std::vector<std::string>{name};
    names_.nodeOf = std::vector<std::uint32_t>(3, 0);
    for (std::size_t c = 0; c < configurations_.size(); ++c)
      results_.objects.push_back({9, c, 3, 6.0, 1.0, {{0, 0, true, 1, 0, 300, 25, 1.0, 0.5, 5.0, {}}}});
  }

  void addPictures() {
    const std::filesystem::path pictures = folder_ / "pictures";
    std::filesystem::create_directory(pictures);
    for (const std::uint32_t frame : {0U, 9U}) {
      const auto save = [&](const std::string& name, Picture kind) {
        asset::savePng(picture(kWidth, kHeight, ++seed_), pictures / pictureName(frame, name, kind));
      };
      save(kReferenceName, Picture::kImage);
      for (std::size_t c = 0; c < configurations_.size(); ++c) {
        for (const Picture kind : {Picture::kImage, Picture::kError, Picture::kLod})
          save(configurations_[c].name, kind);
        results_.kept.push_back({frame, c, 0.01, 0.1, 0.02, 0.25});
      }
    }
  }

  const std::filesystem::path& folder() const { return folder_.path(); }

  std::string page(std::uint64_t pictureBytes = kPictureBytes) const {
    const ordered_json summary = summaryJson(results_, configurations_, plan_,
                                             {"park.glb", "", "a driver", "wall", "jalousie", "1.0", {}, &names_});
    return makePage(summary, results_, configurations_, folder_.path(), pictureBytes);
  }

 private:
  test::TemporaryFolder folder_;
  Plan plan_;
  std::vector<Configuration> configurations_;
  Results results_;
  scene::SceneNames names_;
  std::uint64_t seed_ = 0;
};

std::size_t countOf(std::string_view text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size()))
    ++count;
  return count;
}

/// The data as a browser finds them: up to the first end of the element.
ordered_json dataOf(const std::string& page) {
  constexpr std::string_view kOpen = "id=\"data\">";
  const std::size_t open = page.find(kOpen);
  if (open == std::string::npos) return nullptr;
  const std::size_t begin = open + kOpen.size();
  return ordered_json::parse(page.substr(begin, page.find("</script", begin) - begin), nullptr, false);
}

/// All pictures of the data, in their order.
std::vector<ordered_json> picturesOf(const ordered_json& data) {
  std::vector<ordered_json> pictures;
  for (const ordered_json& frame : data.at("kept")) {
    pictures.push_back(frame.at("reference"));
    for (const ordered_json& entry : frame.at("pictures"))
      for (const char* key : {"image", "error", "lod"})
        pictures.push_back(entry.at(key));
  }
  return pictures;
}

/// Bytes behind a data URI.
std::size_t bytesOf(const std::string& uri) {
  const std::size_t digits = uri.size() - kUriHead.size();
  return digits / 4 * 3 - static_cast<std::size_t>(std::count(uri.end() - 2, uri.end(), '='));
}

void expectWhole(const std::string& page) {
  std::string head = page.substr(0, 15);
  std::transform(head.begin(), head.end(), head.begin(), [](unsigned char c) { return std::tolower(c); });
  EXPECT_EQ(head, "<!doctype html>");
  for (const char* marker : {"/*STYLE*/", "/*CHARTS*/", "/*DATA*/", "/*SCRIPT*/"})
    EXPECT_EQ(page.find(marker), std::string::npos) << marker;
  // Charts, data, script: nothing inside ends one of them early or opens a comment.
  EXPECT_EQ(countOf(page, "</script"), 3U);
  EXPECT_NE(page.find(pageScript()), std::string::npos);
  EXPECT_NE(page.find(pageStyle()), std::string::npos);
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_TRUE(dataOf(page).is_object());
}

TEST(Page, IsWholeWithoutAnyResult) {
  const std::string page = Report({"one"}).page();
  expectWhole(page);
  const ordered_json data = dataOf(page);
  EXPECT_TRUE(data["kept"].empty());
  EXPECT_EQ(data["pictures_note"], "");
  ASSERT_EQ(data["series"].size(), 1U);
  EXPECT_TRUE(data["series"][0]["frame"].empty());
}

TEST(Page, HoldsTheSummaryAndASeriesPerConfiguration) {
  Report report({"one", "two"});
  report.addFrames();
  const ordered_json data = dataOf(report.page());
  EXPECT_EQ(data["summary"]["scene"], "park.glb");
  ASSERT_EQ(data["series"].size(), 2U);
  for (const ordered_json& series : data["series"])
    for (const auto& [key, values] : series.items())
      EXPECT_EQ(values.size(), key == "name" ? 1U : 10U) << key;
  EXPECT_EQ(data["series"][1]["name"], "two");
  EXPECT_EQ(data["series"][1]["frame"][9], 9);
  EXPECT_EQ(data["series"][1]["psnr"][0], 40.0);
}

TEST(Page, NamesCannotLeaveTheData) {
  for (const std::string& name : {std::string(kHostileName), std::string("<!--<script>"), std::string("/*DATA*/"),
                                  std::string("]]>\"'&\\u2028")}) {
    Report report({name, "plain"});
    report.addFrames();
    report.addObjects(name);
    report.addPictures();
    const std::string page = report.page();
    EXPECT_EQ(countOf(page, "</script"), 3U) << name;
    EXPECT_EQ(page.find(kHostileName), std::string::npos);
    EXPECT_EQ(page.find("<!--<script>"), std::string::npos);
    const ordered_json data = dataOf(page);
    ASSERT_TRUE(data.is_object()) << name;
    EXPECT_EQ(data["series"][0]["name"], name) << "and arrives as it is";
    EXPECT_EQ(data["kept"][0]["pictures"][0]["name"], name);
    EXPECT_EQ(data["kept"][0]["pictures"][0]["subject"], 0.25);
    EXPECT_EQ(data["summary"]["configurations"][0]["worst_objects"]["rows"][0]["name"], name);
    EXPECT_NE(page.find(pageScript()), std::string::npos) << name;
  }
}

TEST(Page, NamesThatAreNoUtf8StillMakeAPage) {
  Report report({"caf\xE9"});
  report.addFrames();
  report.addObjects("t\xFCr");
  expectWhole(report.page());
}

TEST(Page, HoldsEveryKeptPicture) {
  Report report({"one", std::string(kHostileName)});
  report.addFrames();
  report.addPictures();
  const std::string page = report.page();
  expectWhole(page);
  const ordered_json data = dataOf(page);
  ASSERT_EQ(data["kept"].size(), 2U);
  EXPECT_EQ(data["kept"][1]["frame"], 9);
  const std::vector<ordered_json> pictures = picturesOf(data);
  ASSERT_EQ(pictures.size(), 14U);
  for (const ordered_json& picture : pictures) {
    ASSERT_TRUE(picture.is_string());
    EXPECT_TRUE(picture.get<std::string>().starts_with(kUriHead));
  }
  EXPECT_NE(data["pictures_note"].get<std::string>().find("96x64"), std::string::npos);
  EXPECT_NE(data["pictures_note"].get<std::string>().find("pictures/"), std::string::npos);
}

TEST(Page, PicturesAreThoseOfTheFolder) {
  Report report({"one"});
  report.addPictures();
  const std::vector<ordered_json> pictures = picturesOf(dataOf(report.page()));
  ASSERT_EQ(pictures.size(), 8U);
  const auto encoded = [&](std::uint32_t frame, const std::string& name, Picture kind) {
    return dataUri(encodeWebp(asset::loadImage(report.folder() / "pictures" / pictureName(frame, name, kind)),
                              pictureFormats().front()));
  };
  EXPECT_EQ(pictures[0], encoded(0, kReferenceName, Picture::kImage));
  EXPECT_EQ(pictures[1], encoded(0, "one", Picture::kImage));
  EXPECT_EQ(pictures[2], encoded(0, "one", Picture::kError));
  EXPECT_EQ(pictures[7], encoded(9, "one", Picture::kLod));
}

TEST(Page, PicturesFitIntoTheirRoom) {
  Report report({"one"});
  report.addFrames();
  report.addPictures();
  std::size_t last = report.page().size();
  for (const std::uint64_t room : {10000U, 5000U, 2500U}) {
    const std::string page = report.page(room);
    std::size_t bytes = 0;
    for (const ordered_json& picture : picturesOf(dataOf(page))) {
      ASSERT_TRUE(picture.is_string()) << room;
      bytes += bytesOf(picture.get<std::string>());
    }
    EXPECT_LE(bytes, room);
    EXPECT_LT(page.size(), last) << room;
    last = page.size();
  }
}

TEST(Page, PicturesFitIntoTheirRoomThoughTheFirstOneIsTheSmallest) {
  Report report({"one"});
  report.addPictures();
  const ImageRgba8 plain{kWidth, kHeight, std::vector<std::uint8_t>(std::size_t{4} * kWidth * kHeight, 255)};
  asset::savePng(plain, report.folder() / "pictures" / pictureName(0, kReferenceName, Picture::kImage));
  for (const std::uint64_t room : {10000U, 5000U, 2500U}) {
    std::size_t bytes = 0;
    for (const ordered_json& picture : picturesOf(dataOf(report.page(room))))
      bytes += bytesOf(picture.get<std::string>());
    EXPECT_LE(bytes, room);
    EXPECT_GT(bytes, room / 4) << "and leave little of it";
  }
}

TEST(Page, PicturesWithoutRoomStayOutsideAndTheNoteSaysSo) {
  Report report({"one", "two"});
  report.addPictures();
  const std::string page = report.page(200);
  expectWhole(page);
  EXPECT_EQ(page.find(kUriHead), std::string::npos);
  const ordered_json data = dataOf(page);
  for (const ordered_json& picture : picturesOf(data))
    EXPECT_TRUE(picture.is_null());
  EXPECT_EQ(data["pictures_note"], "The pictures are too large for one page; the folder pictures/ has them as PNG");
}

TEST(Page, MissingPictureIsAnError) {
  Report report({"one"});
  report.addPictures();
  std::filesystem::remove(report.folder() / "pictures" / pictureName(9, "one", Picture::kError));
  std::optional<ErrorCode> code;
  try {
    report.page();
  } catch (const Error& error) {
    code = error.code();
  }
  EXPECT_EQ(code, ErrorCode::kFileNotFound);
}

TEST(PagePictures, FormatsGoFromBestToSmallest) {
  const ImageRgba8 image = picture(192, 128, 3);
  std::size_t last = std::numeric_limits<std::size_t>::max();
  ASSERT_FALSE(pictureFormats().empty());
  EXPECT_EQ(pictureFormats().front().scale, 1.0);
  for (const PictureFormat& format : pictureFormats()) {
    const std::size_t size = encodeWebp(image, format).size();
    EXPECT_LT(size, last) << format.scale << " " << format.quality;
    last = size;
  }
}

/// Sides in the head of a lossy WebP file (RFC 9649, RFC 6386 9.1).
std::pair<int, int> sidesOf(const std::vector<std::uint8_t>& webp) {
  const auto word = [&](std::size_t at) { return (webp.at(at) | webp.at(at + 1) << 8) & 0x3FFF; };
  return {word(26), word(28)};
}

TEST(PagePictures, AreWebpFilesOfTheScaledSize) {
  const ImageRgba8 image = picture(101, 66, 1);
  for (const auto& [scale, sides] : {std::pair{1.0, std::pair{101, 66}}, {0.5, {51, 33}}, {0.001, {1, 1}}}) {
    const std::vector<std::uint8_t> webp = encodeWebp(image, {scale, 80.0F});
    ASSERT_GT(webp.size(), 30U);
    EXPECT_EQ(std::string(webp.begin(), webp.begin() + 4), "RIFF");
    EXPECT_EQ(std::string(webp.begin() + 8, webp.begin() + 15), "WEBPVP8");
    EXPECT_EQ(sidesOf(webp), sides) << scale;
  }
}

TEST(PagePictures, AlphaIsLeftOut) {
  ImageRgba8 image = picture(40, 30, 1);
  const std::vector<std::uint8_t> opaque = encodeWebp(image, {1.0, 80.0F});
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    image.pixels[i] = static_cast<std::uint8_t>(i);
  EXPECT_EQ(encodeWebp(image, {1.0, 80.0F}), opaque);
}

TEST(DataUri, PadsToWholeGroups) {
  const std::string head(kUriHead);
  const auto uri = [](std::string_view text) {
    return dataUri(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  };
  // RFC 4648, section 10.
  EXPECT_EQ(uri(""), head);
  EXPECT_EQ(uri("f"), head + "Zg==");
  EXPECT_EQ(uri("fo"), head + "Zm8=");
  EXPECT_EQ(uri("foo"), head + "Zm9v");
  EXPECT_EQ(uri("foobar"), head + "Zm9vYmFy");
}

TEST(DataUri, UsesTheStandardAlphabet) {
  const std::vector<std::uint8_t> high = {0xFB, 0xEF, 0xBE, 0xFF, 0xFF, 0xFF, 0x00, 0x00, 0x00};
  EXPECT_EQ(dataUri(high), std::string(kUriHead) + "++++////AAAA");
}

TEST(PictureName, HoldsNothingAFileSystemOrAPageMinds) {
  for (const std::string& name : {std::string("../../etc"), std::string(kHostileName), std::string("a b\n\"c\"")}) {
    const std::string file = pictureName(7, name, Picture::kError);
    EXPECT_EQ(file.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-"),
              std::string::npos)
        << file;
    EXPECT_TRUE(file.starts_with("00007-")) << file;
    EXPECT_TRUE(file.ends_with("-error.png")) << file;
  }
}

}  // namespace
}  // namespace jalousie::compare
