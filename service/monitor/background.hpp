/// Threads that others come before.
#pragma once

namespace gyrod::monitor {

/// Where processors are short, the calling thread gets about a third of what each of the others gets.
void run_in_background() noexcept;

}  // namespace gyrod::monitor
