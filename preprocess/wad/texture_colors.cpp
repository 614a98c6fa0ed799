// Flats are 64 x 64 bytes; patches have columns of posts; textures are lists of patches.
#include "wad/texture_colors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"

namespace jalousie::wad {
namespace {

constexpr std::size_t kFlatBytes = 64 * 64;
constexpr std::uint32_t kMostTextures = 1U << 16U;
constexpr std::uint32_t kMostPixels = 1U << 22U;  // of one patch
constexpr glm::vec3 kGrey(0.2F);

float linear(std::uint8_t value) {
  const float share = static_cast<float>(value) / 255.0F;
  return share <= 0.04045F ? share / 12.92F : std::pow((share + 0.055F) / 1.055F, 2.4F);
}

/// Sum of colours.
struct ColorSum {
  glm::dvec3 sum{0.0};
  std::uint64_t count = 0;

  void add(const glm::vec3& color) {
    sum += glm::dvec3(color);
    ++count;
  }
  glm::vec3 mean() const { return count > 0 ? glm::vec3(sum / static_cast<double>(count)) : kGrey; }
};

/// The posts of a patch: each has a row, a length and bytes between two that are not used; 255 ends a column.
glm::vec3 meanOfPosts(const LumpReader& reader, const std::array<glm::vec3, 256>& palette) {
  ColorSum sum;
  const std::uint32_t width = reader.uint16At(0);
  for (std::uint32_t column = 0; column < width; ++column) {
    std::size_t at = reader.uint32At(8 + std::size_t{4} * column);
    while (reader.byteAt(at) != 255 && sum.count < kMostPixels) {
      const std::size_t length = reader.byteAt(at + 1);
      for (std::size_t i = 0; i < length; ++i)
        sum.add(palette[reader.byteAt(at + 3 + i)]);
      at += length + 4;
    }
    if (sum.count >= kMostPixels) break;
  }
  return sum.mean();
}

}  // namespace

TextureColors::TextureColors(const WadFile& wad) : wad_(wad) {
  palette_.fill(kGrey);
  try {
    if (const std::optional<std::size_t> lump = wad.find("PLAYPAL")) {
      const LumpReader reader = wad.read(*lump);
      for (std::size_t i = 0; i < palette_.size(); ++i)
        palette_[i] = {linear(reader.byteAt(3 * i)), linear(reader.byteAt(3 * i + 1)),
                       linear(reader.byteAt(3 * i + 2))};
    }
    if (const std::optional<std::size_t> lump = wad.find("PNAMES")) {
      const LumpReader reader = wad.read(*lump);
      const std::uint32_t count = std::min(reader.uint32At(0), kMostTextures);
      for (std::uint32_t i = 0; i < count; ++i)
        patchNames_.push_back(reader.nameAt(4 + std::size_t{8} * i));
    }
    for (const char* name : {"TEXTURE1", "TEXTURE2"})
      if (const std::optional<std::size_t> lump = wad.find(name)) readTextures(wad.read(*lump));
  } catch (const Error&) {  // the rest stays grey
  }
}

void TextureColors::readTextures(const LumpReader& reader) {
  constexpr std::uint32_t kMostPatches = 256;
  const std::uint32_t count = std::min(reader.uint32At(0), kMostTextures);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t at = reader.uint32At(4 + std::size_t{4} * i);
    std::vector<std::uint32_t>& patches = patchesOf_[reader.nameAt(at)];
    patches.clear();
    const std::uint32_t patchCount = std::min(reader.uint16At(at + 20), kMostPatches);
    for (std::uint32_t p = 0; p < patchCount; ++p)
      patches.push_back(reader.uint16At(at + 26 + std::size_t{10} * p));
  }
}

glm::vec3 TextureColors::flatMean(const std::string& name) const {
  const std::optional<std::size_t> lump = wad_.find(name);
  if (!lump) return kGrey;
  const LumpReader reader = wad_.read(*lump);
  if (reader.size() < kFlatBytes) return kGrey;
  ColorSum sum;
  for (std::size_t i = 0; i < kFlatBytes; ++i)
    sum.add(palette_[reader.byteAt(i)]);
  return sum.mean();
}

glm::vec3 TextureColors::patchMean(std::uint32_t patch) const {
  if (patch >= patchNames_.size()) return kGrey;
  const std::optional<std::size_t> lump = wad_.find(patchNames_[patch]);
  if (!lump) return kGrey;
  try {
    return meanOfPosts(wad_.read(*lump), palette_);
  } catch (const Error&) {
    return kGrey;
  }
}

glm::vec3 TextureColors::flat(const std::string& name) {
  const auto [place, isNew] = flats_.try_emplace(name, kGrey);
  if (isNew) place->second = flatMean(name);
  return place->second;
}

glm::vec3 TextureColors::wall(const std::string& name) {
  const auto [place, isNew] = walls_.try_emplace(name, kGrey);
  if (!isNew) return place->second;
  const auto patches = patchesOf_.find(name);
  if (patches == patchesOf_.end() || patches->second.empty()) return place->second;
  glm::vec3 sum(0.0F);
  constexpr std::size_t kMost = 4;
  const std::size_t count = std::min(patches->second.size(), kMost);
  for (std::size_t i = 0; i < count; ++i)
    sum += patchMean(patches->second[i]);
  place->second = sum / static_cast<float>(count);
  return place->second;
}

}  // namespace jalousie::wad
