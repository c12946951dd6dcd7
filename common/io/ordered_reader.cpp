#include "common/io/ordered_reader.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace puck {
namespace {

EventOrder make_order(std::int64_t reorder_us, const std::string& name) {
  try {
    return EventOrder(reorder_us);
  } catch (const std::invalid_argument& error) {
    throw EventFileError(name + ": " + error.what());
  }
}

}  // namespace

OrderedReader::OrderedReader(std::unique_ptr<EventReader> events, std::int64_t reorder_us,
                             std::string name, std::vector<std::string> notes)
    : events_(std::move(events)),
      reorder_us_(reorder_us),
      name_(std::move(name)),
      notes_(std::move(notes)),
      order_(make_order(reorder_us, name_)) {}

bool OrderedReader::read(EventPacket& packet, std::size_t max_events) {
  while (!order_.take(packet, max_events)) {
    if (is_finished_) {
      if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
      return false;
    }
    read_on(std::max(max_events, kUsualEvents));
  }
  counters_.events += static_cast<std::int64_t>(packet.events.size());
  return true;
}

void OrderedReader::rewind() {
  try {
    events_->rewind();
  } catch (const EventFileError&) {
    error_ = std::current_exception();
    is_finished_ = true;
    throw;
  }
  order_ = EventOrder(reorder_us_);
  is_finished_ = false;
  error_ = nullptr;
  counters_ = {};
}

std::vector<std::string> OrderedReader::warnings() const {
  std::vector<std::string> warnings = notes_;
  for (std::string& warning : events_->warnings()) warnings.push_back(std::move(warning));
  if (order_.dropped() > 0) {
    warnings.push_back(name_ + ": " + std::to_string(order_.dropped()) +
                       " events out of order dropped: more than " +
                       std::to_string(EventOrder::kMostHeld) + " lie within " +
                       std::to_string(reorder_us_) + " µs");
  }
  return warnings;
}

void OrderedReader::read_on(std::size_t max_events) {
  try {
    is_finished_ = !events_->read(next_, max_events);
  } catch (const EventFileError&) {
    error_ = std::current_exception();
    is_finished_ = true;
  }
  order_.add(next_);
  if (is_finished_) order_.finish();
  const std::int64_t returned = counters_.events;
  counters_ = events_->counters();
  counters_.events = returned;
  counters_.reordered = order_.reordered();
  counters_.backwards += order_.dropped();
}

}  // namespace puck
