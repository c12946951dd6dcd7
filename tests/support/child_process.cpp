#include "tests/support/child_process.h"

#include <cerrno>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

class SpawnActions {
 public:
  explicit SpawnActions(const ChildOptions& options) {
    posix_spawn_file_actions_init(&actions_);
    open(STDIN_FILENO, options.input.empty() ? "/dev/null" : options.input, O_RDONLY);
    constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
    if (!options.output.empty()) open(STDOUT_FILENO, options.output, kWrite);
    if (!options.errors.empty()) open(STDERR_FILENO, options.errors, kWrite);
    // Last: the paths above are the test's.
    if (!options.folder.empty()) {
      posix_spawn_file_actions_addchdir_np(&actions_, options.folder.c_str());
    }
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  void open(int descriptor, const std::filesystem::path& path, int flags) {
    constexpr mode_t kReadableByAll = 0644;
    posix_spawn_file_actions_addopen(&actions_, descriptor, path.c_str(), flags, kReadableByAll);
  }

  posix_spawn_file_actions_t actions_{};
};

class SpawnAttributes {
 public:
  SpawnAttributes() {
    posix_spawnattr_init(&attributes_);
    // Background jobs ignore SIGINT, and the child would inherit that.
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGINT);
    posix_spawnattr_setsigdefault(&attributes_, &defaults);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;

  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const ChildOptions& options) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) {
    pointers.push_back(const_cast<char*>(argument.c_str()));
  }
  pointers.push_back(nullptr);
  const SpawnActions actions(options);
  const SpawnAttributes attributes;
  if (posix_spawnp(&pid_, pointers[0], actions.get(), attributes.get(), pointers.data(), environ) !=
      0) {
    pid_ = -1;
    exit_code_ = -1;
  }
}

ChildProcess::~ChildProcess() {
  if (pid_ <= 0) return;
  kill(-pid_, SIGKILL);
  wait();
}

bool ChildProcess::is_running() { return !reap(WNOHANG); }

void ChildProcess::send(int signal) {
  if (is_running()) kill(pid_, signal);
}

void ChildProcess::send_to_group(int signal) {
  if (pid_ > 0) kill(-pid_, signal);
}

bool ChildProcess::group_is_left() const {
  return exit_code_ && pid_ > 0 && (kill(-pid_, 0) == 0 || errno != ESRCH);
}

int ChildProcess::wait() { return reap(0).value_or(-1); }

std::optional<int> ChildProcess::wait_for(std::chrono::milliseconds timeout) {
  wait_until([this] { return !is_running(); }, timeout);
  return exit_code_;
}

std::optional<int> ChildProcess::reap(int options) {
  int status = 0;
  if (!exit_code_ && waitpid(pid_, &status, options) == pid_) {
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  return exit_code_;
}

Finished run_program(const std::vector<std::string>& arguments, const ChildOptions& options,
                     std::chrono::seconds time) {
  const TemporaryFolder folder;
  ChildOptions captured = options;
  captured.output = folder / "output";
  captured.errors = folder / "errors";
  ChildProcess child(arguments, captured);
  Finished finished;
  finished.exit_code = child.wait_for(time).value_or(-1);
  finished.output = read_text(captured.output);
  finished.errors = read_text(captured.errors);
  return finished;
}

}  // namespace puck
