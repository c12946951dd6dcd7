#pragma once

#include <atomic>
#include <cstdint>
#include <semaphore>
#include <thread>

#include "common/runtime/shared_surface.h"
#include "common/vision/puck_search.h"
#include "common/vision/surface_snapshot.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

/// A thread of low priority that searches copies of the surface, so that a search never delays the
/// tracking, however long it takes. One search at a time, in three steps:
///
///  1. begin(), with what is wanted.
///  2. copy_more() as long as is_copying(). The tracking goes on in between.
///  3. poll() until there is the result.
///
/// A search that takes no longer than a few steps of the tracking is made at once, on the caller's
/// thread, so that what is near is not looked at too late. By whoever makes the step (see
/// SharedSurface). Nothing here waits for the worker, which holds no lock.
class SearchWorker {
 public:
  /// Starts the thread.
  explicit SearchWorker(PuckSearch search);
  /// Stops the thread and waits for it: a search that has begun is finished.
  ~SearchWorker();
  SearchWorker(const SearchWorker&) = delete;
  SearchWorker& operator=(const SearchWorker&) = delete;

  /// True when a search may begin: none has, or its result has been taken.
  bool is_idle() const { return stage_ == Stage::kIdle; }
  /// True while the surface is being copied for the search.
  bool is_copying() const { return stage_ == Stage::kCopying; }

  /// True for a search that is made at once, urgent or not. Only when idle.
  bool is_small(const SearchRequest& request) const;

  /// Begins a search, whose region is not empty. Only when idle. `is_urgent`: there is no track
  /// that could be delayed, so that all but a very large image is searched at once, however busy
  /// the machine is.
  void begin(const SearchRequest& request, bool is_urgent = false);

  /// Copies the next few rows; with the last ones the search starts, or, if it is small, is made.
  /// Only while copying. A few rows at a time, because both the event and the tracking thread stand
  /// still meanwhile; between the first and the last ones the puck moves on by a pixel at most.
  void copy_more(SharedSurface& surface);

  /// The result once there is one, which lasts until the next search begins; nullptr before.
  const SearchResult* poll();

 private:
  enum class Stage : std::uint8_t { kIdle, kCopying, kSearching };

  void run(const std::stop_token& stop);
  void search();

  Stage stage_ = Stage::kIdle;  // whoever makes the step
  int at_once_pixels_ = 0;      // whoever makes the step

  // Of whoever makes the step until it releases `posted_`; then the worker's until it sets `done_`.
  PuckSearch search_;
  SurfaceSnapshot snapshot_;
  SearchRequest request_;
  SearchResult result_;
  std::counting_semaphore<2> posted_{0};  // one for a search, one for the end
  // Set with release after the result is written, seen with acquire before it is read.
  std::atomic<bool> done_{false};

  std::jthread thread_;  // last: it uses what stands above
};

}  // namespace puck
