#include "common/io/hdf5_events.h"

#include <algorithm>
#include <stdexcept>

namespace puck {

void Hdf5EventList::add_list(const Hdf5DataSet& list, std::uint64_t most_at_once) {
  elements_ = list.elements;
  most_at_once_ = most_at_once;
  gaps_.add(list);
}

bool Hdf5EventList::next(Part& part) {
  part.missing = 0;
  part.offset_us = 0;
  part.events.clear();
  if (next_ >= elements_) return false;
  const Hdf5Gaps::Run run = gaps_.run_from(next_, elements_);
  const std::uint64_t most = run.is_missing ? elements_ : most_at_once_;
  const std::uint64_t count = std::min(most, run.end - next_);
  const std::uint64_t first = std::exchange(next_, next_ + count);
  try {
    if (run.is_missing) {
      throw std::invalid_argument(std::to_string(count) + " were never written to the file");
    }
    read_part(first, count, part);
  } catch (const std::invalid_argument& error) {
    part.events.clear();
    part.missing = count;
    part.fault = what_ + " from " + std::to_string(first) + " on: " + error.what();
  }
  return true;
}

}  // namespace puck
