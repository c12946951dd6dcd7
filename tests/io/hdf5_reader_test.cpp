#include "common/io/hdf5_reader.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <thread>

#include <doctest/doctest.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/io/event_writer.h"
#include "tests/io/event_data.h"
#include "tests/io/gzip_text.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

std::string hdf5_of(const TemporaryFolder& folder, const std::string& format,
                    const std::vector<PlainEvent>& events) {
  const auto writer = make_event_writer(folder / "made.hdf5", format, {64, 48});
  writer->write(packet_of(events));
  writer->close();
  return read_text(folder / "made.hdf5");
}

/// The folder for temporary files, as long as this lives.
class CopiesFolder {
 public:
  explicit CopiesFolder(const std::filesystem::path& folder) {
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    setenv("TMPDIR", folder.c_str(), 1);
  }
  ~CopiesFolder() {
    if (before_) {
      setenv("TMPDIR", before_->c_str(), 1);
    } else {
      unsetenv("TMPDIR");
    }
  }
  CopiesFolder(const CopiesFolder&) = delete;
  CopiesFolder& operator=(const CopiesFolder&) = delete;

 private:
  std::optional<std::string> before_;
};

/// A file of data sets, each a list of numbers.
class MadeHdf5 {
 public:
  explicit MadeHdf5(const std::filesystem::path& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {
    H5Gclose(H5Gcreate2(file_, "events", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  ~MadeHdf5() { H5Fclose(file_); }
  MadeHdf5(const MadeHdf5&) = delete;
  MadeHdf5& operator=(const MadeHdf5&) = delete;

  void add(const char* name, hid_t type, const std::vector<std::int64_t>& numbers) const {
    const hsize_t count = numbers.size();
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t set = H5Dcreate2(file_, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    H5Dclose(set);
    H5Sclose(space);
  }

  /// Times in one chunk of gzip.
  void add_packed(const char* name, const std::vector<std::int64_t>& numbers) const {
    const hsize_t count = numbers.size();
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(creation, 1, &count);
    H5Pset_deflate(creation, 1);
    const hid_t set =
        H5Dcreate2(file_, name, H5T_STD_I64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Dwrite(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    H5Dclose(set);
    H5Pclose(creation);
    H5Sclose(space);
  }

  /// A list of ones in chunks, of which only those from these elements on are written.
  void add_sparse(const char* name, hsize_t elements, hsize_t chunk,
                  const std::vector<hsize_t>& chunks) const {
    const hid_t space = H5Screate_simple(1, &elements, nullptr);
    const hid_t memory = H5Screate_simple(1, &chunk, nullptr);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(creation, 1, &chunk);
    const hid_t set =
        H5Dcreate2(file_, name, H5T_STD_U16LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    const std::vector<std::int64_t> ones(chunk, 1);
    for (const hsize_t first : chunks) {
      H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &chunk, nullptr);
      H5Dwrite(set, H5T_NATIVE_INT64, memory, space, H5P_DEFAULT, ones.data());
    }
    H5Dclose(set);
    H5Pclose(creation);
    H5Sclose(memory);
    H5Sclose(space);
  }

 private:
  hid_t file_;
};

TEST_CASE("HDF5 of an independent encoder has the simulator's events") {
  const auto gzip = open_event_file(event_data("simulated_gzip.hdf5"));
  CHECK(gzip->sensor_size() == SensorSize{320, 240});
  CHECK(digest_of(*gzip) == kSimulatedDigest);
  CHECK(gzip->warnings().empty());

  const auto dsec = open_event_file(event_data("simulated_dsec.h5"), {.sensor = {320, 240}});
  CHECK(digest_of(*dsec) == kSimulatedDigest);
  CHECK(dsec->warnings().empty());
  CHECK(dsec->facts().encoding == "HDF5 (DSEC), Blosc");
  dsec->rewind();
  CHECK(digest_of(*dsec, 3) == kSimulatedDigest);
  // The file does not tell the sensor's size, so the events do.
  const auto measured = open_event_file(event_data("simulated_dsec.h5"));
  CHECK(measured->sensor_size() == SensorSize{320, 240});
  CHECK(digest_of(*measured) == kSimulatedDigest);
}

TEST_CASE("HDF5 that is cut off is refused in one line that says so") {
  const TemporaryFolder folder;
  for (const char* format : {"hdf5", "hdf5-ecf"}) {
    const std::string whole = hdf5_of(folder, format, scattered_events(50));
    for (std::size_t length = 8; length < whole.size(); length += 61) {
      const auto path = folder.write("cut.hdf5", whole.substr(0, length));
      const std::string message = message_of<EventFileError>([&] { open_event_file(path); });
      CHECK(contains(message, "cut.hdf5: cannot be opened as HDF5: "));
      CHECK(message.find('\n') == std::string::npos);
    }
  }
}

TEST_CASE("HDF5: a damaged chunk costs its own events") {
  const TemporaryFolder folder;
  const auto events = scattered_events(40000);
  for (const char* format : {"hdf5", "hdf5-ecf"}) {
    CAPTURE(format);
    std::string bytes = hdf5_of(folder, format, events);
    // Within the first or the second of three chunks; of ECF, the beginning of the times.
    const std::size_t first = bytes.find(std::string("\x02\x00\x01\x00", 4));
    const std::size_t place = format == std::string("hdf5") ? bytes.size() * 3 / 10 : first + 12;
    bytes.replace(place, 100, std::string(100, '\x10'));
    const auto reader = open_event_file(folder.write("damaged.hdf5", bytes));
    const std::size_t left = read_all(*reader).size();
    CHECK(left == 40000 - 16384);
    CHECK(reader->counters().malformed_words == 1);
    CHECK(reader->counters().missing == static_cast<std::int64_t>(40000 - left));
    CHECK(contains(reader->warnings().back(), "data set /CD/events, events from "));
  }
}

TEST_CASE("HDF5: a damaged chunk read in another thread is told by its cause, not by the library") {
  const TemporaryFolder folder;
  {
    const MadeHdf5 file(folder / "damaged.h5");
    for (const char* name : {"events/x", "events/y", "events/p"}) {
      file.add(name, H5T_STD_U16LE, std::vector<std::int64_t>(5000, 1));
    }
    file.add_packed("events/t", std::vector<std::int64_t>(5000, 7));
  }
  std::string bytes = read_text(folder / "damaged.h5");
  // The times are the last that were written; zlib's chunks begin with these bytes.
  const std::size_t chunk = bytes.rfind("\x78\x01");
  REQUIRE(chunk != std::string::npos);
  bytes.replace(chunk, 2, "\xff\xff");
  const auto reader = open_event_file(folder.write("damaged.h5", bytes), {.sensor = {64, 48}});
  const int kept = dup(STDERR_FILENO);
  REQUIRE(freopen((folder / "stderr").c_str(), "w", stderr) != nullptr);
  std::size_t count = 1;
  std::thread([&] { count = read_all(*reader).size(); }).join();
  fflush(stderr);
  dup2(kept, STDERR_FILENO);
  close(kept);
  CHECK(count == 0);
  CHECK(read_text(folder / "stderr").empty());
  CHECK(reader->counters().missing == 5000);
  const auto warnings = reader->warnings();
  CAPTURE(warnings.back());
  CHECK(contains(warnings.back(), "elements from 0 on: /events/t: inflate() failed"));
}

TEST_CASE("HDF5: events that were never written are missing, not events at (0, 0)") {
  constexpr hsize_t kMany = 100'000'000'000;
  const TemporaryFolder folder;
  {
    const MadeHdf5 file(folder / "a.h5");
    for (const char* name : {"events/x", "events/p", "events/t"}) {
      file.add_sparse(name, kMany, 1000, {0, 1000, 5000, kMany - 1000});
    }
    file.add_sparse("events/y", kMany, 500, {0, 500, 1000, 5000, 5500, 7000, kMany - 500});
  }
  const auto reader = open_event_file(folder / "a.h5", {.sensor = {64, 48}});
  // Whole: 0 to 1499, 5000 to 5999, and the last 500.
  CHECK(read_all(*reader).size() == 3000);
  CHECK(reader->counters().missing == static_cast<std::int64_t>(kMany - 3000));
  CHECK(contains(reader->warnings().back(),
                 "elements from 6000 on: 99999993500 were never written to the file"));
  reader->rewind();
  CHECK(read_all(*reader) == std::vector<PlainEvent>(3000, {1, 1, 1, 1}));

  hdf5_of(folder, "hdf5", scattered_events(20000));
  const hid_t file = H5Fopen((folder / "made.hdf5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t set = H5Dopen2(file, "CD/events", H5P_DEFAULT);
  CHECK(H5Dset_extent(set, &kMany) >= 0);
  H5Dclose(set);
  H5Fclose(file);
  const auto extended = open_event_file(folder / "made.hdf5");
  // The list was extended within its second chunk of 16384.
  CHECK(extended->counters().missing == 0);
  CHECK(read_all(*extended).size() <= 32768);
  CHECK(extended->counters().missing == static_cast<std::int64_t>(kMany - 32768));
}

TEST_CASE("HDF5: one chunk of thousands that was never written costs its own events") {
  const TemporaryFolder folder;
  {
    const MadeHdf5 file(folder / "a.h5");
    std::vector<hsize_t> chunks;
    for (hsize_t first = 0; first < 6000; first += 2) {
      if (first != 3000) chunks.push_back(first);
    }
    for (const char* name : {"events/x", "events/y", "events/p", "events/t"}) {
      file.add_sparse(name, 6000, 2, chunks);
    }
  }
  const auto reader = open_event_file(folder / "a.h5", {.sensor = {64, 48}});
  CHECK(read_all(*reader) == std::vector<PlainEvent>(5998, {1, 1, 1, 1}));
  CHECK(reader->counters().missing == 2);
  {
    const MadeHdf5 file(folder / "b.h5");
    for (const char* name : {"events/x", "events/y", "events/p", "events/t"}) {
      file.add_sparse(name, hsize_t{1} << 50, 1 << 20, {});
    }
  }
  const std::string message = message_of<EventFileError>([&] { open_event_file(folder / "b.h5"); });
  CAPTURE(message);
  CHECK(contains(message, "has 1125899906842624 elements; expected up to 281474976710656"));
}

TEST_CASE("HDF5: bytes behind the file's end are left out with a word on their number") {
  const TemporaryFolder folder;
  for (const char* format : {"hdf5", "hdf5-ecf"}) {
    const std::string whole = hdf5_of(folder, format, scattered_events(50));
    const auto alone = open_event_file(folder.write("alone.hdf5", whole));
    CHECK(read_all(*alone).size() == 50);
    CHECK(alone->warnings().empty());
    for (const std::string& content : {whole + whole, gzip(whole + whole)}) {
      const auto joined = open_event_file(folder.write("joined.hdf5", content));
      CHECK(read_all(*joined).size() == 50);
      REQUIRE(joined->warnings().size() == 1);
      CHECK(contains(joined->warnings()[0], "its last " + std::to_string(whole.size()) +
                                                " bytes follow the end of the HDF5 file"));
    }
  }
}

TEST_CASE("HDF5 from a pipe is copied to a file without a name, also while it is copied") {
  const TemporaryFolder folder;
  const TemporaryFolder copies;
  const std::string whole = hdf5_of(folder, "hdf5", scattered_events(300000));
  // More than a pipe holds, so that the reader has begun when all but the end is written.
  REQUIRE(whole.size() > 200'000);
  const std::string pipe = (folder / "pipe").string();
  REQUIRE(mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR) == 0);
  const CopiesFolder variable(copies.path());
  std::unique_ptr<EventReader> reader;
  std::string message;
  std::thread opening(
      [&] { message = message_of<EventFileError>([&] { reader = open_event_file(pipe); }); });
  {
    std::ofstream out(pipe, std::ios::binary);
    out << whole.substr(0, whole.size() - 1) << std::flush;
    CHECK(std::filesystem::is_empty(copies.path()));
    out << whole.back();
  }
  opening.join();
  REQUIRE(message == "");
  CHECK(std::filesystem::is_empty(copies.path()));
  CHECK(read_all(*reader) == scattered_events(300000));
}

TEST_CASE("HDF5 of other content is refused with what was expected") {
  const TemporaryFolder folder;
  const auto refusal = [&] {
    return message_of<EventFileError>([&] {
      open_event_file(folder / "other.h5", {.sensor = {64, 48}});
    });
  };
  { const MadeHdf5 file(folder / "other.h5"); }
  CHECK(contains(refusal(), "is HDF5, but not of events; expected the data set /CD/events"));
  {
    const MadeHdf5 file(folder / "other.h5");
    file.add("events/x", H5T_STD_U16LE, {1, 2});
    file.add("events/y", H5T_STD_U16LE, {1, 2});
    file.add("events/p", H5T_STD_U8LE, {1, 0});
  }
  CHECK(contains(refusal(), "data set /events/t is missing"));
  {
    const MadeHdf5 file(folder / "other.h5");
    file.add("events/x", H5T_STD_U16LE, {1, 2});
    file.add("events/y", H5T_STD_U16LE, {1, 2});
    file.add("events/p", H5T_STD_U8LE, {1, 0});
    file.add("events/t", H5T_STD_I64LE, {1});
  }
  CHECK(contains(refusal(), "have 2, 2, 2 and 1 elements; expected the same number"));
  {
    const MadeHdf5 file(folder / "other.h5");
    for (const char* name : {"events/x", "events/y", "events/p"}) {
      file.add(name, H5T_STD_U16LE, {1, 2});
    }
    file.add("events/t", H5T_IEEE_F64LE, {1, 2});
  }
  CHECK(contains(refusal(), "data set /events/t does not hold whole numbers"));
}

TEST_CASE("HDF5: no other file is opened through external links and data") {
  const TemporaryFolder folder;
  hdf5_of(folder, "hdf5", scattered_events(100));
  const auto refusal = [&] {
    return message_of<EventFileError>([&] {
      open_event_file(folder / "a.h5", {.sensor = {64, 48}});
    });
  };
  // h5py wrote links to made.hdf5 into them: /CD, and /CD/events. Followed, they would be the other
  // file's events.
  for (const char* linked : {"linked_group.h5", "linked_events.h5"}) {
    CAPTURE(linked);
    std::filesystem::copy_file(event_data(linked), folder / "a.h5",
                               std::filesystem::copy_options::overwrite_existing);
    CHECK(contains(refusal(), "is HDF5, but not of events"));
  }

  {
    const MadeHdf5 made(folder / "a.h5");
    for (const char* name : {"events/x", "events/y", "events/p", "events/t"}) {
      made.add(name, H5T_STD_U16LE, {1, 2});
    }
  }
  const hid_t file = H5Fopen((folder / "a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t one = 1;
  const hid_t space = H5Screate_simple(1, &one, nullptr);
  H5Pset_external(creation, (folder / "made.hdf5").c_str(), 0, 8);
  H5Dclose(H5Dcreate2(file, "t_offset", H5T_STD_I64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT));
  H5Sclose(space);
  H5Pclose(creation);
  H5Fclose(file);
  CHECK(contains(refusal(), "data set /t_offset lies in other files"));
}

TEST_CASE("pauses that a few damaged times make do not fill the disk") {
  const TemporaryFolder folder;
  for (const char* format : {"hdf5", "hdf5-ecf", "es"}) {
    CAPTURE(format);
    const auto writer = make_event_writer(folder / "a", format, {64, 48});
    const std::int64_t hour_us = std::int64_t{3600} * 1'000'000;
    std::string message;
    for (std::int64_t hour = 0; hour < 30 && message.empty(); ++hour) {
      message = message_of<std::invalid_argument>([&] {
        writer->write(packet_of({{hour * hour_us, 1, 1, 1}}));
      });
    }
    CHECK(contains(message,
                   "holds pauses of up to 24 h in all, and 0.1 s an event more, got 25 h "
                   "in 26 events: are times damaged?"));
  }
}

TEST_CASE("HDF5 in DSEC's layout: times count from t_offset, and polarity -1 is darker") {
  const TemporaryFolder folder;
  {
    const MadeHdf5 file(folder / "a.h5");
    file.add("events/x", H5T_STD_U16LE, {1, 2, 63});
    file.add("events/y", H5T_STD_I32LE, {4, 5, 47});
    file.add("events/p", H5T_STD_I8LE, {1, -1, 0});
    file.add("events/t", H5T_STD_U32LE, {0, 10, 4'000'000'000});
    file.add("t_offset", H5T_STD_I64LE, {5'000'000'000});
  }
  const auto reader = open_event_file(folder / "a.h5", {.sensor = {64, 48}});
  CHECK(read_all(*reader) == std::vector<PlainEvent>{{5'000'000'000, 1, 4, 1},
                                                     {5'000'000'010, 2, 5, 0},
                                                     {9'000'000'000, 63, 47, 0}});
}

TEST_CASE("HDF5 written here has an index of every 2 ms, and times that count from its offset") {
  const TemporaryFolder folder;
  hdf5_of(folder, "hdf5", {{7000, 1, 1, 1}, {8999, 1, 1, 1}, {9000, 1, 1, 1}, {13500, 2, 2, 0}});
  const hid_t file = H5Fopen((folder / "made.hdf5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = H5Dopen2(file, "CD/indexes", H5P_DEFAULT);
  struct Entry {
    std::uint64_t event = 0;
    std::int64_t t_us = 0;
  };
  std::vector<Entry> entries(5);
  const hid_t type = H5Dget_type(set);
  CHECK(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, entries.data()) >= 0);
  const std::vector<std::uint64_t> expected{0, 2, 3, 3, 4};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    CHECK(entries[i].event == expected[i]);
    CHECK(entries[i].t_us == static_cast<std::int64_t>(2000 * i));
  }
  H5Tclose(type);
  H5Dclose(set);
  H5Fclose(file);
}

}  // namespace
}  // namespace puck
