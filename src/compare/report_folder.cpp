// A file belongs to the report if its name is one that the report itself gives.
#include "compare/report_folder.h"

#include <fmt/format.h>

#include <system_error>
#include <vector>

#include "core/error.h"

namespace jalousie::compare {
namespace {

constexpr const char* kPictures = "pictures";
constexpr const char* kReferences = "references";

/// Whether a file is one that pictureName() names.
bool isPicture(const std::string& name) {
  const bool digits = name.size() > 5 && name.find_first_not_of("0123456789") >= 5;
  return digits && (name.ends_with("-image.png") || name.ends_with("-error.png") || name.ends_with("-lod.png"));
}

/// Whether a file is one that referenceFile() names: KEY-FRAME.png, with a key of 16 digits.
bool isReference(const std::string& name) {
  return name.size() >= 26 && name[16] == '-' && name.find_first_not_of("0123456789abcdef") == 16 &&
         name.ends_with(".png");
}

void removeFiles(const std::filesystem::path& folder, const auto& isOld) {
  std::error_code error;
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (isOld(entry.path().filename().string())) old.push_back(entry.path());
  for (const std::filesystem::path& file : old)
    std::filesystem::remove(file, error);
}

}  // namespace

std::string pictureName(std::uint32_t frame, const std::string& configuration, Picture picture) {
  std::string name;
  for (const char c : configuration) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '+' || c == '-';
    name += plain ? c : '_';
  }
  const char* const kinds[] = {"image", "error", "lod"};
  return fmt::format("{:05}-{}-{}.png", frame, name, kinds[static_cast<int>(picture)]);
}

std::filesystem::path pictureFile(const std::filesystem::path& folder, const std::string& name) {
  return folder / kPictures / name;
}

std::filesystem::path referenceFile(const std::filesystem::path& folder, const std::string& key, std::uint32_t frame) {
  return folder / kReferences / fmt::format("{}-{:05}.png", key, frame);
}

void makePictureFolders(const std::filesystem::path& folder) {
  for (const char* name : {kPictures, kReferences}) {
    std::error_code error;
    std::filesystem::create_directories(folder / name, error);
    if (error) throw Error(ErrorCode::kWriteFailed, error.message(), folder / name);
  }
}

void removeOldPictures(const std::filesystem::path& folder, const std::string& key) {
  removeFiles(folder / kPictures, isPicture);
  removeFiles(folder / kReferences,
              [&](const std::string& name) { return isReference(name) && !name.starts_with(key); });
}

}  // namespace jalousie::compare
