#include "services/tracker/catch_up.h"

namespace puck {

bool CatchUp::leaves_out(std::int64_t received_us, std::int64_t now_us) {
  if (now_us - received_us <= kBehindUs) {
    behind_since_us_.reset();
    return false;
  }
  if (!behind_since_us_) behind_since_us_ = now_us;
  return now_us - *behind_since_us_ > kPatienceUs;
}

}  // namespace puck
