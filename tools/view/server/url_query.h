#pragma once

#include <map>
#include <string>
#include <string_view>

namespace puck {

/// Splits a request's target, `/picture?width=640&words=a%20b`, at its `?` and decodes the query. A
/// broken % stays as it is; of a key that comes twice, the last value counts. Any bytes are
/// accepted.
struct UrlTarget {
  std::string path;
  std::map<std::string, std::string, std::less<>> query;
};
UrlTarget split_target(std::string_view target);

}  // namespace puck
