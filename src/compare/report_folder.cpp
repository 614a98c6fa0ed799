// A file belongs to the report if its name is one that the report itself gives.
#include "compare/report_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "compare/experiment_log.h"
#include "core/error.h"
#include "core/file.h"

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

/// Refuses a folder in which nothing can be created.
void requireWritable(const std::filesystem::path& folder) {
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(ErrorCode::kWriteFailed, fmt::format("the folder cannot be written: {}", std::strerror(errno)), folder);
}

/// The nearest folder above a missing one that exists.
std::filesystem::path existingParent(std::filesystem::path folder) {
  std::error_code error;
  folder = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(folder, error) && folder.has_relative_path())
    folder = folder.parent_path();
  return folder;
}

}  // namespace

ReportFolder::ReportFolder(std::filesystem::path path, bool mayHoldReport)
    : path_(std::move(path)), mayHoldReport_(mayHoldReport) {
  std::error_code error;
  if (std::filesystem::exists(path_, error)) {
    lock();
    return;
  }
  const std::filesystem::path parent = existingParent(path_);
  if (!std::filesystem::is_directory(parent, error))
    throw Error(ErrorCode::kWriteFailed, fmt::format("{} is not a folder", parent.string()), path_);
  requireWritable(parent);
}

void ReportFolder::lock() {
  lock_.emplace(path_);
  std::error_code error;
  const bool empty = std::filesystem::is_empty(path_, error);
  if (error) throw Error(ErrorCode::kWriteFailed, error.message(), path_);
  if (!empty && !holdsLog(path_))
    throw Error(ErrorCode::kUsage, "is not empty and holds no report; choose another folder", path_);
  if (!empty && !mayHoldReport_)
    throw Error(ErrorCode::kUsage,
                "holds a report; choose another folder, or add --force to replace it or --resume to "
                "continue it",
                path_);
  requireWritable(path_);
}

void ReportFolder::create() {
  if (!lock_) {
    std::error_code error;
    std::filesystem::create_directories(path_, error);
    if (error) throw Error(ErrorCode::kWriteFailed, error.message(), path_);
    lock();
  }
  for (const std::filesystem::path& folder : {path_, path_ / kPictures, path_ / kReferences})
    removeAbandonedFiles(folder);
}

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
