// Threads are started for each loop: this costs far less than any loop of kMinShared elements.
#include "bake/pipeline/threads.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace jalousie::bake {
namespace {

constexpr std::size_t kMaxThreads = 16;
constexpr std::size_t kMinShared = 4096;  ///< a shorter loop ends before a second thread has started

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
  {
    std::vector<std::jthread> workers;
    workers.reserve(threads);
    for (std::size_t w = 1; w < threads; ++w) {
      try {
        workers.emplace_back(slice, w);
      } catch (const std::system_error&) {
        slice(w);  // no more threads to be had
      }
    }
    slice(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace

SliceRunner threadedSlices(unsigned threads) {
  const std::size_t wanted = threads != 0 ? threads : std::thread::hardware_concurrency();
  const std::size_t used = std::clamp<std::size_t>(wanted, 1, kMaxThreads);
  return [used](std::size_t count, const SliceWork& work) { forSlices(used, count, work); };
}

}  // namespace jalousie::bake
