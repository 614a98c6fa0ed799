// Inserts data and pictures into the page's template.
#include "compare/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "asset/image_io.h"
#include "compare/configuration.h"
#include "compare/page_pictures.h"
#include "compare/report_folder.h"
#include "core/check.h"

namespace jalousie::compare {
namespace {

using nlohmann::ordered_json;

/// Rounds to six significant digits: more than a chart can show, in half the bytes. Null if not finite.
ordered_json shortNumber(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

ordered_json seriesJson(const Results& results, const std::string& name, std::size_t configuration) {
  const char* const keys[] = {"frame",          "triangles",        "frame_ms",     "draws", "drawn",
                              "culled_frustum", "culled_occlusion", "flip",         "psnr",  "ssim",
                              "butteraugli",    "switches",         "temporal_flip"};
  ordered_json series;
  series["name"] = name;
  for (const char* key : keys)
    series[key] = ordered_json::array();
  for (const Sample& sample : results.samples) {
    if (sample.configuration != configuration) continue;
    const render::FrameStatistics& s = sample.statistics;
    series["frame"].push_back(sample.frame);
    series["triangles"].push_back(s.triangles);
    series["frame_ms"].push_back(shortNumber(sample.frameMs));
    series["draws"].push_back(s.draws);
    series["drawn"].push_back(s.drawn);
    series["culled_frustum"].push_back(s.culledFrustum);
    series["culled_occlusion"].push_back(s.culledOcclusion);
    series["flip"].push_back(sample.error ? shortNumber(sample.error->flip) : ordered_json());
    series["psnr"].push_back(sample.error ? shortNumber(sample.error->psnr) : ordered_json());
    series["ssim"].push_back(sample.error ? shortNumber(sample.error->ssim) : ordered_json());
    const bool judged = sample.error && sample.error->butteraugli;
    series["butteraugli"].push_back(judged ? shortNumber(*sample.error->butteraugli) : ordered_json());
    series["temporal_flip"].push_back(sample.temporal ? shortNumber(*sample.temporal) : ordered_json());
    const bool counted = sample.visible.value_or(0) > 0 && sample.switched;
    series["switches"].push_back(
        counted ? shortNumber(static_cast<double>(*sample.switched) / static_cast<double>(*sample.visible))
                : ordered_json());
  }
  return series;
}

/// One kept picture.
struct Kept {
  ordered_json* target;  ///< receives its data URI
  std::filesystem::path file;
};

/// Encodes all pictures in one format. @return false as soon as they need more than `room` bytes
bool encodeAll(const std::vector<Kept>& pictures, const PictureFormat& format, std::uint64_t room) {
  std::uint64_t used = 0;
  for (const Kept& picture : pictures) {
    const std::vector<std::uint8_t> bytes = encodeWebp(asset::loadImage(picture.file), format);
    used += bytes.size();
    if (used > room) return false;
    *picture.target = dataUri(bytes);
  }
  return true;
}

/// Bytes that all pictures would need, extrapolated from every twelfth one.
double estimatedBytes(const std::vector<Kept>& pictures, const PictureFormat& format) {
  constexpr std::size_t kStride = 12;
  std::uint64_t bytes = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < pictures.size(); i += kStride, ++count)
    bytes += encodeWebp(asset::loadImage(pictures[i].file), format).size();
  return static_cast<double>(bytes) * static_cast<double>(pictures.size()) / static_cast<double>(count);
}

/// Fills the pictures' targets. @return a note on format and size for the page; empty without pictures
std::string embed(const std::vector<Kept>& pictures, std::uint64_t room, const ordered_json& summary) {
  if (pictures.empty()) return {};
  const double longest = std::max(summary.at("width").get<double>(), summary.at("height").get<double>());
  for (const PictureFormat& format : pictureFormats()) {
    if (std::lround(format.scale * longest) > kMostWebpSide) continue;
    const bool last = &format == &pictureFormats().back();
    if (!last && estimatedBytes(pictures, format) > static_cast<double>(room)) continue;
    if (!encodeAll(pictures, format, room)) continue;
    const auto side = [&](const char* key) { return std::lround(format.scale * summary.at(key).get<double>()); };
    return fmt::format("WebP, quality {:.0f}, {}x{} pixels; the folder pictures/ has them as PNG", format.quality,
                       side("width"), side("height"));
  }
  for (const Kept& picture : pictures)
    *picture.target = nullptr;
  return "The pictures are too large for one page; the folder pictures/ has them as PNG";
}

/// The page's list of kept frames. @param pictures  receives their pictures, with targets in the result
ordered_json keptJson(const Results& results, const std::vector<Configuration>& configurations,
                      const std::filesystem::path& folder, std::vector<Kept>& pictures) {
  std::vector<std::uint32_t> frames;
  for (const KeptSample& sample : results.kept)
    if (std::find(frames.begin(), frames.end(), sample.frame) == frames.end()) frames.push_back(sample.frame);
  ordered_json kept = ordered_json::array();
  for (const std::uint32_t frame : frames) {
    ordered_json entry = {{"frame", frame}, {"reference", nullptr}, {"pictures", ordered_json::array()}};
    for (const Configuration& configuration : configurations) {
      entry["pictures"].push_back({{"name", configuration.name},
                                   {"image", nullptr},
                                   {"error", nullptr},
                                   {"lod", nullptr},
                                   {"subject", nullptr}});
    }
    kept.push_back(std::move(entry));
  }
  const auto add = [&](ordered_json& target, std::uint32_t frame, const std::string& name, Picture kind) {
    pictures.push_back({&target, pictureFile(folder, pictureName(frame, name, kind))});
  };
  for (const KeptSample& sample : results.kept) {
    const auto at = std::find(frames.begin(), frames.end(), sample.frame) - frames.begin();
    kept[static_cast<std::size_t>(at)]["pictures"].at(sample.configuration)["subject"] = shortNumber(sample.subject);
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    add(kept[i]["reference"], frames[i], kReferenceName, Picture::kImage);
    for (std::size_t c = 0; c < configurations.size(); ++c) {
      ordered_json& entry = kept[i]["pictures"][c];
      const std::string& name = configurations[c].name;
      add(entry["image"], frames[i], name, Picture::kImage);
      add(entry["error"], frames[i], name, Picture::kError);
      add(entry["lod"], frames[i], name, Picture::kLod);
    }
  }
  return kept;
}

/// Escapes JSON so that it can stand inside a script element.
std::string scriptSafe(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

/// Replaces a marker of the template. @pre the page has it (checked)
void fill(std::string& page, std::string_view marker, std::string_view content) {
  const std::size_t at = page.find(marker);
  JAL_CHECK(at != std::string::npos);
  page.replace(at, marker.size(), content);
}

}  // namespace

std::string makePage(const ordered_json& summary, const Results& results,
                     const std::vector<Configuration>& configurations, const std::filesystem::path& folder,
                     std::uint64_t pictureBytes) {
  ordered_json data;
  data["summary"] = summary;
  data["series"] = ordered_json::array();
  for (std::size_t c = 0; c < configurations.size(); ++c)
    data["series"].push_back(seriesJson(results, configurations[c].name, c));
  std::vector<Kept> pictures;
  ordered_json kept = keptJson(results, configurations, folder, pictures);
  data["pictures_note"] = embed(pictures, pictureBytes, summary);
  data["kept"] = std::move(kept);

  std::string page(pageHtml());
  // From the end of the page to its start, so that no marker is looked for in inserted text.
  fill(page, "/*SCRIPT*/", pageScript());
  fill(page, "/*DATA*/", scriptSafe(data.dump(-1, ' ', false, ordered_json::error_handler_t::replace)));
  fill(page, "/*CHARTS*/", chartsScript());
  fill(page, "/*STYLE*/", pageStyle());
  return page;
}

}  // namespace jalousie::compare
