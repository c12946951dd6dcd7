#pragma once

/// How threads ask the kernel for the processor. Nothing here needs a permission, and a kernel that
/// refuses leaves everything as it is.
namespace puck {

/// Lets the calling thread, and those that it starts from then on, come first when they wake up on
/// a processor that others use, too: they ask for short turns of the processor, so that they need
/// not wait until somebody's longer one is over. They get no more of it than others. Kernels before
/// 6.12 take no notice.
void take_short_turns();

/// Makes the calling thread one that does long work whenever others leave it the processor: turns
/// of the usual length, woken up behind others, and of at most a tenth the weight when there is not
/// enough for all, which is little enough that whoever wakes up comes first at once, and enough not
/// to starve beside a busy process.
void take_turns_behind_others();

}  // namespace puck
