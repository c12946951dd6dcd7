#pragma once

#include <atomic>
#include <cstdint>
#include <semaphore>
#include <thread>

#include "common/runtime/shared_surface.h"
#include "common/vision/interfaces/tracking_pipeline.h"
#include "common/vision/paper/puck_search.h"
#include "common/vision/surface/surface_snapshot.h"

namespace puck {

/// A low-priority thread that searches copies of the surface, so that a search never delays the
/// tracking. One search at a time, in three steps:
///
/// 1. begin() with the request.
/// 2. copy_more() while is_copying(). The tracking continues in between.
/// 3. poll() until it returns the result.
///
/// A small search, of no more than a few tracking steps, runs at once on the caller's thread, so
/// that its result is not outdated. Stepping thread only (see SharedSurface). No call waits for the
/// worker, which holds no lock.
class SearchWorker {
 public:
  /// Starts the thread.
  explicit SearchWorker(PuckSearch search);
  /// Stops the thread and waits for it, and so for a running search.
  ~SearchWorker();
  SearchWorker(const SearchWorker&) = delete;
  SearchWorker& operator=(const SearchWorker&) = delete;

  /// True before the first search and once a search's result has been taken.
  bool is_idle() const { return stage_ == Stage::kIdle; }
  /// True while the surface is being copied for the search.
  bool is_copying() const { return stage_ == Stage::kCopying; }

  /// True for a search that runs at once, urgent or not. Only when idle.
  bool is_small(const SearchRequest& request) const;

  /// Begins a search, whose region must not be empty. Only when idle. `is_urgent`: there is no
  /// track to delay, so any but a very large image is searched at once on the caller's thread.
  void begin(const SearchRequest& request, bool is_urgent = false);

  /// Copies the next few rows; with the last ones the search starts, or, if small, runs. Only while
  /// copying. A call copies only a few rows, because it blocks both threads; during a whole copy
  /// the puck moves by a pixel at most.
  void copy_more(SharedSurface& surface);

  /// The result, valid until the next search begins; nullptr while there is none.
  const SearchResult* poll();

 private:
  enum class Stage : std::uint8_t { kIdle, kCopying, kSearching };

  void run(const std::stop_token& stop);
  void search();

  Stage stage_ = Stage::kIdle;  // Stepping thread.
  int caller_pixels_ = 0;       // Stepping thread.

  // Owned by the stepping thread until it releases `posted_`, then by the worker until it sets
  // `done_`.
  PuckSearch search_;
  SurfaceSnapshot snapshot_;
  SearchRequest request_;
  SearchResult result_;
  std::counting_semaphore<2> posted_{0};  // One for a search, one for the end.
  // Set with release after the result is written, loaded with acquire before it is read.
  std::atomic<bool> done_{false};

  std::jthread thread_;  // Last member: uses the others.
};

}  // namespace puck
