// Runs the slices of a loop, or tasks, on several threads.
#pragma once

#include "bake/simplify/slices.h"

namespace jalousie::bake {

/// A runner that uses up to `threads` threads, 0 for all cores, and at most 16. Short loops run on the calling thread.
/// If the system has no more threads, the calling thread does the work.
SliceRunner threadedSlices(unsigned threads);

/// A runner of tasks with as many threads. A thread takes the next task when it has done one. After a failure the tasks
/// of higher numbers may be left out.
TaskRunner threadedTasks(unsigned threads);

}  // namespace jalousie::bake
