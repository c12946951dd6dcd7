#include "common/io/evidence_file.h"

#include <string>

#include <doctest/doctest.h>

#include "common/io/config.h"
#include "common/vision/hypotheses/evidence_numbers.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"

namespace puck {
namespace {

// All numbers as they are built in.
std::string written() {
  const TemporaryFolder folder;
  write_evidence_file(folder / "e.toml", {}, "made by hand");
  return read_text(folder / "e.toml");
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t place = text.find("\n" + old);
  REQUIRE(place != std::string::npos);
  const std::size_t end = text.find('\n', place + 1);
  return text.replace(place + 1, end - place, replacement);
}

TEST_CASE("The numbers that are built in are those of config/calibration/evidence.toml") {
  const EvidenceParams shipped =
      read_evidence_file(source_folder() / "config/calibration/evidence.toml");
  for (const EvidenceNumber& number : kEvidenceNumbers) {
    CAPTURE(number.name);
    CHECK(shipped.*number.value == EvidenceParams{}.*number.value);
  }
}

TEST_CASE("every number of the evidence is unchanged by its file, which says what it is") {
  const TemporaryFolder folder;
  EvidenceParams params;
  double share = 0;
  for (const EvidenceNumber& number : kEvidenceNumbers) {
    share += 0.06;
    params.*number.value = number.lowest + share / 3 * (number.highest - number.lowest);
  }
  write_evidence_file(folder / "e.toml", params, "fitted\nto a game");
  const EvidenceParams again = read_evidence_file(folder / "e.toml");
  const std::string text = read_text(folder / "e.toml");
  CHECK(text.starts_with("# fitted\n# to a game\n"));
  for (const EvidenceNumber& number : kEvidenceNumbers) {
    CAPTURE(number.name);
    CHECK(again.*number.value == params.*number.value);
    CHECK(contains(text, std::string("  # ") + number.meaning));
  }
}

TEST_CASE("the evidence's numbers that are built in are within their ranges") {
  for (const EvidenceNumber& number : kEvidenceNumbers) {
    CAPTURE(number.name);
    CHECK(EvidenceParams{}.*number.value >= number.lowest);
    CHECK(EvidenceParams{}.*number.value <= number.highest);
  }
}

TEST_CASE("a file of evidence with a number missing, unknown, out of range or not one is refused") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const auto path = folder.write("e.toml", text);
    return message_of<ConfigError>([&] { read_evidence_file(path); });
  };
  const std::string good = written();
  CHECK(refusal(good).empty());
  CHECK(refusal(good + "[other]\nx = 1\n").empty());
  CHECK(contains(refusal(with(good, "sign_other", "")), "e.toml: evidence.sign_other is missing"));
  CHECK(contains(refusal(with(good, "sector_puck_even", "sector_puck_even = 1.5\n")),
                 "evidence.sector_puck_even must be a number from 0.001 to 1, got 1.5"));
  CHECK(contains(refusal(with(good, "place_puck =", "place_puck = 0\n")),
                 "evidence.place_puck must be a number from 0.001"));
  CHECK(contains(refusal(with(good, "place_worth", "place_worth = nan\n")),
                 "evidence.place_worth must be a number from 0 to 10"));
  CHECK(contains(refusal(with(good, "sign_worth", "sign_worth = \"1\"\n")),
                 "evidence.sign_worth must be a number from 0 to 10"));
  CHECK(contains(refusal(good + "look_worth = 1\n"), "evidence.look_worth"));
  CHECK(contains(message_of<ConfigError>([&] { read_evidence_file(folder / "none.toml"); }),
                 "none.toml"));
}

}  // namespace
}  // namespace puck
