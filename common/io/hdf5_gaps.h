#pragma once

#include <cstdint>
#include <vector>

#include "common/io/hdf5_object.h"

namespace puck {

/// Which elements of lists were never written. The file does not hold their chunks, and the HDF5
/// library reads them as 0.
class Hdf5Gaps {
 public:
  /// Adds those of a list. Of several lists, an element that any of them lacks is missing.
  void add(const Hdf5DataSet& list);

  /// Neighbours that are all missing, or all there.
  struct Run {
    std::uint64_t end = 0;
    bool is_missing = false;
  };

  /// The elements from `first` on that are alike, up to `elements`, the length of the lists.
  Run run_from(std::uint64_t first, std::uint64_t elements) const;

 private:
  struct Gap {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
  };

  std::vector<Gap> gaps_;  // In order, with elements between them.
};

}  // namespace puck
