#include "tools/spy/short_text.h"

#include <doctest/doctest.h>

#include "tools/spy/column_layout.h"

namespace puck {

TEST_CASE("counts take five characters") {
  CHECK(short_count(0) == "0");
  CHECK(short_count(99'999) == "99999");
  CHECK(short_count(100'000) == "100k");
  CHECK(short_count(999'499) == "999k");
  CHECK(short_count(999'500) == "1.00M");
  CHECK(short_count(4'327'985) == "4.33M");
  CHECK(short_count(43'279'850) == "43.3M");
  CHECK(short_count(9'007'199'254'740'992) == "9.01P");
  CHECK(short_count(-7) == "-7");
}

TEST_CASE("small rates have a decimal") {
  CHECK(short_rate(0) == "0.0");
  CHECK(short_rate(9.96) == "10.0");
  CHECK(short_rate(99.94) == "99.9");
  CHECK(short_rate(99.96) == "100");
  CHECK(short_rate(1937.8) == "1938");
  CHECK(short_rate(99'999.4) == "99999");
  CHECK(short_rate(10'000'000) == "10.0M");
}

TEST_CASE("durations take six characters") {
  CHECK(short_duration(0) == "0ms");
  CHECK(short_duration(999'999) == "999ms");
  CHECK(short_duration(1'000'000) == "1.0s");
  CHECK(short_duration(99'999'999) == "99.9s");
  CHECK(short_duration(100'000'000) == "1m40s");
  CHECK(short_duration(5'999'000'000) == "99m59s");
  CHECK(short_duration(6'000'000'000) == "1h40m");
  CHECK(short_duration(360'000'000'000) == "4d");
}

TEST_CASE("no text can control a terminal or shift the layout") {
  CHECK(plain_text("puck-arm") == "puck-arm");
  CHECK(plain_text("\x1b[2J\n\x7f") == "?[2J??");
  CHECK(plain_text("5 µs, caf\xc3\xa9") == "5 ?s, caf?");
  CHECK(plain_text("\xc2\x9b"
                   "31m") == "?31m");
}

TEST_CASE("text is cut or filled to a width") {
  CHECK(fit_left("abc", 5) == "abc  ");
  CHECK(fit_right("abc", 5) == "  abc");
  CHECK(fit_left("abcdef", 5) == "abcd~");
  CHECK(fit_right("abcdef", 1) == "~");
  CHECK(fit_left("abc", 0).empty());
}

TEST_CASE("columns that do not fit are left out, the least important first") {
  const std::vector<Column> columns{
      {.title = "NAME", .importance = 0, .min_width = 6, .cells = {"a", "long name"}},
      {.title = "X", .right = true, .importance = 2, .min_width = 5, .cells = {"1", "20"}},
      {.title = "Y", .right = true, .importance = 1, .min_width = 5, .cells = {"3", "40"}},
  };
  CHECK(lay_out(columns, 200) == std::vector<std::string>{"NAME           X      Y",  //
                                                          "a              1      3",  //
                                                          "long name     20     40"});
  CHECK(lay_out(columns, 18) == std::vector<std::string>{"NAME       X     Y",  //
                                                         "a          1     3",  //
                                                         "long ~    20    40"});
  CHECK(lay_out(columns, 17) == std::vector<std::string>{"NAME          Y",  //
                                                         "a             3",  //
                                                         "long name    40"});
  CHECK(lay_out(columns, 5) == std::vector<std::string>{"", "", ""});
}

}  // namespace puck
