#include <doctest/doctest.h>

#include "common/io/annotation_file.h"
#include "common/io/correspondence_file.h"
#include "common/io/csv_file.h"
#include "common/io/truth_file.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

std::string truth_refusal(std::string_view text) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.csv", text);
  return message_of<CsvError>([&] { read_truth_file(path); });
}

TEST_CASE("truth is read by column names, in any order, with w and h for width and height") {
  const TemporaryFolder folder;
  const auto rows = read_truth_file(folder.write(
      "a.csv",
      "# by hand\ny, x, visible, note, t_us, h, w\n2.5,1.5,0.25,hello,10,4,3\n\n3,2,1,,20,4,3\n"));
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].time.us == 10);
  CHECK(rows[0].centre == Pixel{1.5, 2.5});
  CHECK(rows[0].size.width == 3);
  CHECK(rows[0].size.height == 4);
  CHECK(rows[0].visible == 0.25);
  CHECK(rows[1].time.us == 20);
}

TEST_CASE("truth without a column for visibility is fully visible") {
  const TemporaryFolder folder;
  CHECK(read_truth_file(folder.write("a.csv", "t_us,x,y,width,height\n1,2,3,4,5\n"))[0].visible ==
        1);
}

TEST_CASE("boxes as truth give their centres, in seconds with a decimal point, else in µs") {
  TemporaryFolder folder;
  const auto seconds = read_truth_file(folder.write("a.txt",
                                                    "# by hand\n"
                                                    "0.010 90 110 200 240\n"
                                                    "1.5\t91 111 202 242\n"));
  REQUIRE(seconds.size() == 2);
  CHECK(seconds[0].time.us == 10'000);
  CHECK(seconds[0].centre == Pixel{220, 100});
  CHECK(seconds[0].size.width == 40);
  CHECK(seconds[0].size.height == 20);
  CHECK(seconds[0].visible == 1);
  CHECK(seconds[1].time.us == 1'500'000);
  CHECK(read_truth_file(folder.write("b.txt", "1500000 90 110 200 240\n"))[0].time.us == 1'500'000);
  for (const char* bad : {"1.0 2 3 4", "1.0 2 3 4 5 6", "1.0 3 2 4 5", "1.0 2 3 5 4",
                          "1.0 2 3 4 nan", "1.0 2 3 4 x", "inf 1 2 3 4", "1e300 1 2 3 4"}) {
    CAPTURE(bad);
    const auto path = folder.write("c.txt", std::string("0.5 1 2 3 4\n") + bad + "\n");
    CHECK(contains(message_of<CsvError>([&] { read_truth_file(path); }), "c.txt:2: "));
  }
  const auto twice = folder.write("d.txt", "0.5 1 2 3 4\n0.5 1 2 3 4\n");
  CHECK(contains(message_of<CsvError>([&] { read_truth_file(twice); }),
                 "d.txt:2: t must be larger than in the box before"));
}

TEST_CASE("bad truth is refused with file and line") {
  const std::string header = "t_us,x,y,width,height\n";
  CHECK(contains(message_of<CsvError>([] { read_truth_file("/nowhere/a.csv"); }),
                 "/nowhere/a.csv: cannot be opened: No such file"));
  CHECK(contains(truth_refusal(""), "no rows; expected a header t_us,x,y,width,height,[visible]"));
  CHECK(contains(truth_refusal(header), "a.csv:1: no rows"));
  CHECK(contains(truth_refusal("t_us,x,y,width\n1,2,3,4\n"),
                 "a.csv:1: the header lacks the column height"));
  CHECK(contains(truth_refusal("t_us,x,y,width,w,height\n1,2,3,4,4,5\n"),
                 "a.csv:1: the column width appears twice"));
  CHECK(contains(truth_refusal(header + "1,2,3,4\n"),
                 "a.csv:2: expected 5 values as in the header, got 4"));
  CHECK(contains(truth_refusal(header + "1,2,3,4,x\n"),
                 "a.csv:2: height must be a number, got \"x\""));
  CHECK(contains(truth_refusal(header + "1,nan,3,4,5\n"),
                 "a.csv:2: x must be a number, got \"nan\""));
  CHECK(contains(truth_refusal(header + "1,2,3,4,-5\n"),
                 "a.csv:2: height must be from 0 to 10000, got \"-5\""));
  CHECK(contains(truth_refusal(header + "5,2,3,4,5\n5,2,3,4,5\n"), "a.csv:3: t_us must be larger"));
  CHECK(contains(truth_refusal("1,2,3,4,5\n1,2,3,4,5\n"),
                 "a.csv:1: the header lacks the column t_us"));
}

TEST_CASE("truth, annotations and correspondences are unchanged by their files") {
  const TemporaryFolder folder;
  const std::vector<TruthRow> truth{{{1699999999123456}, {0.1, 1.0 / 3}, {20, 10.7}, 0.3},
                                    {{1699999999123457}, {-5, 1e-9}, {0, 0}, 0}};
  write_truth_file(folder / "truth.csv", truth);
  const auto truth_again = read_truth_file(folder / "truth.csv");
  REQUIRE(truth_again.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(truth_again[i].time == truth[i].time);
    CHECK(truth_again[i].centre == truth[i].centre);
    CHECK(truth_again[i].size.width == truth[i].size.width);
    CHECK(truth_again[i].size.height == truth[i].size.height);
    CHECK(truth_again[i].visible == truth[i].visible);
  }

  const std::vector<Annotation> annotations{{{7}, {0.1, 0.2}, {0.3, 1.0 / 7}}};
  write_annotation_file(folder / "annotations.csv", annotations);
  const auto annotations_again = read_annotation_file(folder / "annotations.csv");
  REQUIRE(annotations_again.size() == 1);
  CHECK(annotations_again[0].time.us == 7);
  CHECK(annotations_again[0].centre == annotations[0].centre);
  CHECK(annotations_again[0].size.height == 1.0 / 7);

  const std::vector<Correspondence> places{{{0.1, 0.2}, {-0.3, 2.1}}};
  write_correspondence_file(folder / "places.csv", places);
  const auto places_again = read_correspondence_file(folder / "places.csv");
  REQUIRE(places_again.size() == 1);
  CHECK(places_again[0].image == places[0].image);
  CHECK(places_again[0].table == places[0].table);
}

TEST_CASE("bad annotations and correspondences are refused with file and line") {
  const TemporaryFolder folder;
  CHECK(contains(message_of<CsvError>([&] {
                   read_annotation_file(
                       folder.write("a.csv", "t_us,x,y,width,height\n1,2,3,0,5\n"));
                 }),
                 "a.csv:2: width must be from 0.1"));
  CHECK(contains(message_of<CsvError>([&] {
                   read_correspondence_file(folder.write("a.csv", "x_px,y_px,x_m\n1,2,3\n"));
                 }),
                 "a.csv:1: the header lacks the column y_m"));
  CHECK(contains(message_of<CsvError>([&] { write_truth_file(folder / "none/a.csv", {}); }),
                 "none/a.csv: cannot be written: No such file"));
}

TEST_CASE("a byte order mark before the header is skipped") {
  const TemporaryFolder folder;
  const auto rows =
      read_truth_file(folder.write("a.csv", "\xef\xbb\xbft_us,x,y,width,height\r\n1,2,3,4,5\r\n"));
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].time.us == 1);
  CHECK(rows[0].size.height == 5);
}

}  // namespace
}  // namespace puck
