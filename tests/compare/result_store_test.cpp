#include "tools/compare/result_store.h"

#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"
#include "tools/compare/content_hash.h"

namespace puck {
namespace {

std::size_t entries_of(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

const auto kFill = [](const std::filesystem::path& there) { write_text(there / "a.txt", "made"); };

}  // namespace

TEST_CASE("the hash is FNV-1a, for files over their bytes") {
  CHECK(ContentHash().text() == "cbf29ce484222325");
  CHECK(ContentHash().add("a").text() == "af63dc4c8601ec8c");
  CHECK(ContentHash().add("foo").add("bar").text() == "85944171f73967e8");
  const TemporaryFolder folder;
  CHECK(ContentHash().add_file(folder.write("f", "foobar")).text() == "85944171f73967e8");
  CHECK(ContentHash().add_file(folder.write("empty", "")).text() == "cbf29ce484222325");
  CHECK_THROWS_AS(ContentHash().add_file(folder / "none"), std::runtime_error);
}

TEST_CASE("a result is found by its name and its key, also by a later run") {
  const TemporaryFolder folder;
  std::filesystem::path made;
  {
    ResultStore store(folder / "results");
    CHECK_FALSE(store.find("still", "key").has_value());
    made = store.make("still", "key", kFill);
  }
  const ResultStore later(folder / "results");
  REQUIRE(later.find("still", "key") == made);
  CHECK(read_text(made / "a.txt") == "made");
  CHECK_FALSE(later.find("still", "another key").has_value());
  CHECK_FALSE(later.find("moving", "key").has_value());
}

TEST_CASE("a failing result leaves nothing behind") {
  const TemporaryFolder folder;
  ResultStore store(folder / "results");
  CHECK_THROWS_AS(store.make("still", "key",
                             [](const std::filesystem::path& there) {
                               kFill(there);
                               throw std::runtime_error("failed");
                             }),
                  std::runtime_error);
  CHECK_FALSE(store.find("still", "key").has_value());
  const ResultStore later(folder / "results");
  CHECK(entries_of(folder / "results") == 0);
}

TEST_CASE("a result replaces its outdated ones only") {
  const TemporaryFolder folder;
  ResultStore store(folder / "results");
  store.make("still-1-default", "old", kFill);
  store.make("still-1-default-moving", "old", kFill);
  store.make("still-1-default", "new", kFill);
  CHECK_FALSE(store.find("still-1-default", "old").has_value());
  CHECK(store.find("still-1-default", "new").has_value());
  CHECK(store.find("still-1-default-moving", "old").has_value());
  store.remove("still-1-default", "new");
  CHECK(entries_of(folder / "results") == 1);
}

TEST_CASE("two keys with the same hash are distinguished") {
  const TemporaryFolder folder;
  ResultStore store(folder / "results");
  const auto made = store.make("still", "key", kFill);
  write_text(made / "key.txt", "a key of the same hash");
  CHECK_FALSE(store.find("still", "key").has_value());
}

}  // namespace puck
