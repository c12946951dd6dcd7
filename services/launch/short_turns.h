#pragma once

namespace puck {

/// Lets the calling thread, and those that it starts from then on, come first when they wake up on
/// a processor that others use, too: they ask for short turns of the processor, so that they need
/// not wait until somebody's longer one is over. They get no more of it than others. Needs no
/// permission; kernels before 6.12 take no notice.
void take_short_turns();

}  // namespace puck
