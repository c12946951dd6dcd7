// Builds precompile the usual standard headers, so the compiler does not notice a missing one.
#include <cctype>
#include <filesystem>
#include <fstream>
#include <istream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/environment.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;

// Standard headers, and some names that only they declare.
const std::vector<std::pair<std::string, Names>> kDeclared{
    {"algorithm",
     {"sort",      "min",           "max",       "clamp",       "find_if",     "any_of",
      "all_of",    "none_of",       "count_if",  "copy_n",      "fill_n",      "min_element",
      "transform", "max_element",   "equal",     "nth_element", "lower_bound", "minmax_element",
      "fill",      "upper_bound",   "reverse",   "rotate",      "stable_sort", "copy",
      "shuffle",   "generate",      "mismatch",  "unique",      "is_sorted",   "remove_if",
      "for_each",  "adjacent_find", "partition", "copy_if",     "count",       "find"}},
    {"array", {"array"}},
    {"atomic", {"atomic", "memory_order_relaxed", "memory_order_acquire", "memory_order_release"}},
    {"bit", {"bit_cast", "popcount", "endian", "countl_zero", "countr_zero", "bit_ceil"}},
    {"charconv", {"from_chars", "to_chars"}},
    {"chrono", {"chrono"}},
    {"cmath", {"sqrt",  "hypot", "sin",     "cos",      "tan",   "atan2",  "exp",
               "log",   "pow",   "floor",   "ceil",     "round", "lround", "isfinite",
               "isnan", "fmod",  "llround", "copysign", "erf",   "cbrt",   "trunc"}},
    {"condition_variable", {"condition_variable", "condition_variable_any"}},
    {"filesystem", {"filesystem"}},
    {"fstream", {"ifstream", "ofstream", "fstream"}},
    {"functional", {"function", "plus", "hash"}},
    {"limits", {"numeric_limits"}},
    {"map", {"map", "multimap"}},
    {"memory", {"unique_ptr", "shared_ptr", "weak_ptr", "make_unique", "make_shared"}},
    {"mutex", {"mutex", "lock_guard", "scoped_lock", "unique_lock", "call_once"}},
    {"numbers", {"numbers"}},
    {"optional", {"optional", "nullopt"}},
    {"random", {"mt19937", "mt19937_64", "normal_distribution", "random_device"}},
    {"set", {"set", "multiset"}},
    {"span", {"span"}},
    {"sstream", {"stringstream", "istringstream", "ostringstream"}},
    {"stdexcept", {"runtime_error", "invalid_argument", "out_of_range", "logic_error"}},
    {"stop_token", {"stop_token", "stop_source", "stop_callback"}},
    {"string", {"string", "to_string", "stoi", "stod", "getline"}},
    {"string_view", {"string_view"}},
    {"system_error", {"system_error", "error_code", "errc", "generic_category"}},
    {"thread", {"thread", "jthread", "this_thread"}},
    {"variant", {"variant", "visit", "get_if", "monostate", "holds_alternative"}},
    {"vector", {"vector"}}};

// Headers that provide another one's names by their own interface.
const std::map<std::string, Names> kGivenBy{
    {"mutex", {"condition_variable"}},
    {"stop_token", {"thread", "condition_variable"}},
    {"string", {"string_view", "sstream", "fstream", "stdexcept", "filesystem"}},
    {"string_view", {"string"}},
    {"system_error", {"filesystem", "charconv"}}};

struct Source {
  Names includes;
  Names names;  // Names after `std::`.
};

Names names_in(const std::string& line) {
  Names names;
  const std::string code = line.substr(0, line.find("//"));
  for (auto at = code.find("std::"); at != std::string::npos; at = code.find("std::", at)) {
    const auto begin = at += 5;
    while (at < code.size() && (std::isalnum(code[at]) != 0 || code[at] == '_')) ++at;
    names.insert(code.substr(begin, at - begin));
  }
  return names;
}

Source source_of(std::istream& text) {
  Source source;
  for (std::string line; std::getline(text, line);) {
    source.names.merge(names_in(line));
    if (!line.starts_with("#include ")) continue;
    const auto begin = line.find_first_of("<\"") + 1;
    source.includes.insert(line.substr(begin, line.find_first_of(">\"", begin) - begin));
  }
  return source;
}

// By their paths in include lines.
std::map<std::string, Source> sources() {
  std::map<std::string, Source> found;
  const fs::path root = source_folder();
  for (const std::string top : {"common", "services", "tools", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream file(entry.path());
      found[entry.path().lexically_relative(root).string()] = source_of(file);
    }
  }
  return found;
}

// All direct and indirect includes of a source.
void add_included(const std::map<std::string, Source>& all, const Source& source, Names& included) {
  for (const std::string& include : source.includes) {
    if (!included.insert(include).second) continue;
    const auto own = all.find(include);
    if (own != all.end()) add_included(all, own->second, included);
  }
}

bool meets(const Names& a, const Names& b) {
  for (const std::string& name : a) {
    if (b.contains(name)) return true;
  }
  return false;
}

Names missing_headers(const std::map<std::string, Source>& all, const Source& source) {
  Names included;
  add_included(all, source, included);
  Names missing;
  for (const auto& [header, declared] : kDeclared) {
    if (!meets(declared, source.names) || included.contains(header)) continue;
    const auto given_by = kGivenBy.find(header);
    if (given_by == kGivenBy.end() || !meets(given_by->second, included)) missing.insert(header);
  }
  return missing;
}

}  // namespace

TEST_CASE("every source includes its standard headers, directly or through its own header") {
  const std::map<std::string, Source> all = sources();
  CHECK(all.size() > 1000);
  for (const auto& [path, source] : all) {
    for (const std::string& header : missing_headers(all, source)) {
      FAIL_CHECK(path, " needs <", header, ">");
    }
  }
}

TEST_CASE("a missing standard header is found, one through another header is accepted") {
  const Source header{{"vector"}, {"vector"}};
  const std::map<std::string, Source> all{{"common/a.h", header}};
  CHECK(missing_headers(all, {{}, {"vector", "sort"}}) == Names{"algorithm", "vector"});
  CHECK(missing_headers(all, {{"common/a.h"}, {"vector", "sort"}}) == Names{"algorithm"});
  CHECK(missing_headers(all, {{"string"}, {"string_view"}}).empty());
  CHECK(names_in("  std::vector<std::string> a;  // std::map") == Names{"vector", "string"});
}

}  // namespace puck
