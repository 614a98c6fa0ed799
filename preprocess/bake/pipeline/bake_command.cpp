// Makes the jobs, runs them and prints or writes reports.
#include "bake/pipeline/bake_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bake/io/inputs.h"
#include "bake/pipeline/batch.h"
#include "bake/pipeline/build_identity.h"
#include "bake/pipeline/cache.h"
#include "bake/pipeline/depfile.h"
#include "bake/pipeline/job_list.h"
#include "core/error.h"
#include "core/file.h"
#include "core/interruption.h"
#include "core/output_files.h"
#include "core/standard_streams.h"

namespace jalousie::bake {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::vector<BakeJob> singleJob(const CommandLine& command, const std::vector<std::string>& arguments) {
  const std::vector<InputFile> inputs = findInputs(arguments, {});
  const bool namedEach = std::all_of(arguments.begin(), arguments.end(), [&](const std::string& argument) {
    return std::any_of(inputs.begin(), inputs.end(), [&](const InputFile& input) { return input.path == argument; });
  });
  if (!namedEach)
    throw Error(ErrorCode::kUsage, fmt::format("{} is one file; to bake each input separately, name a folder: -o {}/",
                                               command.output.string(), command.output.string()));
  BakeJob job;
  for (const InputFile& input : inputs)
    job.inputs.push_back(input.path);
  job.output = command.output;
  job.sheet = command.sheet;
  return {job};
}

std::vector<BakeJob> makeJobs(const CommandLine& command) {
  std::vector<std::string> listed;
  if (!command.filesFrom.empty()) listed = readList(command.filesFrom);
  if (!isBatch(command)) {
    listed.insert(listed.begin(), command.inputs.begin(), command.inputs.end());
    if (listed.empty()) throw Error(ErrorCode::kUsage, "the list names no file", command.filesFrom);
    return singleJob(command, listed);
  }
  std::vector<InputFile> inputs = findInputs(command.inputs, {command.output, command.cache});
  const std::vector<InputFile> more = listedInputs(listed);
  inputs.insert(inputs.end(), more.begin(), more.end());
  return jobsInto(command.output, command.sheet, inputs, command.keepExtension);
}

std::map<JobStatus, std::size_t> countStatus(const BatchOutcome& outcome) {
  std::map<JobStatus, std::size_t> counts;
  for (const JobOutcome& job : outcome.jobs)
    ++counts[job.result.status];
  return counts;
}

constexpr JobStatus kAllStatus[] = {JobStatus::kBaked, JobStatus::kCached, JobStatus::kUnchanged, JobStatus::kFailed,
                                    JobStatus::kNotStarted};

std::string summaryText(const BatchOutcome& outcome) {
  const std::map<JobStatus, std::size_t> counts = countStatus(outcome);
  std::string text = fmt::format("{} files:", outcome.jobs.size());
  const char* separator = " ";
  for (const JobStatus status : kAllStatus) {
    const auto count = counts.find(status);
    if (count == counts.end()) continue;
    text += fmt::format("{}{} {}", separator, count->second,
                        status == JobStatus::kNotStarted ? "not done" : statusName(status));
    separator = ", ";
  }
  return text + "\n";
}

ordered_json failureJson(const JobFailure& failure) {
  return {{"code", static_cast<int>(failure.code)}, {"name", errorName(failure.code)}, {"message", failure.message}};
}

std::string batchJson(const std::vector<BakeJob>& jobs, const BatchOutcome& outcome) {
  ordered_json json;
  json["files"] = ordered_json::array();
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const JobOutcome& job = outcome.jobs[i];
    ordered_json entry = {{"input", jobs[i].inputs.front().string()},
                          {"output", jobs[i].output.string()},
                          {"status", statusName(job.result.status)}};
    if (job.failure) entry["error"] = failureJson(*job.failure);
    if (!job.result.report.empty()) {
      const ordered_json report = ordered_json::parse(job.result.report);
      for (const char* key : {"warnings", "meshes"})
        entry[key] = report.at(key);
    }
    json["files"].push_back(std::move(entry));
  }
  const std::map<JobStatus, std::size_t> counts = countStatus(outcome);
  for (const JobStatus status : kAllStatus)
    json["summary"][statusName(status)] = counts.contains(status) ? counts.at(status) : 0;
  json["interrupted"] = outcome.interrupted;
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

/// Writes a rule for each output, also if its input failed: the output of an earlier run depends on that input. An
/// interrupted run keeps the old depfile, which is more complete.
void writeDepfile(const CommandLine& command, const std::vector<BakeJob>& jobs, const BatchOutcome& outcome) {
  if (command.depfile.empty() || outcome.interrupted) return;
  std::string text;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const JobOutcome& job = outcome.jobs[i];
    try {
      text += depfileRule(jobs[i].output, job.failure ? jobs[i].inputs : job.result.dependencies);
    } catch (const Error& error) {
      printError(fmt::format("jalousie-bake: warning: {}", error.what()));
    }
  }
  writeFileAtomic(command.depfile, text);
}

void putReport(const CommandLine& command, const std::string& json) {
  if (!command.json.empty()) writeText(command.json, json);
}

void tellOfBatch(const CommandLine& command, const std::vector<BakeJob>& jobs, const BatchOutcome& outcome) {
  putReport(command, batchJson(jobs, outcome));
  if (command.json != kStandardOutput && !command.quiet) printOutput(summaryText(outcome));
}

void tellOfOne(const CommandLine& command, const JobResult& result) {
  if (result.status == JobStatus::kFailed || result.status == JobStatus::kNotStarted) return;
  putReport(command, result.report);
  if (command.json == kStandardOutput || command.quiet) return;
  printOutput(result.table);
  if (result.status != JobStatus::kBaked)
    printOutput(fmt::format("{}: {}\n", oneLine(command.output.string()), statusName(result.status)));
}

/// Checks what the run writes; jobsInto has compared the outputs of a batch with its inputs.
void checkFiles(const CommandLine& command, const std::vector<BakeJob>& jobs) {
  std::vector<NamedFile> outputs = {{"--json", command.json, OutputKind::kReport, true},
                                    {"--depfile", command.depfile, OutputKind::kRules}};
  std::vector<fs::path> inputs = {command.filesFrom};
  for (const BakeJob& job : jobs)
    inputs.insert(inputs.end(), job.inputs.begin(), job.inputs.end());
  if (!isBatch(command))
    outputs.insert(outputs.begin(),
                   {{"-o", command.output, OutputKind::kScene}, {"--sheet", command.sheet, OutputKind::kPage}});
  checkOutputs(outputs, inputs, command.replace);
  if (!isBatch(command) || command.replace == Replace::kAnything) return;
  for (const BakeJob& job : jobs) {
    requireReplaceable({"-o", job.output, OutputKind::kScene});
    requireReplaceable({"--sheet", job.sheet, OutputKind::kPage});
  }
}

JobSettings settingsOf(const CommandLine& command) {
  JobSettings settings;
  settings.bake = command.bake;
  settings.quantize = command.quantize;
  settings.bake.quantized = command.quantize;
  settings.compress = command.compress;
  settings.makeFolders = isBatch(command);
  settings.meshReports = !command.json.empty() || !command.cache.empty();
  settings.cache = command.cache;
  if (!command.cache.empty()) settings.identity = buildIdentity() + "\n" + command.chosen;
  return settings;
}

int exitCode(const CommandLine& command, const BatchOutcome& outcome) {
  if (outcome.interrupted) return interruptionExitCode();
  const auto failed = std::find_if(outcome.jobs.begin(), outcome.jobs.end(),
                                   [](const JobOutcome& job) { return job.failure.has_value(); });
  if (failed == outcome.jobs.end()) return 0;
  return static_cast<int>(isBatch(command) ? ErrorCode::kSomeFailed : failed->failure->code);
}

}  // namespace

int runBake(const CommandLine& command) {
  const std::vector<BakeJob> jobs = makeJobs(command);
  checkFiles(command, jobs);
  BatchOptions options;
  options.jobs = command.jobs;
  options.maxMemoryBytes = command.maxMemory;
  options.timeout = command.timeout;
  options.quiet = command.quiet;
  options.lines = isBatch(command);
  const BatchOutcome outcome = runBatch(jobs, settingsOf(command), options);
  if (!command.cache.empty() && countStatus(outcome)[JobStatus::kBaked] > 0)
    trimCache(command.cache, command.cacheLimit);
  writeDepfile(command, jobs, outcome);
  if (isBatch(command)) {
    tellOfBatch(command, jobs, outcome);
  } else {
    tellOfOne(command, outcome.jobs.front().result);
  }
  if (outcome.interrupted) {
    const std::size_t open = countStatus(outcome)[JobStatus::kNotStarted];
    printError(fmt::format("jalousie-bake: interrupted; {} of {} files are not done", open, jobs.size()));
  }
  return exitCode(command, outcome);
}

}  // namespace jalousie::bake
