#include "common/runtime/search_worker.h"

#include <algorithm>
#include <utility>

#include "common/runtime/scheduling.h"

namespace puck {
namespace {

// Pixels per copy: some 10 µs.
constexpr int kPixelsPerCopy = 65'536;

// Pixels searched on the caller's thread: some 200 µs; or, for an urgent search, some 4 ms, a fifth
// of the heartbeat period.
constexpr int kSmallPixels = 24'576;
constexpr int kUrgentPixels = 400'000;

}  // namespace

SearchWorker::SearchWorker(PuckSearch search) : search_(std::move(search)) {
  const Region all = search_.snapshot_region({0, 0, SensorSize::kMax, SensorSize::kMax});
  snapshot_.grey.reserve(all.width, all.height);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

SearchWorker::~SearchWorker() {
  thread_.request_stop();
  posted_.release();
}

bool SearchWorker::is_small(const SearchRequest& request) const {
  const Region copied = search_.snapshot_region(request.region);
  return copied.width * copied.height <= kSmallPixels;
}

void SearchWorker::begin(const SearchRequest& request, bool is_urgent) {
  request_ = request;
  caller_pixels_ = is_urgent ? kUrgentPixels : kSmallPixels;
  snapshot_.region = search_.snapshot_region(request.region);
  snapshot_.grey.resize(snapshot_.region.width, 0);
  stage_ = Stage::kCopying;
}

void SearchWorker::copy_more(SharedSurface& surface) {
  const Region& all = snapshot_.region;
  const int copied = snapshot_.grey.height();  // The image's height is the number of copied rows.
  const int at_once = std::max(1, kPixelsPerCopy / std::max(1, all.width));
  const int rows = std::min(at_once, all.height - copied);
  snapshot_.grey.resize(all.width, copied + rows);
  surface.copy_part({all.x, all.y + copied, all.width, rows}, request_.fresh_only, snapshot_);
  if (copied + rows < all.height) return;
  stage_ = Stage::kSearching;
  if (all.width * all.height <= caller_pixels_) {
    search();
  } else {
    posted_.release();
  }
}

const SearchResult* SearchWorker::poll() {
  if (stage_ != Stage::kSearching || !done_.load(std::memory_order_acquire)) return nullptr;
  // Relaxed: the next search is posted after it.
  done_.store(false, std::memory_order_relaxed);
  stage_ = Stage::kIdle;
  return &result_;
}

void SearchWorker::run(const std::stop_token& stop) {
  take_turns_behind_others();
  while (true) {
    posted_.acquire();
    if (stop.stop_requested()) return;
    search();
  }
}

void SearchWorker::search() {
  result_ = search_.search(snapshot_, request_);
  done_.store(true, std::memory_order_release);
}

}  // namespace puck
