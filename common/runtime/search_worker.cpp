#include "common/runtime/search_worker.h"

#include <algorithm>
#include <utility>

#include "common/runtime/scheduling.h"

namespace puck {
namespace {

// What is copied at once: some ten microseconds' worth.
constexpr int kPixelsAtOnce = 65'536;

// What is searched at once: some 200 µs' worth; and some 4 ms' worth, a fifth of the time between
// two heartbeats, while there is no track to be delayed and a late result would be of no use.
constexpr int kSmallPixels = 24'576;
constexpr int kBearablePixels = 400'000;

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
  at_once_pixels_ = is_urgent ? kBearablePixels : kSmallPixels;
  snapshot_.region = search_.snapshot_region(request.region);
  snapshot_.grey.resize(snapshot_.region.width, 0);
  stage_ = Stage::kCopying;
}

void SearchWorker::copy_more(SharedSurface& surface) {
  const Region& all = snapshot_.region;
  const int copied = snapshot_.grey.height();  // The picture grows with what has been copied.
  const int at_once = std::max(1, kPixelsAtOnce / std::max(1, all.width));
  const int rows = std::min(at_once, all.height - copied);
  snapshot_.grey.resize(all.width, copied + rows);
  surface.copy_part({all.x, all.y + copied, all.width, rows}, request_.fresh_only, snapshot_);
  if (copied + rows < all.height) return;
  stage_ = Stage::kSearching;
  if (all.width * all.height <= at_once_pixels_) {
    search();
  } else {
    posted_.release();
  }
}

const SearchResult* SearchWorker::poll() {
  if (stage_ != Stage::kSearching || !done_.load(std::memory_order_acquire)) return nullptr;
  // Relaxed: the worker sees it with the next search, which is posted after it.
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
