// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>

namespace skein::bench {

/// How often the instruction at an address was executed.
using InstructionCounts = std::map<std::uintptr_t, std::int64_t>;

/// Runs `work` in a child process, one instruction at a time (ptrace), and counts them, for every
/// instruction set that the processor has; about 10^6 times slower than the work. A repeated string
/// instruction counts once. Of `work` nothing is left in this process. Throws Error where processes
/// must not be traced, off x86-64, and if the work throws or a signal ends it.
InstructionCounts TraceInstructions(const std::function<void()>& work);

}  // namespace skein::bench
