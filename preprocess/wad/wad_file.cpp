// Header of 12 bytes, then lumps, and a directory of 16 bytes for each lump.
#include "wad/wad_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"

namespace jalousie::wad {
namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kEntryBytes = 16;
constexpr std::size_t kNameLength = 8;

char printable(char letter) {
  if (letter >= 'a' && letter <= 'z') return static_cast<char>(letter - 'a' + 'A');
  return letter > ' ' && letter < 127 ? letter : '?';
}

}  // namespace

void LumpReader::require(std::size_t offset, std::size_t count) const {
  if (offset > bytes_.size() || count > bytes_.size() - offset)
    throw Error(ErrorCode::kMalformed,
                fmt::format("{} ends after {} bytes, {} at {} were expected", name_, bytes_.size(), count, offset));
}

std::uint8_t LumpReader::byteAt(std::size_t offset) const {
  require(offset, 1);
  return static_cast<std::uint8_t>(bytes_[offset]);
}

std::uint32_t LumpReader::uint16At(std::size_t offset) const {
  require(offset, 2);
  return static_cast<std::uint32_t>(bytes_[offset]) | static_cast<std::uint32_t>(bytes_[offset + 1]) << 8U;
}

std::int32_t LumpReader::int16At(std::size_t offset) const {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(uint16At(offset)));
}

std::uint32_t LumpReader::uint32At(std::size_t offset) const {
  require(offset, 4);
  return uint16At(offset) | uint16At(offset + 2) << 16U;
}

std::string LumpReader::nameAt(std::size_t offset) const {
  require(offset, kNameLength);
  std::string name;
  for (std::size_t i = 0; i < kNameLength && bytes_[offset + i] != std::byte{0}; ++i)
    name += printable(static_cast<char>(bytes_[offset + i]));
  return name;
}

WadFile::WadFile(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {
  const LumpReader file(bytes_, "the file");
  if (file.size() < kHeaderBytes || (file.byteAt(0) != 'I' && file.byteAt(0) != 'P') || file.byteAt(1) != 'W' ||
      file.byteAt(2) != 'A' || file.byteAt(3) != 'D')
    throw Error(ErrorCode::kUnsupported, "no WAD file: it does not begin with IWAD or PWAD");
  const std::uint32_t count = file.uint32At(4);
  const std::size_t directory = file.uint32At(8);
  if (count > kMostLumps) throw Error(ErrorCode::kLimit, fmt::format("{} lumps, the limit is {}", count, kMostLumps));
  if (directory > file.size() || std::size_t{count} * kEntryBytes > file.size() - directory)
    throw Error(ErrorCode::kMalformed, "the directory lies outside of the file");
  lumps_.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t entry = directory + i * kEntryBytes;
    Lump lump{file.nameAt(entry + 8), file.uint32At(entry), file.uint32At(entry + 4)};
    if (lump.size > 0 && (lump.offset > file.size() || lump.size > file.size() - lump.offset))
      throw Error(ErrorCode::kMalformed, fmt::format("lump {} ({}) lies outside of the file", i, lump.name));
    lumps_.push_back(std::move(lump));
  }
}

LumpReader WadFile::read(std::size_t lump) const {
  const Lump& entry = lumps_[lump];
  if (entry.size == 0) return {{}, entry.name};
  return {std::span(bytes_).subspan(entry.offset, entry.size), entry.name};
}

std::optional<std::size_t> WadFile::find(std::string_view name) const {
  const auto found = std::find_if(lumps_.rbegin(), lumps_.rend(), [&](const Lump& lump) { return lump.name == name; });
  if (found == lumps_.rend()) return std::nullopt;
  return static_cast<std::size_t>(lumps_.rend() - found) - 1;
}

}  // namespace jalousie::wad
