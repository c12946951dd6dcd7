#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace puck {

/// This user may not make networks, or has no ip(8).
struct NoNetwork : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Two networks in the kernel, as two machines have them, with a cable between them whose frames
/// hold 1500 bytes (network namespaces, veth). The thread that makes it is on the first machine, as
/// is all that it starts, until this object ends. One thread.
class TwoMachines {
 public:
  /// Throws NoNetwork.
  TwoMachines();
  ~TwoMachines();
  TwoMachines(const TwoMachines&) = delete;
  TwoMachines& operator=(const TwoMachines&) = delete;

  /// Calls `work` on the second machine.
  void on_second(const std::function<void()>& work) const;

 private:
  /// An open network of the kernel.
  class Network {
   public:
    Network() = default;
    ~Network();
    Network(const Network&) = delete;
    Network& operator=(const Network&) = delete;

    void open_own();
    void enter() const;
    /// A name for it that other processes understand, too.
    std::string path() const;

   private:
    int descriptor_ = -1;
  };

  Network home_;
  Network first_;
  Network second_;
};

}  // namespace puck
