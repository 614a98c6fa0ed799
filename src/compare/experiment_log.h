// What an experiment has measured so far, on disk: one line of JSON per step, so that an interruption loses one step.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "compare/experiment.h"

namespace jalousie::compare {

/// The log's name in the folder of a report.
inline constexpr const char* kLogName = "run.jsonl";

/// 16 hexadecimal digits that change with the scene's content, the camera path, size and kind of reference: what the
/// reference pictures depend on.
std::string referenceFingerprint(const scene::SceneData& scene, const asset::Camera& path, const Plan& plan);

/// The same of everything that decides an experiment's figures and steps.
std::string experimentFingerprint(const scene::SceneData& scene, const asset::Camera& path,
                                  const std::vector<Configuration>& configurations, const Plan& plan);

/// Whether the folder holds a log of ours, of whatever experiment.
bool holdsLog(const std::filesystem::path& folder);

/// 16 hexadecimal digits that change with the bytes.
std::string digestOf(std::span<const std::byte> bytes);

/// Starts a new log in folder, replacing one that is there. Errors: kWriteFailed.
void startLog(const std::filesystem::path& folder, const std::string& fingerprint);

/// Adds one step's results. Errors: kWriteFailed.
void appendLog(const std::filesystem::path& folder, const Results& step);

/// Reads the steps of a log; a last line that was cut off does not count. @return number of steps, 0 without a log
/// Errors: kUsage if the fingerprint is another one, kMalformed.
std::size_t readLog(const std::filesystem::path& folder, const std::string& fingerprint, Results& results);

/// Puts more behind.
void append(Results& results, const Results& more);

}  // namespace jalousie::compare
