// SPDX-License-Identifier: Apache-2.0
// The operations of term programs (envs/tasks/terms/term_program.h), each over all lanes of a part
// of a tile (see simd/dispatch.h). What the built-in tasks compute is computed as they do: a task
// of the same terms has the same bits.

#include "envs/tasks/terms/term_program.h"

#if defined(SKEIN_ENVS_TASKS_TERMS_TERM_OPERATIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_TASKS_TERMS_TERM_OPERATIONS_INL_H_
#undef SKEIN_ENVS_TASKS_TERMS_TERM_OPERATIONS_INL_H_
#else
#define SKEIN_ENVS_TASKS_TERMS_TERM_OPERATIONS_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/kernels/atmosphere-inl.h"
#include "envs/tasks/flight-inl.h"
#include "envs/tasks/point-inl.h"
#include "envs/tasks/relative_attitude-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// Aircraft that a program is run over at a time: few enough that all registers stay in the
/// innermost cache, many enough that finding the next operation costs nothing.
inline constexpr int kTermPart = 64;

/// Consecutive aircraft of a tile and their registers.
struct TermPart {
  const TermProgram& program;
  const KernelAircraft& aircraft;
  const Tile& flight;
  const Tile& task;
  int begin, count;
  float* registers;

  HWY_INLINE V Get(int number, int i) const {
    return hn::Load(FloatTag(), registers + number * kTermPart + i);
  }
  HWY_INLINE void Set(int number, int i, V value) const {
    hn::Store(value, FloatTag(), registers + number * kTermPart + i);
  }
};

/// Calls visit(i, first) for the groups of lanes: `i` in the part, `first` in the tile.
template <class Visit>
HWY_INLINE void ForLanes(const TermPart& part, const Visit& visit) {
  for (int i = 0; i < part.count; i += kLanes) visit(i, part.begin + i);
}

/// out = function(i, first).
template <class Function>
HWY_INLINE void SetLanes(const TermPart& part, int out, const Function& function) {
  ForLanes(part, [&](int i, int first) HWY_ATTR { part.Set(out, i, function(i, first)); });
}

/// Truth values are all bits of a lane or none.
template <class Function>
HWY_INLINE void AndLanes(const TermPart& part, int out, const Function& function) {
  SetLanes(part, out, [&](int i, int first) HWY_ATTR {
    return hn::And(part.Get(out, i), hn::VecFromMask(FloatTag(), function(i, first)));
  });
}

HWY_INLINE void SetAttitude(const TermPart& part, int out) {
  ForLanes(part, [&](int i, int first) HWY_ATTR {
    const DownInBody down = Down(part.flight, first);
    V cos_pitch, per_cos_pitch;
    Length(hn::MulAdd(down.y, down.y, hn::Mul(down.z, down.z)), cos_pitch, per_cos_pitch);
    part.Set(out, i, hn::Mul(down.y, per_cos_pitch));
    part.Set(out + 1, i, hn::Mul(down.z, per_cos_pitch));
    part.Set(out + 2, i, down.sin_pitch);
    part.Set(out + 3, i, cos_pitch);
  });
}

HWY_INLINE void SetAirVelocity(const TermPart& part, int out) {
  ForLanes(part, [&](int i, int first) HWY_ATTR {
    const VelocityVectors velocity = Velocity(part.flight, first);
    part.Set(out, i, velocity.speed);
    part.Set(out + 1, i, hn::Mul(velocity.air.w, velocity.per_forward));
    part.Set(out + 2, i, hn::Mul(velocity.air.u, velocity.per_forward));
    part.Set(out + 3, i, hn::Mul(velocity.air.v, velocity.per_speed));
    part.Set(out + 4, i, hn::Mul(velocity.forward, velocity.per_speed));
  });
}

HWY_INLINE void SetAirData(const TermPart& part, int out, int speed) {
  const FloatTag d;
  ForLanes(part, [&](int i, int first) HWY_ATTR {
    const V altitude = hn::Neg(Column(part.flight, kDown, first));
    const auto air = AirAtAltitude(d, part.aircraft, altitude);
    V equivalent_ratio, true_ratio;
    Length(hn::Mul(air.density, Constant(1 / part.aircraft.atmosphere.sea_level_density)),
           equivalent_ratio, true_ratio);
    part.Set(out, i, hn::Mul(part.Get(speed, i), equivalent_ratio));
    part.Set(out + 1, i, true_ratio);
    part.Set(out + 2, i, hn::Mul(part.Get(speed, i), ReciprocalSqrt(d, air.sound_speed_squared)));
  });
}

HWY_INLINE V TerrainOf(const TermPart& part, V north, V east) {
  V height = Constant(part.program.terrain_base);
  for (const TermWave& wave : part.program.terrain) {
    const V angle = hn::MulAdd(north, Constant(wave.per_north),
                               hn::MulAdd(east, Constant(wave.per_east), Constant(wave.phase)));
    V sine, cosine;
    SinCos(FloatTag(), WrapAngle(angle), sine, cosine);
    height = hn::MulAdd(Constant(wave.height), sine, height);
  }
  return height;
}

/// What values of a flight are.
HWY_INLINE void ReadFlight(const TermInstruction& op, const TermPart& part) {
  switch (op.operation) {
    case TermOperation::kFlightColumn:
      return SetLanes(part, op.out,
                      [&](int, int first) HWY_ATTR { return Column(part.flight, op.a, first); });
    case TermOperation::kMinusColumn:
      return SetLanes(part, op.out, [&](int, int first) HWY_ATTR {
        return hn::Neg(Column(part.flight, op.a, first));
      });
    case TermOperation::kWindColumn:
      return SetLanes(part, op.out, [&](int, int first) HWY_ATTR {
        return part.flight.windy ? Column(part.flight, op.a, first) : hn::Zero(FloatTag());
      });
    case TermOperation::kTaskColumn:
      return SetLanes(part, op.out,
                      [&](int, int first) HWY_ATTR { return Column(part.task, op.a, first); });
    case TermOperation::kAttitude:
      return SetAttitude(part, op.out);
    case TermOperation::kPitch:
      return SetLanes(part, op.out,
                      [&](int, int first) HWY_ATTR { return Pitch(part.flight, first); });
    case TermOperation::kYaw:
      return SetLanes(part, op.out,
                      [&](int, int first) HWY_ATTR { return Yaw(part.flight, first); });
    case TermOperation::kRoll:
      return SetLanes(part, op.out, [&](int, int first) HWY_ATTR {
        const DownInBody down = Down(part.flight, first);
        return Atan2(FloatTag(), down.y, down.z);
      });
    case TermOperation::kAirVelocity:
      return SetAirVelocity(part, op.out);
    case TermOperation::kAirData:
      return SetAirData(part, op.out, op.a);
    case TermOperation::kClimbRate:
      return SetLanes(part, op.out,
                      [&](int, int first) HWY_ATTR { return ClimbRate(part.flight, first); });
    default:
      return;
  }
}

HWY_INLINE void SetPointPath(const TermInstruction& op, const TermPart& part) {
  ForLanes(part, [&](int i, int first) HWY_ATTR {
    PointError error{part.Get(op.a, i), part.Get(op.b, i), part.Get(op.c, i)};
    TurnIntoPath(part.flight, first, error);
    part.Set(op.out, i, error.north);
    part.Set(op.out + 1, i, error.east);
    part.Set(op.out + 2, i, error.up);
  });
}

HWY_INLINE void RememberPoint(const TermInstruction& op, const TermPart& part) {
  const FloatTag d;
  ForLanes(part, [&](int, int first) HWY_ATTR {
    hn::StoreU(Column(part.flight, kNorth, first), d, part.task[op.a] + first);
    hn::StoreU(Column(part.flight, kEast, first), d, part.task[op.a + 1] + first);
    hn::StoreU(hn::Neg(Column(part.flight, kDown, first)), d, part.task[op.a + 2] + first);
  });
}

/// What is seen from the flight of the task's targets and terrain.
HWY_INLINE void Relate(const TermInstruction& op, const TermPart& part) {
  switch (op.operation) {
    case TermOperation::kTerrain:
      return SetLanes(part, op.out, [&](int i, int) HWY_ATTR {
        return TerrainOf(part, part.Get(op.a, i), part.Get(op.b, i));
      });
    case TermOperation::kPointHeading:
      return ForLanes(part, [&](int i, int first) HWY_ATTR {
        V ahead = part.Get(op.a, i), right = part.Get(op.b, i);
        TurnIntoHeading(part.flight, first, ahead, right);
        part.Set(op.out, i, ahead);
        part.Set(op.out + 1, i, right);
      });
    case TermOperation::kPointPath:
      return SetPointPath(op, part);
    case TermOperation::kNoseAngle:
      return SetLanes(part, op.out, [&](int, int first) HWY_ATTR {
        return NoseAngle(RelativeTo(part.flight, part.task, op.a, first));
      });
    case TermOperation::kAttitudeAngle:
      return SetLanes(part, op.out, [&](int, int first) HWY_ATTR {
        return RotationAngle(RelativeTo(part.flight, part.task, op.a, first));
      });
    case TermOperation::kRememberPoint:
      return RememberPoint(op, part);
    default:
      return;
  }
}

/// Arithmetic on registers.
HWY_INLINE void Compute(const TermInstruction& op, const TermPart& part) {
  const FloatTag d;
  const V x = Constant(op.x), y = Constant(op.y);
  const auto a = [&](int i) HWY_ATTR { return part.Get(op.a, i); };
  const auto set = [&](const auto& function) HWY_ATTR {
    SetLanes(part, op.out, [&](int i, int) HWY_ATTR { return function(i); });
  };
  switch (op.operation) {
    case TermOperation::kConstant:
      return set([&](int) HWY_ATTR { return x; });
    case TermOperation::kAngle:
      return set([&](int i) HWY_ATTR { return Atan2(d, a(i), part.Get(op.b, i)); });
    case TermOperation::kSubtract:
      return set([&](int i) HWY_ATTR { return hn::Sub(a(i), part.Get(op.b, i)); });
    case TermOperation::kWrappedError:
      return set([&](int i) HWY_ATTR { return WrapAngle(hn::Sub(a(i), part.Get(op.b, i))); });
    case TermOperation::kScale:
      return set([&](int i) HWY_ATTR { return hn::Mul(a(i), x); });
    case TermOperation::kSquare:
      return set([&](int i) HWY_ATTR { return hn::Mul(a(i), a(i)); });
    case TermOperation::kAddSquare:
      return set([&](int i) HWY_ATTR { return hn::MulAdd(a(i), a(i), part.Get(op.out, i)); });
    case TermOperation::kRoot:
      return set([&](int i) HWY_ATTR { return hn::Sqrt(a(i)); });
    case TermOperation::kAbsolute:
      return set([&](int i) HWY_ATTR { return hn::Abs(a(i)); });
    case TermOperation::kGaussian:
      return set([&](int i) HWY_ATTR { return Exp(d, hn::Mul(x, hn::Mul(a(i), a(i)))); });
    case TermOperation::kTolerance:
      return set([&](int i) HWY_ATTR {
        const V beyond = hn::Mul(hn::Sub(hn::Abs(a(i)), x), y);
        // Not by Min and Max alone: they swallow a NaN.
        const V inside = hn::IfThenElse(hn::Lt(beyond, hn::Zero(d)), hn::Zero(d), beyond);
        return hn::IfThenElse(hn::Gt(inside, Constant(1)), hn::Zero(d),
                              hn::Sub(Constant(1), inside));
      });
    case TermOperation::kAddWeighted:
      return set([&](int i) HWY_ATTR { return hn::MulAdd(x, a(i), part.Get(op.out, i)); });
    default:
      return;
  }
}

/// Truth values.
HWY_INLINE void Decide(const TermInstruction& op, const TermPart& part) {
  const FloatTag d;
  const V x = Constant(op.x);
  const auto a = [&](int i) HWY_ATTR { return part.Get(op.a, i); };
  switch (op.operation) {
    case TermOperation::kAll:
      return SetLanes(part, op.out,
                      [&](int, int) HWY_ATTR { return hn::VecFromMask(d, hn::Eq(x, x)); });
    case TermOperation::kAndWithin:
      return AndLanes(part, op.out, [&](int i, int) HWY_ATTR {
        return hn::Lt(hn::Abs(a(i)), hn::Mul(part.Get(op.b, i), x));
      });
    case TermOperation::kAndBelow:
      return AndLanes(part, op.out, [&](int i, int) HWY_ATTR { return hn::Lt(a(i), x); });
    case TermOperation::kAndAbove:
      return AndLanes(part, op.out, [&](int i, int) HWY_ATTR { return hn::Gt(a(i), x); });
    case TermOperation::kAndBeyond:
      return AndLanes(part, op.out, [&](int i, int) HWY_ATTR { return hn::Gt(hn::Abs(a(i)), x); });
    case TermOperation::kAndBox:
      return AndLanes(part, op.out, [&](int i, int first) HWY_ATTR {
        const PointError end{a(i), part.Get(op.a + 1, i), part.Get(op.a + 2, i)};
        const auto last = [&](int axis) HWY_ATTR {
          return hn::Sub(Column(part.task, axis, first), Column(part.task, op.b + axis, first));
        };
        const PointError begin{last(0), last(1), last(2)};
        const V square = hn::MulAdd(end.north, end.north,
                                    hn::MulAdd(end.east, end.east, hn::Mul(end.up, end.up)));
        return TouchesBox(begin, end, Column(part.task, op.c, first), square);
      });
    case TermOperation::kEndWhere:
      return SetLanes(part, op.out, [&](int i, int) HWY_ATTR {
        return hn::IfThenElse(hn::MaskFromVec(a(i)), x, part.Get(op.out, i));
      });
    default:
      return;
  }
}

/// One operation on all lanes of the part.
HWY_INLINE void Execute(const TermInstruction& op, const TermPart& part) {
  if (op.operation < TermOperation::kTerrain) return ReadFlight(op, part);
  if (op.operation < TermOperation::kConstant) return Relate(op, part);
  if (op.operation < TermOperation::kAll) return Compute(op, part);
  Decide(op, part);
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_TASKS_TERMS_TERM_OPERATIONS_INL_H_
