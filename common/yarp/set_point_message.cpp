#include "common/yarp/set_point_message.h"

#include <string_view>

namespace puck {
namespace {

// Type tags of the items; a list of items of one type has their sum with kList.
constexpr std::int32_t kInt = 1;
constexpr std::int32_t kVocab = 9;
constexpr std::int32_t kReal = 10;
constexpr std::int32_t kList = 256;

void append_pair(Bytes& to) {
  append_int(to, kList);
  append_int(to, 2);
}

void append_vocab(Bytes& to, std::string_view four) {
  append_int(to, kVocab);
  to.insert(to.end(), four.begin(), four.end());
}

void append_count(Bytes& to, std::size_t count) {
  append_int(to, kInt);
  append_int(to, static_cast<std::int32_t>(count));
}

void append_vector(Bytes& to, std::span<const double> deg) {
  append_int(to, kList + kReal);
  append_int(to, static_cast<std::int32_t>(deg.size()));
  for (const double value : deg) append_real(to, value);
}

}  // namespace

Bytes set_points_of_all(std::span<const double> deg) {
  Bytes bytes;
  append_pair(bytes);
  append_int(bytes, kList);
  append_int(bytes, 2);
  append_vocab(bytes, "dpos");
  append_count(bytes, deg.size());
  append_vector(bytes, deg);
  return bytes;
}

Bytes set_points_of_some(std::span<const int> joints, std::span<const double> deg) {
  Bytes bytes;
  append_pair(bytes);
  append_int(bytes, kList);
  append_int(bytes, 3);
  append_vocab(bytes, "dpog");
  append_count(bytes, joints.size());
  append_int(bytes, kList + kInt);
  append_int(bytes, static_cast<std::int32_t>(joints.size()));
  for (const int joint : joints) append_int(bytes, joint);
  append_vector(bytes, deg);
  return bytes;
}

}  // namespace puck
