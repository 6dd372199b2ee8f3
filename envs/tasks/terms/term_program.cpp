// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/terms/term_program.h"

#include <algorithm>

#include "envs/kernels/kernel_aircraft.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/terms/term_program.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/tasks/terms/term_operations-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// Calls run(registers) for one part of the tile after another, with the registers full.
template <class Use>
HWY_INLINE void RunInParts(const TermProgram& program, const KernelAircraft& aircraft,
                           const Tile& flight, const Tile& task, const Use& use) {
  alignas(64) float registers[TermProgram::kMaxRegisters * kTermPart];
  for (int begin = 0; begin < flight.count; begin += kTermPart) {
    const TermPart part{program,  aircraft, flight,
                        task,     begin,    std::min(flight.count - begin, kTermPart),
                        registers};
    for (const TermInstruction& instruction : program.instructions) Execute(instruction, part);
    use(part);
  }
}

void RunProgram(const TermProgram& program, const KernelAircraft& aircraft, const Tile& flight,
                const Tile& task, const TermOutput& output) {
  const FloatTag d;
  RunInParts(program, aircraft, flight, task, [&](const TermPart& part) HWY_ATTR {
    float* column = output.columns + part.begin;
    for (const int result : program.results) {
      for (int i = 0; i < part.count; i += kLanes) hn::StoreU(part.Get(result, i), d, column + i);
      column += output.stride;
    }
  });
}

void RunReward(const TermProgram& program, const KernelAircraft& aircraft, const Tile& flight,
               const Tile& task, const std::int32_t* steps_before, int earliest_step,
               const StepResult& step_result) {
  const FloatTag d;
  const IntTag di;
  const auto one = hn::Set(di, 1), earliest = hn::Set(di, earliest_step - 1);
  RunInParts(program, aircraft, flight, task, [&](const TermPart& part) HWY_ATTR {
    for (int i = 0; i < part.count; i += kLanes) {
      const int first = part.begin + i;
      hn::StoreU(part.Get(program.results[kTermReward], i), d, step_result.reward + first);
      const auto reached = hn::BitCast(di, part.Get(program.results[kTermReached], i));
      const auto early = hn::Gt(earliest, hn::LoadU(di, steps_before + first));
      hn::StoreU(hn::And(hn::AndNot(hn::VecFromMask(di, early), reached), one), di,
                 step_result.reached + first);
      if (step_result.ends == nullptr) continue;
      hn::StoreU(hn::ConvertTo(di, part.Get(program.results[kTermEnd], i)), di,
                 step_result.ends + first);
    }
  });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(RunProgram);
HWY_EXPORT(RunReward);

void RunTermProgram(const TermProgram& program, const KernelAircraft& aircraft, const Tile& flight,
                    const Tile& task, const TermOutput& output) {
  SKEIN_DISPATCH(RunProgram)(program, aircraft, flight, task, output);
}

void RunTermReward(const TermProgram& program, const KernelAircraft& aircraft, const Tile& flight,
                   const Tile& task, const std::int32_t* steps_before, int earliest_step,
                   const StepResult& step_result) {
  SKEIN_DISPATCH(RunReward)
  (program, aircraft, flight, task, steps_before, earliest_step, step_result);
}

}  // namespace skein
#endif
