#pragma once

/// Scheduling hints for the kernel. None needs a permission; a kernel that refuses one leaves
/// everything as it is.
namespace puck {

/// Requests short time slices for the calling thread and the threads that it starts afterwards.
/// They run soon after they wake up on a shared processor, because they need not wait for the end
/// of another thread's longer slice. Their share of the processor does not change. Kernels before
/// 6.12 ignore the request.
void take_short_turns();

/// Marks the calling thread as a batch thread: default time slices, woken up behind others, and at
/// most a tenth of the weight. It yields to any thread that wakes up, but does not starve beside a
/// busy process.
void take_turns_behind_others();

}  // namespace puck
