// Names of the job states, as they stand in reports.
#include "bake/pipeline/bake_job.h"

namespace jalousie::bake {

const char* statusName(JobStatus status) {
  switch (status) {
    case JobStatus::kBaked:
      return "baked";
    case JobStatus::kCached:
      return "cached";
    case JobStatus::kUnchanged:
      return "unchanged";
    case JobStatus::kFailed:
      return "failed";
    case JobStatus::kNotStarted:
      break;
  }
  return "not-started";
}

}  // namespace jalousie::bake
