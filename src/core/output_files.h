// What all programs check about their output files before they work, and how they write text.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/output_kind.h"

namespace jalousie {

/// Name of standard output as the value of an option.
inline constexpr const char* kStandardOutput = "-";

/// A file that an option names.
struct NamedFile {
  std::string option;                  ///< "-o", for messages
  std::filesystem::path path;          ///< empty: the option is not given
  OutputKind kind = OutputKind::kAny;  ///< what will be written; kAny: may replace anything
  bool mayBeStdout = false;            ///< "-" means standard output
};

/// Whether an output may replace a file of another kind (--force).
enum class Replace { kSameKind, kAnything };

/// Checks output files before the work that fills them. Whether a disk is full shows only later.
/// Errors: kUsage if two outputs are one file, if an output is also an input, if it would replace a file of another
/// kind or its name has the extension of another kind (not with kAnything), or if "-" is given where standard output is
/// not possible; kWriteFailed if an output is a folder, or its folder is missing or cannot be written.
void checkOutputs(std::span<const NamedFile> outputs, std::span<const std::filesystem::path> inputs,
                  Replace replace = Replace::kSameKind);

/// The part of checkOutputs that keeps files of another kind. An empty file, a device and a pipe can be written.
/// Errors: kUsage.
void requireReplaceable(const NamedFile& output);

/// Writes text to a file as writeFileAtomic does, or to standard output if the path is "-". Errors: kWriteFailed.
void writeText(const std::filesystem::path& path, std::string_view text);

}  // namespace jalousie
