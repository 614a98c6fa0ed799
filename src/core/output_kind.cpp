// Looks at the first bytes, and at the top-level keys of JSON, which is read as a stream and not kept.
#include "core/output_kind.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace jalousie {
namespace {

/// Collects which keys a document has at its top level, and ends the reading when they say which kind it is.
class TopLevelKeys : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool isObject = false;
  bool hasAsset = false;
  bool hasMeshes = false;
  bool hasCameras = false;

  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(number_integer_t /*value*/) override { return true; }
  bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
  bool string(string_t& /*value*/) override { return true; }
  bool binary(binary_t& /*value*/) override { return true; }
  bool start_object(std::size_t /*elements*/) override {
    isObject = isObject || depth_ == 0;
    ++depth_;
    return true;
  }
  bool end_object() override {
    --depth_;
    return true;
  }
  bool start_array(std::size_t /*elements*/) override {
    ++depth_;
    return true;
  }
  bool end_array() override {
    --depth_;
    return true;
  }
  bool key(string_t& key) override {
    if (depth_ != 1) return true;
    hasAsset = hasAsset || key == "asset";
    hasMeshes = hasMeshes || key == "meshes";
    hasCameras = hasCameras || key == "cameras";
    return !(hasAsset && hasMeshes);
  }
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                   const nlohmann::json::exception& /*error*/) override {
    return false;
  }

 private:
  int depth_ = 0;
};

/// @param file  at the start of a JSON text
OutputKind kindOfJson(std::istream& file) {
  TopLevelKeys keys;
  const bool isWhole = nlohmann::json::sax_parse(file, &keys, nlohmann::json::input_format_t::json, /*strict=*/false);
  const bool isEnough = keys.hasAsset && keys.hasMeshes;
  if (!keys.isObject || !(isWhole || isEnough)) return OutputKind::kAny;
  if (!keys.hasAsset) return OutputKind::kReport;
  return keys.hasCameras && !keys.hasMeshes ? OutputKind::kCameraPath : OutputKind::kScene;
}

bool startsLikePage(std::string_view text) {
  constexpr std::string_view kStart = "<!doctype html";
  return text.size() >= kStart.size() &&
         std::equal(kStart.begin(), kStart.end(), text.begin(),
                    [](char expected, char actual) { return expected == static_cast<char>(actual | 0x20); });
}

/// "target: ", without control characters before the colon.
bool startsLikeRule(std::string_view text) {
  const std::size_t colon = text.find(": ");
  return colon != std::string_view::npos && colon > 0 &&
         std::none_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(colon),
                      [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

}  // namespace

const char* nameOf(OutputKind kind) {
  constexpr std::array kNames = {"another kind of file", "a PNG picture", "a JSON report",       "a glTF scene",
                                 "a camera path",        "a page",        "a file of make rules"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::string_view extensionOf(OutputKind kind) {
  constexpr std::array<std::string_view, 7> kExtensions = {"", ".png", ".json", ".glb", ".glb", ".html", ".d"};
  return kExtensions.at(static_cast<std::size_t>(kind));
}

bool hasForeignExtension(const std::filesystem::path& file, OutputKind kind) {
  if (kind == OutputKind::kAny) return false;
  std::string extension = file.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (extension == extensionOf(kind) || (kind == OutputKind::kPage && extension == ".htm")) return false;
  constexpr std::array<std::string_view, 14> kKnown = {".png",  ".jpg",  ".jpeg", ".webp", ".bmp", ".json", ".glb",
                                                       ".gltf", ".html", ".htm",  ".obj",  ".ply", ".stl",  ".mtl"};
  return std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

OutputKind kindOfFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(4096, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  file.clear();
  constexpr std::size_t kGlbJson = 20;  // behind the header of the file and of its first chunk
  if (head.starts_with("\x89PNG\r\n\x1a\n")) return OutputKind::kPicture;
  if (head.starts_with("glTF") && head.size() > kGlbJson) {
    file.seekg(kGlbJson);
    return kindOfJson(file);
  }
  const std::size_t first = std::min(head.find_first_not_of(" \t\r\n"), head.size());
  if (head.substr(first, 1) == "{") {
    file.seekg(static_cast<std::streamoff>(first));
    return kindOfJson(file);
  }
  if (startsLikePage(head)) return OutputKind::kPage;
  return startsLikeRule(head) ? OutputKind::kRules : OutputKind::kAny;
}

}  // namespace jalousie
