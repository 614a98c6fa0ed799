// What a scheduler of occlusion queries works on: OpenGL in the renderer, a software raster in tests.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>

#include "culling/query_figures.h"

namespace jalousie::culling {

/// Draws and asks in the order of the calls. Counts what it is told.
class QueryDevice {
 public:
  using Query = std::uint32_t;
  /// A query that is out.
  struct Ticket {
    Query query = 0;
    std::uint64_t order = 0;  ///< how many queries had been asked with this one
  };

  virtual ~QueryDevice() = default;

  /// Starts a query: how many samples of these nodes' boxes pass the depth test against what is drawn so far, boxes
  /// grown by queryGrowth. Several boxes may count a sample more than once. @pre at most capacity() queries unanswered
  Ticket ask(std::span<const std::uint32_t> nodes) {
    if (asking_ != 1) ++figures_.querySwitches;
    asking_ = 1;
    ++figures_.queries;
    figures_.queryBoxes += nodes.size();
    const Stopwatch watch(*this);
    return {startQuery(nodes), ++asked_};
  }
  /// Waits for an answer and takes the query back.
  std::uint64_t answer(const Ticket& ticket) {
    if (ticket.order > finished_) {
      ++figures_.queryWaits;
      if (ticket.order == asked_) ++figures_.queryRoundTrips;
      finished_ = ticket.order;
    }
    const Stopwatch watch(*this);
    return takeAnswer(ticket.query);
  }
  /// Draws the objects at these places of the hierarchy's order.
  void draw(std::uint32_t first, std::uint32_t count) {
    if (asking_ == 1) ++figures_.querySwitches;
    asking_ = 0;
    ++figures_.slices;
    const Stopwatch watch(*this);
    drawObjects(first, count);
  }
  /// What is drawn if more samples pass than the threshold that the device was made for.
  struct Conditional {
    Query query;
    std::uint32_t first;
    std::uint32_t count;
  };
  /// Draws each range whose query found it visible, and takes the queries back. Nobody waits for the answers.
  void drawWhereVisible(std::span<const Conditional> ranges) {
    if (asking_ == 1) ++figures_.querySwitches;
    asking_ = 0;
    figures_.slices += ranges.size();
    const Stopwatch watch(*this);
    drawConditionally(ranges);
  }
  /// Most queries that may be unanswered at a time.
  virtual std::uint32_t capacity() const = 0;

  QueryFigures& figures() { return figures_; }
  /// Time spent in the device since it was made.
  std::chrono::nanoseconds timeInside() const { return inside_; }

 protected:
  virtual Query startQuery(std::span<const std::uint32_t> nodes) = 0;
  virtual std::uint64_t takeAnswer(Query query) = 0;
  virtual void drawConditionally(std::span<const Conditional> ranges) = 0;
  virtual void drawObjects(std::uint32_t first, std::uint32_t count) = 0;

 private:
  /// Adds the time of a scope to timeInside().
  class Stopwatch {
   public:
    explicit Stopwatch(QueryDevice& device) : device_(device), start_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() { device_.inside_ += std::chrono::steady_clock::now() - start_; }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

   private:
    QueryDevice& device_;
    std::chrono::steady_clock::time_point start_;
  };

  QueryFigures figures_;
  std::chrono::nanoseconds inside_{0};
  std::uint64_t asked_ = 0;  ///< since the device was made
  std::uint64_t finished_ = 0;
  int asking_ = 0;
};

}  // namespace jalousie::culling
