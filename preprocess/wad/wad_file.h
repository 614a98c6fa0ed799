// The directory of a WAD file, and the numbers and names in its lumps. Every offset is checked.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jalousie::wad {

/// Little-endian numbers of a lump. Errors: kMalformed where the lump ends before.
class LumpReader {
 public:
  LumpReader(std::span<const std::byte> bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  std::size_t size() const { return bytes_.size(); }
  std::uint8_t byteAt(std::size_t offset) const;
  std::int32_t int16At(std::size_t offset) const;
  std::uint32_t uint16At(std::size_t offset) const;
  std::uint32_t uint32At(std::size_t offset) const;
  /// Up to eight characters, in capitals; ends before a zero byte. Others than printable ASCII become '?'.
  std::string nameAt(std::size_t offset) const;

 private:
  void require(std::size_t offset, std::size_t count) const;

  std::span<const std::byte> bytes_;
  std::string name_;
};

/// A file in memory.
class WadFile {
 public:
  static constexpr std::uint64_t kMostBytes = 1ULL << 28U;
  static constexpr std::uint32_t kMostLumps = 1U << 17U;

  /// Errors: kUnsupported (no WAD file), kMalformed (a lump outside of the file), kLimit.
  explicit WadFile(std::vector<std::byte> bytes);

  std::size_t count() const { return lumps_.size(); }
  const std::string& nameOf(std::size_t lump) const { return lumps_[lump].name; }
  LumpReader read(std::size_t lump) const;
  /// The last lump of a name: later ones replace earlier ones.
  std::optional<std::size_t> find(std::string_view name) const;

 private:
  struct Lump {
    std::string name;
    std::uint32_t offset = 0;
    std::uint32_t size = 0;
  };
  std::vector<std::byte> bytes_;
  std::vector<Lump> lumps_;
};

}  // namespace jalousie::wad
