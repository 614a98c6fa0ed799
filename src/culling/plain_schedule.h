// Schedules over the leaves alone, front to back.
#pragma once

#include <vector>

#include "culling/query_schedule.h"

namespace jalousie::culling {

/// Draw and wait: asks for a leaf, waits, draws it if it is visible.
class WaitSchedule : public QuerySchedule {
 public:
  using QuerySchedule::QuerySchedule;

 private:
  void decide() override;
};

/// The same in batches: within a batch, leaves do not hide each other.
class BatchSchedule : public QuerySchedule {
 public:
  using QuerySchedule::QuerySchedule;

 private:
  void decide() override;
  void settle();

  std::vector<Asked> asked_;
};

/// The same, but answers never reach the CPU: the device leaves out itself what was hidden.
class DeferredSchedule : public QuerySchedule {
 public:
  using QuerySchedule::QuerySchedule;

 private:
  void decide() override;

  std::vector<QueryDevice::Conditional> batch_;
};

/// CHC without a hierarchy: every leaf asks; what was visible in the last frame is drawn without waiting for the
/// answer, which then counts for the next frame.
class CoherentFlatSchedule : public QuerySchedule {
 public:
  explicit CoherentFlatSchedule(const SpatialHierarchy& tree) : QuerySchedule(tree) {
    asked_.reserve(tree.objects.size());
  }

 private:
  void decide() override;
  void settleOldest();

  std::vector<Asked> asked_;  ///< first in, first out, from head_
  std::size_t head_ = 0;
};

}  // namespace jalousie::culling
