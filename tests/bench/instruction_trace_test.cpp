// SPDX-License-Identifier: Apache-2.0
#include "bench/instruction_trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <numeric>
#include <string>

#include "base/error.h"
#include "tests/error_message.h"

namespace skein::bench {
namespace {

using ::testing::HasSubstr;

/// Skips where nothing can be traced, and says so.
class InstructionTrace : public testing::Test {
 protected:
  void SetUp() override {
    try {
      TraceInstructions([] {});
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  static std::int64_t Count(const std::function<void()>& work) {
    const InstructionCounts counts = TraceInstructions(work);
    return std::accumulate(
        counts.begin(), counts.end(), std::int64_t{0},
        [](std::int64_t sum, const auto& at_address) { return sum + at_address.second; });
  }

  /// As many rounds of a loop.
  static std::int64_t CountRounds(int rounds) {
    return Count([rounds] {
      volatile int sum = 0;
      for (int i = 0; i < rounds; ++i) sum = sum + i;
    });
  }
};

TEST_F(InstructionTrace, RoundsOfALoopCountAlike) {
  const std::int64_t one = CountRounds(11) - CountRounds(10);
  EXPECT_GT(one, 0);
  EXPECT_EQ(CountRounds(110) - CountRounds(10), 100 * one);
}

TEST_F(InstructionTrace, ARepeatedStringInstructionCountsOnce) {
#if defined(__x86_64__)
  const auto fill = [](std::size_t size) {
    return [size] {
      static char bytes[4096];
      void* to = bytes;
      std::size_t count = size;
      asm volatile("rep stosb" : "+D"(to), "+c"(count) : "a"(0) : "memory");
    };
  };
  EXPECT_EQ(Count(fill(4000)), Count(fill(2)));
#endif
}

TEST_F(InstructionTrace, SignalsThatAreIgnoredEndNothing) {
  const auto work = [](int signal) {
    return [signal] {
      raise(signal);
      volatile int sum = 0;
      for (int i = 0; i < 1000; ++i) sum = sum + i;
    };
  };
  EXPECT_GT(Count(work(SIGWINCH)), CountRounds(1000));
  const std::string message = MessageOf([&] { Count(work(SIGFPE)); });
  EXPECT_THAT(message, HasSubstr("got a signal: Floating point exception"));
}

TEST_F(InstructionTrace, WorkThatThrowsIsAnError) {
  EXPECT_THROW(Count([] { throw Error("no work"); }), Error);
}

}  // namespace
}  // namespace skein::bench
