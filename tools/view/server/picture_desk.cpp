#include "tools/view/server/picture_desk.h"

#include <algorithm>
#include <ctime>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>

namespace puck {
namespace {

using std::chrono::steady_clock;

constexpr std::size_t kMostKept = 8;
constexpr std::chrono::microseconds kShortestPeriod{16'600};
constexpr std::chrono::microseconds kShortestTablePeriod{33'300};
constexpr int kQuality_percent = 88;

/// CPU time of this thread.
std::chrono::nanoseconds thread_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

std::chrono::microseconds shortest_period(const PictureWishes& wishes) {
  return wishes.view == PictureWishes::View::kTable ? kShortestTablePeriod : kShortestPeriod;
}

}  // namespace

PictureDesk::PictureDesk(ViewSource& source) : source_(source) { cv::setNumThreads(1); }

std::optional<PictureDesk::Picture> PictureDesk::newer(const PictureWishes& wishes,
                                                       std::uint64_t seen) {
  const std::lock_guard lock(mutex_);
  Kept& kept = place_of(wishes);
  kept.used = steady_clock::now();
  const std::uint64_t version = source_.version();
  const bool is_due = kept.used >= free_ && kept.used - kept.drawn >= shortest_period(kept.wishes);
  if (version != kept.picture.version && is_due) draw(kept, version);
  if (!kept.picture.jpeg || kept.picture.version == seen) return std::nullopt;
  return kept.picture;
}

PictureDesk::Kept& PictureDesk::place_of(const PictureWishes& wishes) {
  const auto known = std::find_if(kept_.begin(), kept_.end(),
                                  [&](const Kept& kept) { return kept.wishes == wishes; });
  if (known != kept_.end()) return *known;
  if (kept_.size() < kMostKept) return kept_.emplace_back(Kept{.wishes = wishes});
  const auto oldest = std::min_element(
      kept_.begin(), kept_.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  return *oldest = Kept{.wishes = wishes};
}

void PictureDesk::draw(Kept& kept, std::uint64_t version) {
  const std::chrono::nanoseconds begin = thread_time();
  if (!source_.fill(kept.wishes, scene_)) return;
  kept.drawn = steady_clock::now();
  const cv::Mat& picture = painter_.paint(scene_, kept.wishes);
  cv::imencode(".jpg", picture, encoded_, {cv::IMWRITE_JPEG_QUALITY, kQuality_percent});
  kept.picture = {version, std::make_shared<const std::string>(encoded_.begin(), encoded_.end())};
  const auto rest = (thread_time() - begin) * (1 / kMostOfCore - 1);
  free_ = steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(rest);
}

}  // namespace puck
