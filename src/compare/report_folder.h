// Names of the picture files in a report's folder, and the removal of those that an earlier experiment left.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace jalousie::compare {

enum class Picture { kImage, kError, kLod };

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
