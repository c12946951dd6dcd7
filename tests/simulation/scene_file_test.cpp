#include <string>
#include <type_traits>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/config.h"
#include "common/simulation/visit_parameters.h"
#include "tests/support/environment.h"

namespace puck {
namespace {

/// Compares what a file says with the defaults, key by key.
class DefaultsChecker {
 public:
  explicit DefaultsChecker(Config config) : config_(std::move(config)) {}

  template <typename Value, typename... Range>
  void read(const char* key, Value& value, Range... range) {
    CAPTURE(key);
    CHECK(config_.has(key));
    Value in_file = value;
    config_.read(key, in_file, range...);
    CHECK(in_file == value);
    ++keys_;
  }
  void finish() {
    config_.reject_unknown();
    CHECK(keys_ > 60);
  }

 private:
  Config config_;
  int keys_ = 0;
};

}  // namespace

TEST_CASE("config/scene.toml holds every key with its default, and no other") {
  DefaultsChecker checker(Config::from_file(source_folder() / "config/scene.toml"));
  SimulationParams params;
  visit_parameters(checker, params);
  checker.finish();
}

}  // namespace puck
