#include "tools/evaluate/tick_file.h"

#include <stdexcept>

namespace puck {

TickFile::TickFile(const std::filesystem::path& path) : path_(path), file_(path) {
  if (!file_) throw std::runtime_error(path.string() + ": cannot be written");
  // Enough digits to restore the exact values.
  file_.precision(17);
  file_ << "t_us,x,y,width,height,score,state,latency_us\n";
}

void TickFile::add(const EvaluatedTick& tick) {
  const PuckEstimate& e = tick.estimate;
  file_ << tick.tick.us << ',';
  if (e.position) {
    file_ << e.position->x << ',' << e.position->y << ',' << e.size.width << ',' << e.size.height
          << ',';
  } else {
    file_ << ",,,,";
  }
  file_ << e.score << ',' << to_string(e.state) << ',';
  if (tick.latency_us) file_ << *tick.latency_us;
  file_ << '\n';
}

void TickFile::close() {
  file_.close();
  if (!file_) throw std::runtime_error(path_.string() + ": cannot be written");
}

}  // namespace puck
