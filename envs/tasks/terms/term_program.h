// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "envs/state/state.h"
#include "envs/tasks/task.h"
#include "envs/tasks/terms/term_task_config.h"

namespace skein {

struct KernelAircraft;  // envs/kernels/kernel_aircraft.h

/// What one operation of a program does, on all aircraft of a tile at once. `out`, `a`, `b`, `c`
/// are registers (a column of floats each) unless it says otherwise; x and y are its constants.
enum class TermOperation : std::uint8_t {
  // Reads of the flight.
  kFlightColumn,  ///< flight column a
  kMinusColumn,   ///< less flight column a
  kWindColumn,    ///< the same of windy tiles, 0 in still air
  kTaskColumn,    ///< task column a
  kAttitude,      ///< out..out+3: sin, cos of roll, sin, cos of pitch
  kRoll,
  kPitch,
  kYaw,          ///< rad
  kAirVelocity,  ///< out..out+4: true airspeed, sin, cos of alpha, sin, cos of beta
  kAirData,      ///< out..out+2: of the true airspeed a: equivalent airspeed, ratio, Mach
  kClimbRate,    ///< over the ground, ft/s
  // What it is to targets and terrain.
  kTerrain,        ///< at north a, east b, ft
  kPointHeading,   ///< out, out+1: ahead and right, of north a and east b
  kPointPath,      ///< out..out+2: along, right of, above the path, of north a, east b, up c
  kNoseAngle,      ///< to the quaternion in task columns a..a+3, rad
  kAttitudeAngle,  ///< the same of the whole attitude
  kRememberPoint,  ///< task columns a..a+2 become north, east, altitude
  // Arithmetic.
  kConstant,      ///< x
  kAngle,         ///< of the sine a and the cosine b, rad
  kSubtract,      ///< a - b
  kWrappedError,  ///< a - b, the short way round
  kScale,         ///< x a
  kSquare,        ///< a^2
  kAddSquare,     ///< out + a^2
  kRoot,          ///< of a
  kAbsolute,      ///< abs(a)
  kGaussian,      ///< exp(x a^2)
  kTolerance,     ///< 1 up to abs(a) = x, falling by y per unit to 0
  kAddWeighted,   ///< out + x a
  // Truth values: all bits of a lane or none.
  kAll,        ///< true
  kAndWithin,  ///< out and abs(a) < x b
  kAndBelow,   ///< out and a < x
  kAndAbove,   ///< out and a > x
  kAndBeyond,  ///< out and abs(a) > x
  kAndBox,     ///< out and the path from task columns b..b+2 to the errors a..a+2 touches the box
               ///< around task columns 0..2 of the tolerance in task column c
  kEndWhere,   ///< x where a holds, else out
};

struct TermInstruction {
  TermOperation operation;
  int out = 0;
  int a = 0, b = 0, c = 0;
  float x = 0, y = 0;
};

/// A wave of the terrain as kernels take it.
struct TermWave {
  float height = 0, per_north = 0, per_east = 0, phase = 0;
};

/// A flat list of operations on registers, made once of a task's terms.
struct TermProgram {
  static constexpr int kMaxRegisters = 160;

  std::vector<TermInstruction> instructions;
  int num_registers = 0;
  std::vector<int> results;  ///< registers that it is for
  float terrain_base = 0;
  std::vector<TermWave> terrain;
};

/// Columns that a program writes, `stride` apart, one of each of its results.
struct TermOutput {
  float* columns = nullptr;
  std::size_t stride = 0;
};

/// Runs a program over a tile; `aircraft` is for its atmosphere.
void RunTermProgram(const TermProgram& program, const KernelAircraft& aircraft, const Tile& flight,
                    const Tile& task, const TermOutput& output);

/// What a program for rewards has as its results, in their order.
enum TermRewardResult : int {
  kTermReward,
  kTermReached,  ///< all bits of a lane or none
  kTermEnd       ///< a Termination as a number
};

/// Runs a program whose results are those of TermRewardResult. Nothing is reached before the
/// episode's control step `earliest_step`.
void RunTermReward(const TermProgram& program, const KernelAircraft& aircraft, const Tile& flight,
                   const Tile& task, const std::int32_t* steps_before, int earliest_step,
                   const StepResult& step_result);

}  // namespace skein
