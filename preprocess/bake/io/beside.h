// Reads the files that an input names: materials and pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asset/gltf_file.h"
#include "core/confined_folder.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::bake {

/// Files beside an input, which the input names.
class Beside {
 public:
  Beside(const std::filesystem::path& file, std::uint64_t maxBytes, const asset::ReadObserver& observer)
      : file_(file), maxBytes_(maxBytes), observer_(observer) {}

  std::optional<std::vector<std::byte>> read(const std::string& name) {
    std::optional<std::vector<std::byte>> content;
    try {
      if (!folder_) folder_.emplace(folderOf(file_));
      content = folder_->readFile(name, maxBytes_);
    } catch (const Error&) {
      content.reset();  // reported as absent: the result changes once the file can be read
    }
    if (observer_) observer_(name, content ? std::optional<std::span<const std::byte>>(*content) : std::nullopt);
    return content;
  }

 private:
  const std::filesystem::path& file_;
  std::uint64_t maxBytes_;
  const asset::ReadObserver& observer_;
  std::optional<ConfinedFolder> folder_;
};

}  // namespace jalousie::bake
