// How loops over independent elements and tasks are run: the caller decides on the threads.
#pragma once

#include <cstddef>
#include <functional>

namespace jalousie::bake {

/// Handles the elements [begin, end). Writes to these elements only.
using SliceWork = std::function<void(std::size_t begin, std::size_t end)>;

/// Calls work on slices that cover [0, count) once, in any order and on any threads, and returns when all are done.
/// Results do not depend on the slices. Throws what the first failing slice threw.
using SliceRunner = std::function<void(std::size_t count, const SliceWork& work)>;

/// The runner without threads: one slice, on the calling thread.
inline void runInOneSlice(std::size_t count, const SliceWork& work) {
  work(0, count);
}

/// Runs task(0) to task(count - 1) once each, in any order and on any threads, and returns when all are done. Tasks may
/// differ in size. Throws what the failing task of the lowest number threw.
using TaskRunner = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// The runner without threads: one task after the other, on the calling thread.
inline void runInOrder(std::size_t count, const std::function<void(std::size_t)>& task) {
  for (std::size_t i = 0; i < count; ++i)
    task(i);
}

}  // namespace jalousie::bake
