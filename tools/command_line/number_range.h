#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace puck {

/// Accepts numbers from `lowest` to `highest`. CLI::Range also accepts "nan", with which a run
/// never ends.
inline CLI::Validator number_range(double lowest, double highest) {
  CLI::Validator validator = CLI::Range(lowest, highest);  // For its text in --help.
  validator.operation([lowest, highest](std::string& text) -> std::string {
    double number = 0;
    if (CLI::detail::lexical_cast(text, number) && number >= lowest && number <= highest) return {};
    return "Value " + text + " not in range " + std::to_string(lowest) + " to " +
           std::to_string(highest);
  });
  return validator;
}

}  // namespace puck
