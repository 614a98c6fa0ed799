// What all programs check about their output files before they work, and how they write text.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace jalousie {

/// Name of standard output as the value of an option.
inline constexpr const char* kStandardOutput = "-";

/// A file that an option names.
struct NamedFile {
  std::string option;          ///< "-o", for messages
  std::filesystem::path path;  ///< empty: the option is not given
  bool mayBeStdout = false;    ///< "-" means standard output
};

/// Checks output files before the work that fills them. Whether a disk is full shows only later.
/// Errors: kUsage if two outputs are one file, if an output is also an input, or if "-" is given where standard output
/// is not possible; kWriteFailed if an output is a folder, or its folder is missing or cannot be written.
void checkOutputs(std::span<const NamedFile> outputs, std::span<const std::filesystem::path> inputs);

/// Writes text to a file as writeFileAtomic does, or to standard output if the path is "-". Errors: kWriteFailed.
void writeText(const std::filesystem::path& path, std::string_view text);

}  // namespace jalousie
