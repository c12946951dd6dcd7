#include "common/io/hdf5_object.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "common/io/ecf_codec.h"
#include "common/io/event_reader.h"

namespace puck {
namespace {

constexpr std::size_t kMostChunkBytes = std::size_t{16} << 20;
constexpr hsize_t kMostElements = hsize_t{1} << 48;
constexpr std::size_t kLongestText = 4096;
constexpr int kBlosc = 32001;

herr_t take_first_cause(unsigned, const H5E_error2_t* error, void* text) {
  auto& cause = *static_cast<std::string*>(text);
  if (error->desc != nullptr) cause = error->desc;
  return 1;  // The first is the innermost; no need for the others.
}

hid_t new_access_list() {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  // A lock fails on some network disks and folders that cannot be written.
  H5Pset_file_locking(access, false, true);
  return access;
}

std::string name_of_filter(int filter) {
  std::string name = std::to_string(filter);
  if (filter == kBlosc) name += " (Blosc; Debian's hdf5-filter-plugin-blosc-serial)";
  return name;
}

}  // namespace

std::string hdf5_packing(const Hdf5DataSet& list) {
  std::string text;
  for (const int filter : list.filters) {
    if (!text.empty()) text += ", ";
    if (filter == kEcfFilter) {
      text += "ECF";
    } else if (filter == H5Z_FILTER_DEFLATE) {
      text += "gzip";
    } else if (filter == H5Z_FILTER_SHUFFLE) {
      text += "shuffle";
    } else {
      text += filter == kBlosc ? "Blosc" : "filter " + std::to_string(filter);
    }
  }
  return text.empty() ? "not packed" : text;
}

void silence_hdf5() {
  // At the process' end HDF5 would unload its filters, and what they hold would count as leaked.
  static const herr_t stays_loaded = H5dont_atexit();
  static_cast<void>(stays_loaded);
  // A hostile file could otherwise have any other file opened by its links.
  static const herr_t is_closed = H5Lunregister(H5L_TYPE_EXTERNAL);
  static_cast<void>(is_closed);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

std::string hdf5_cause() {
  std::string cause;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first_cause, &cause);
  return cause.empty() ? "unknown cause" : cause;
}

Hdf5Object open_hdf5_file(const std::filesystem::path& path, const std::string& name) {
  silence_hdf5();
  const Hdf5Object access(new_access_list(), H5Pclose);
  Hdf5Object file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!file.is_open()) {
    throw EventFileError(name + ": cannot be opened as HDF5: " + hdf5_cause() +
                         "; expected a whole HDF5 file");
  }
  return file;
}

std::uint64_t bytes_behind_hdf5(const Hdf5Object& file) {
  hsize_t size = 0;
  haddr_t end = 0;
  if (H5Fget_filesize(file.id(), &size) < 0 || H5Fget_eoa(file.id(), &end) < 0) return 0;
  return size - std::min<hsize_t>(size, end);
}

bool has_hdf5_object(const Hdf5Object& file, const std::string& path) {
  // The library wants each group on the way checked by itself.
  for (std::size_t end = path.find('/');; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    if (H5Lexists(file.id(), part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) break;
  }
  return H5Oexists_by_name(file.id(), path.c_str(), H5P_DEFAULT) > 0;
}

std::optional<std::string> hdf5_text(const Hdf5Object& object, const std::string& attribute) {
  if (H5Aexists(object.id(), attribute.c_str()) <= 0) return std::nullopt;
  const Hdf5Object opened(H5Aopen(object.id(), attribute.c_str(), H5P_DEFAULT), H5Aclose);
  const Hdf5Object type(H5Aget_type(opened.id()), H5Tclose);
  const Hdf5Object space(H5Aget_space(opened.id()), H5Sclose);
  if (!opened.is_open() || H5Tget_class(type.id()) != H5T_STRING ||
      H5Sget_simple_extent_npoints(space.id()) != 1) {
    return std::nullopt;
  }
  if (H5Tis_variable_str(type.id()) > 0) {
    const Hdf5Object as(H5Tcopy(type.id()), H5Tclose);
    char* text = nullptr;
    if (H5Aread(opened.id(), as.id(), static_cast<void*>(&text)) < 0 || text == nullptr) {
      return std::nullopt;
    }
    const std::string copy(text, strnlen(text, kLongestText));
    H5Dvlen_reclaim(as.id(), space.id(), H5P_DEFAULT, static_cast<void*>(&text));
    return copy;
  }
  const std::size_t bytes = H5Tget_size(type.id());
  if (bytes == 0 || bytes > kLongestText) return std::nullopt;
  std::string text(bytes, '\0');
  if (H5Aread(opened.id(), type.id(), text.data()) < 0) return std::nullopt;
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

std::vector<std::pair<std::string, std::string>> hdf5_texts(const Hdf5Object& object) {
  constexpr hsize_t kMostTexts = 100;
  std::vector<std::pair<std::string, std::string>> texts;
  for (hsize_t i = 0; i < kMostTexts; ++i) {
    const Hdf5Object attribute(
        H5Aopen_by_idx(object.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    if (!attribute.is_open()) break;
    std::array<char, 256> name{};
    if (H5Aget_name(attribute.id(), name.size(), name.data()) <= 0) continue;
    if (auto text = hdf5_text(object, name.data())) {
      texts.emplace_back(name.data(), std::move(*text));
    }
  }
  return texts;
}

Hdf5DataSet open_hdf5_list(const Hdf5Object& file, const std::string& path,
                           const std::string& name) {
  const std::string at = name + ": data set /" + path;
  Hdf5DataSet list;
  list.path = path;
  if (!has_hdf5_object(file, path)) throw EventFileError(at + " is missing");
  list.object = Hdf5Object(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!list.object.is_open()) {
    throw EventFileError(at + " cannot be opened: " + hdf5_cause() +
                         "; expected a list, as HDF5 1.10 writes it");
  }
  const Hdf5Object space(H5Dget_space(list.object.id()), H5Sclose);
  const Hdf5Object creation(H5Dget_create_plist(list.object.id()), H5Pclose);
  const Hdf5Object type(H5Dget_type(list.object.id()), H5Tclose);
  hsize_t elements = 0;
  if (H5Sget_simple_extent_ndims(space.id()) != 1 ||
      H5Sget_simple_extent_dims(space.id(), &elements, nullptr) != 1) {
    throw EventFileError(at + " has not one dimension; expected a list");
  }
  if (elements > kMostElements) {
    throw EventFileError(at + " has " + std::to_string(elements) + " elements; expected up to " +
                         std::to_string(kMostElements));
  }
  list.elements = elements;
  check_hdf5_is_inside(list.object, at);
  if (H5Pget_layout(creation.id()) == H5D_CHUNKED) {
    hsize_t chunk = 0;
    const std::size_t bytes = H5Tget_size(type.id());
    if (H5Pget_chunk(creation.id(), 1, &chunk) != 1 || chunk == 0 || bytes == 0 ||
        chunk > kMostChunkBytes / bytes) {
      throw EventFileError(at + " has chunks of " + std::to_string(chunk) +
                           " elements; expected up to 16 MiB");
    }
    list.chunk_elements = chunk;
  }
  for (int i = 0; i < H5Pget_nfilters(creation.id()); ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    list.filters.push_back(H5Pget_filter2(creation.id(), static_cast<unsigned>(i), &flags, &values,
                                          nullptr, 0, nullptr, nullptr));
  }
  if (list.chunk_elements == 0) return list;
  // Chunks that are larger than the library's cache would be unpacked again for each part read.
  const Hdf5Object access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  const std::size_t cache_bytes =
      std::max<std::size_t>(1 << 20, list.chunk_elements * H5Tget_size(type.id()));
  H5Pset_chunk_cache(access.id(), 521, cache_bytes, 1);
  list.object = Hdf5Object(H5Dopen2(file.id(), path.c_str(), access.id()), H5Dclose);
  return list;
}

void check_hdf5_is_inside(const Hdf5Object& data_set, const std::string& at) {
  const Hdf5Object creation(H5Dget_create_plist(data_set.id()), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation.id());
  const bool is_own = layout == H5D_CHUNKED || layout == H5D_COMPACT ||
                      (layout == H5D_CONTIGUOUS && H5Pget_external_count(creation.id()) == 0);
  if (!is_own) throw EventFileError(at + " lies in other files; expected it in this one");
}

void check_hdf5_filters(const Hdf5DataSet& list, const std::string& name) {
  for (const int filter : list.filters) {
    if (H5Zfilter_avail(filter) > 0) continue;
    throw EventFileError(name + ": data set /" + list.path + " is packed with the filter " +
                         name_of_filter(filter) +
                         ", which is not installed; expected gzip, ECF alone, or one that is");
  }
}

std::string read_hdf5_list(const Hdf5DataSet& list, std::uint64_t first, std::uint64_t count,
                           hid_t memory_type, void* room) {
  const hsize_t start = first;
  const hsize_t length = count;
  const Hdf5Object part(H5Dget_space(list.object.id()), H5Sclose);
  const Hdf5Object memory(H5Screate_simple(1, &length, nullptr), H5Sclose);
  if (H5Sselect_hyperslab(part.id(), H5S_SELECT_SET, &start, nullptr, &length, nullptr) >= 0 &&
      H5Dread(list.object.id(), memory_type, memory.id(), part.id(), H5P_DEFAULT, room) >= 0) {
    return {};
  }
  // Closing the spaces forgets the cause.
  return hdf5_cause();
}

}  // namespace puck
