// Work shared among threads.
#pragma once

#include <cstddef>
#include <functional>

namespace jalousie::bake {

/// How many threads forSlices may use in this process; 0: all cores.
void setThreads(unsigned count);

/// Calls work(begin, end) for slices of [0, count) on several threads; which slice a thread gets does not matter to
/// callers that write to their own elements only. Throws what the first failing slice threw.
void forSlices(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace jalousie::bake
