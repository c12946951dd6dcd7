#include "common/yarp/set_point_message.h"

#include <array>
#include <string>

#include <doctest/doctest.h>

#include "tests/yarp/wire_bytes.h"

namespace puck {

using namespace std::string_literals;

TEST_CASE("set-points of all joints are a pair of the header `dpos n` and a vector") {
  CHECK(as_text(set_points_of_all(std::array{1.5, -2.0})) ==
        "\0\1\0\0\2\0\0\0"s    // a pair
        "\0\1\0\0\2\0\0\0"s    // of a list of two items:
        "\x9\0\0\0dpos"s       // a vocab,
        "\1\0\0\0\2\0\0\0"s    // an int;
        "\x0A\1\0\0\2\0\0\0"s  // and a list of two reals
        "\0\0\0\0\0\0\xF8\x3F\0\0\0\0\0\0\0\xC0"s);
}

TEST_CASE("set-points of some joints name them: `dpog n (j…)`") {
  CHECK(as_text(set_points_of_some(std::array{1, 5}, std::array{1.5, -2.0})) ==
        "\0\1\0\0\2\0\0\0"s
        "\0\1\0\0\3\0\0\0"s
        "\x9\0\0\0dpog"s
        "\1\0\0\0\2\0\0\0"s
        "\1\1\0\0\2\0\0\0\1\0\0\0\5\0\0\0"s  // a list of two ints
        "\x0A\1\0\0\2\0\0\0"s
        "\0\0\0\0\0\0\xF8\x3F\0\0\0\0\0\0\0\xC0"s);
}

}  // namespace puck
