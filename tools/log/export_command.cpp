#include "tools/log/export_command.h"

#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>

#include "tools/log/message_csv.h"

namespace puck {
namespace {

// Each prefix has its own channels, so a log may hold any number of them.
constexpr std::size_t kMostFiles = 256;

/// One table, in a file or on stdout.
class Table {
 public:
  Table(const std::filesystem::path& file, Channel channel)
      : name_(file.empty() ? "stdout" : file.string()),
        own_(file.empty() ? nullptr : std::fopen(file.c_str(), "wb")),
        stream_(file.empty() ? stdout : own_.get()) {
    if (stream_ == nullptr) fail();
    write(csv_header(channel));
  }

  void add(const std::string& line) {
    write(line);
    ++lines_;
  }
  void finish() {
    if (std::fflush(stream_) != 0) fail();
    std::fprintf(stderr, "%s: %" PRId64 " messages\n", name_.c_str(), lines_);
  }

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void write(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size()) fail();
  }
  [[noreturn]] void fail() const {
    throw std::runtime_error(name_ + ": cannot be written: " + std::strerror(errno));
  }

  std::string name_;
  std::unique_ptr<std::FILE, Closer> own_;
  std::FILE* stream_;
  std::int64_t lines_ = 0;
};

class Tables {
 public:
  explicit Tables(const ExportOptions& options) : options_(options) {
    if (!options_.folder.empty()) std::filesystem::create_directories(options_.folder);
  }

  void add(const LoggedMessage& message) {
    const std::string& name = message.record.channel;
    if (!options_.channel.empty() && name != options_.channel) return;
    if (!message.channel || message.rejection) return;
    const auto table = tables_.find(name);
    Table& its_table = table != tables_.end() ? table->second : begin(name, *message.channel);
    its_table.add(csv_line(*message.channel, message.record.utime, message.record.bytes));
  }
  void finish() {
    for (auto& [name, table] : tables_) table.finish();
    if (!options_.channel.empty() && tables_.empty()) {
      throw std::runtime_error("the log has no PUCK message on " + for_terminal(options_.channel));
    }
  }

 private:
  Table& begin(const std::string& name, Channel channel) {
    if (tables_.size() == kMostFiles) {
      throw std::runtime_error("the log has more than " + std::to_string(kMostFiles) +
                               " PUCK channels; choose one with --channel");
    }
    // Names of PUCK channels are letters, digits and underscores, so they are valid file names.
    const std::filesystem::path file =
        options_.folder.empty() ? std::filesystem::path() : options_.folder / (name + ".csv");
    return tables_.try_emplace(name, file, channel).first->second;
  }

  const ExportOptions& options_;
  std::map<std::string, Table> tables_;
};

}  // namespace

LogTally export_log(const std::filesystem::path& path, const ExportOptions& options) {
  LogReader{path};  // Fails before a folder is created if the file is not a log.
  Tables tables(options);
  const LogTally tally = read_log(
      path, [&](const LoggedMessage& message) { tables.add(message); }, [](const LogDamage&) {});
  tables.finish();
  if (tally.foreign > 0) {
    std::fprintf(stderr, "%" PRId64 " messages on other channels left out\n", tally.foreign);
  }
  if (!tally.is_fine()) std::fprintf(stderr, "left out: %s\n", in_words(tally).c_str());
  return tally;
}

}  // namespace puck
