#include "common/io/hdf5_gaps.h"

#include <algorithm>
#include <utility>

namespace puck {
namespace {

bool is_stored(const Hdf5DataSet& list, hsize_t first) {
  unsigned left_out = 0;
  haddr_t address = HADDR_UNDEF;
  hsize_t bytes = 0;
  return H5Dget_chunk_info_by_coord(list.object.id(), &first, &left_out, &address, &bytes) < 0 ||
         address != HADDR_UNDEF;
}

// First elements of the chunks that the file holds, in order.
std::vector<std::uint64_t> stored_chunks(const Hdf5DataSet& list, const Hdf5Object& space,
                                         hsize_t count) {
  std::vector<std::uint64_t> chunks;
  // For the chunk i, the library visits all up to it: slow for many, but not for a few of millions.
  const std::uint64_t places = (list.elements - 1) / list.chunk_elements + 1;
  if (count < places / std::max<hsize_t>(count, 1)) {
    for (hsize_t i = 0; i < count; ++i) {
      hsize_t first = 0;
      unsigned left_out = 0;
      haddr_t address = HADDR_UNDEF;
      hsize_t bytes = 0;
      if (H5Dget_chunk_info(list.object.id(), space.id(), i, &first, &left_out, &address, &bytes) >=
          0) {
        chunks.push_back(first);
      }
    }
    std::sort(chunks.begin(), chunks.end());
    return chunks;
  }
  for (std::uint64_t first = 0; first < list.elements && chunks.size() < count;
       first += list.chunk_elements) {
    if (is_stored(list, first)) chunks.push_back(first);
  }
  return chunks;
}

}  // namespace

void Hdf5Gaps::add(const Hdf5DataSet& list) {
  if (list.elements == 0) return;
  if (list.chunk_elements == 0) {
    if (H5Dget_storage_size(list.object.id()) == 0) gaps_ = {{0, list.elements}};
    return;
  }
  const Hdf5Object space(H5Dget_space(list.object.id()), H5Sclose);
  hsize_t count = 0;
  // Where the library cannot tell, reading fails, too.
  if (H5Dget_num_chunks(list.object.id(), space.id(), &count) < 0) return;
  if (count > (list.elements - 1) / list.chunk_elements) return;

  std::uint64_t end = 0;
  for (const std::uint64_t chunk : stored_chunks(list, space, count)) {
    if (chunk > end) gaps_.push_back({end, chunk});
    end = chunk + list.chunk_elements;
  }
  if (end < list.elements) gaps_.push_back({end, list.elements});

  std::sort(gaps_.begin(), gaps_.end(),
            [](const Gap& one, const Gap& other) { return one.begin < other.begin; });
  std::vector<Gap> joined;
  for (const Gap& gap : gaps_) {
    if (joined.empty() || gap.begin > joined.back().end) {
      joined.push_back(gap);
    } else {
      joined.back().end = std::max(joined.back().end, gap.end);
    }
  }
  gaps_ = std::move(joined);
}

Hdf5Gaps::Run Hdf5Gaps::run_from(std::uint64_t first, std::uint64_t elements) const {
  const auto next = std::partition_point(gaps_.begin(), gaps_.end(),
                                         [&](const Gap& gap) { return gap.end <= first; });
  if (next == gaps_.end()) return {elements, false};
  return next->begin <= first ? Run{next->end, true} : Run{next->begin, false};
}

}  // namespace puck
