// The folder of a report: which folders are taken, the lock on it, names of its pictures, and the removal of those that
// an earlier experiment left.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/folder_lock.h"

namespace jalousie::compare {

enum class Picture { kImage, kError, kLod };

/// The folder of a report while a run uses it. No other run can use it meanwhile; the kernel releases the lock when the
/// run ends, however it ends.
class ReportFolder {
 public:
  /// Checks the folder before the run's work: it may be missing or be empty.
  /// @param mayHoldReport  it may also hold a report, which is replaced or continued
  /// Errors: kUsage if it holds other files, or a report that must stay; kWriteFailed if it cannot be created or
  /// written, or another run is using it.
  ReportFolder(std::filesystem::path path, bool mayHoldReport);
  /// Creates it if it is missing, and removes unfinished files of killed runs. Errors: as the constructor.
  void create();

 private:
  void lock();

  std::filesystem::path path_;
  bool mayHoldReport_;
  std::optional<FolderLock> lock_;  ///< absent: the folder does not exist yet
};

/// The reference's name among those of the configurations.
inline constexpr const char* kReferenceName = "reference";

/// File name of a kept picture, such as "00120-default-image.png". Characters outside [A-Za-z0-9.+-] become '_', so two
/// configurations can get the same file name.
std::string pictureName(std::uint32_t frame, const std::string& configuration, Picture picture);

/// Path of a kept picture: pictures/ and its name.
std::filesystem::path pictureFile(const std::filesystem::path& folder, const std::string& name);

/// Path of a cached picture of the reference. @param key  referenceFingerprint(), 16 hexadecimal digits
std::filesystem::path referenceFile(const std::filesystem::path& folder, const std::string& key, std::uint32_t frame);

/// Creates pictures/ and references/ where they are missing. Errors: kWriteFailed.
void makePictureFolders(const std::filesystem::path& folder);

/// Removes all kept pictures, and the references of other experiments. Other files stay.
/// @param key  of the references to keep
void removeOldPictures(const std::filesystem::path& folder, const std::string& key);

}  // namespace jalousie::compare
