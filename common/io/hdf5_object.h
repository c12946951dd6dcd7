#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <hdf5.h>

namespace puck {

/// Sole owner of an object of the HDF5 library. Movable.
class Hdf5Object {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Object() = default;
  /// `id`: as the library returned it; below 0 on failure.
  Hdf5Object(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Object() {
    if (is_open()) close_(id_);
  }
  Hdf5Object(Hdf5Object&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Object& operator=(Hdf5Object&& other) noexcept {
    Hdf5Object taken(std::move(other));
    std::swap(id_, taken.id_);
    std::swap(close_, taken.close_);
    return *this;
  }

  bool is_open() const { return id_ >= 0; }
  hid_t id() const { return id_; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// Stops the library from printing its errors, in this thread: each thread that calls the library
/// needs it.
void silence_hdf5();

/// The library's own words on its last failure in this thread.
std::string hdf5_cause();

/// Opens a file for reading, without a lock. Throws EventFileError, with `name` for the file.
Hdf5Object open_hdf5_file(const std::filesystem::path& path, const std::string& name);

/// Number of bytes that follow the end of the file by its own account.
std::uint64_t bytes_behind_hdf5(const Hdf5Object& file);

/// Whether the file has an object of this path, "group/name".
bool has_hdf5_object(const Hdf5Object& file, const std::string& path);

/// A text of up to 4096 bytes; nothing if there is no such attribute.
std::optional<std::string> hdf5_text(const Hdf5Object& object, const std::string& attribute);

/// All attributes that are texts, up to 100 of them.
std::vector<std::pair<std::string, std::string>> hdf5_texts(const Hdf5Object& object);

/// A list of elements in a file.
struct Hdf5DataSet {
  std::string path;
  Hdf5Object object;
  std::uint64_t elements = 0;
  std::uint64_t chunk_elements = 0;  ///< 0: not in chunks.
  std::vector<int> filters;          ///< Numbers of the filters that the chunks went through.
};

/// The names of the list's filters, in words.
std::string hdf5_packing(const Hdf5DataSet& list);

/// Opens the data set `path` and checks that it is a list of up to 2^48 elements, whose chunks are
/// of up to 16 MiB. Throws EventFileError, with `name` for the file.
Hdf5DataSet open_hdf5_list(const Hdf5Object& file, const std::string& path,
                           const std::string& name);

/// Throws EventFileError, with `at` before it, for a data set whose numbers lie in other files.
void check_hdf5_is_inside(const Hdf5Object& data_set, const std::string& at);

/// Throws EventFileError if the library cannot undo one of the filters.
void check_hdf5_filters(const Hdf5DataSet& list, const std::string& name);

/// Reads elements as `memory_type` into `room`. Returns why it failed; empty if it did not.
std::string read_hdf5_list(const Hdf5DataSet& list, std::uint64_t first, std::uint64_t count,
                           hid_t memory_type, void* room);

}  // namespace puck
