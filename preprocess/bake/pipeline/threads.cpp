// Threads are started for each loop: this costs far less than any loop of kMinShared elements.
#include "bake/pipeline/threads.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace jalousie::bake {
namespace {

constexpr std::size_t kMaxThreads = 16;
constexpr std::size_t kMinShared = 4096;  ///< a shorter loop ends before a second thread has started

/// Calls run(0) to run(threads - 1), each on a thread of its own as far as the system has threads.
void onThreads(std::size_t threads, const std::function<void(std::size_t)>& run) {
  std::vector<std::jthread> workers;
  workers.reserve(threads);
  for (std::size_t w = 1; w < threads; ++w) {
    try {
      workers.emplace_back(run, w);
    } catch (const std::system_error&) {
      run(w);  // no more threads to be had
    }
  }
  run(0);
}

void rethrowFirst(const std::vector<std::exception_ptr>& failures) {
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

void forSlices(std::size_t threads, std::size_t count, const SliceWork& work) {
  if (count < kMinShared || threads == 1) {
    work(0, count);
    return;
  }
  std::vector<std::exception_ptr> failures(threads);
  const auto slice = [&](std::size_t w) {
    try {
      work(count * w / threads, count * (w + 1) / threads);
    } catch (...) {
      failures[w] = std::current_exception();
    }
  };
  onThreads(threads, slice);
  rethrowFirst(failures);
}

void forTasks(std::size_t threads, std::size_t count, const std::function<void(std::size_t)>& task) {
  std::vector<std::exception_ptr> failures(count);
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> end = count;  // tasks after a failed one need not run
  onThreads(std::min(threads, count), [&](std::size_t) {
    for (std::size_t i = next++; i < end; i = next++) {
      try {
        task(i);
      } catch (...) {
        failures[i] = std::current_exception();
        std::size_t known = end;
        while (i < known && !end.compare_exchange_weak(known, i)) {
        }
      }
    }
  });
  rethrowFirst(failures);
}

std::size_t usedThreads(unsigned threads) {
  const std::size_t wanted = threads != 0 ? threads : std::thread::hardware_concurrency();
  return std::clamp<std::size_t>(wanted, 1, kMaxThreads);
}

}  // namespace

TaskRunner threadedTasks(unsigned threads) {
  return [used = usedThreads(threads)](std::size_t count, const std::function<void(std::size_t)>& task) {
    forTasks(used, count, task);
  };
}

SliceRunner threadedSlices(unsigned threads) {
  const std::size_t used = usedThreads(threads);
  return [used](std::size_t count, const SliceWork& work) { forSlices(used, count, work); };
}

}  // namespace jalousie::bake
