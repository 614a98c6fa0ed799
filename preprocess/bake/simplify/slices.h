// How loops over independent elements are run: the caller decides on the threads.
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

}  // namespace jalousie::bake
