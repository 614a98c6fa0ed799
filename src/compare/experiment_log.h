// The figures measured so far, on disk: one line of JSON per step, so that an interruption loses at most one step.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "compare/results.h"

namespace jalousie::compare {

/// The log's file name in the folder of a report.
inline constexpr const char* kLogName = "run.jsonl";

/// Whether the folder holds the log of an experiment, whichever it is.
bool holdsLog(const std::filesystem::path& folder);

/// Starts a new log, replacing an existing one. Errors: kWriteFailed.
void startLog(const std::filesystem::path& folder, const std::string& fingerprint);

/// Appends the results of one step. Errors: kWriteFailed.
void appendLog(const std::filesystem::path& folder, const Results& step);

/// Appends the steps of a log to `results`. A last line without a line end was cut off by an interruption: it is
/// ignored and removed from the file.
/// @return  number of steps; 0 without a log
/// Errors: kUsage if the log has another fingerprint, kMalformed, as readFile.
std::size_t readLog(const std::filesystem::path& folder, const std::string& fingerprint, Results& results);

}  // namespace jalousie::compare
