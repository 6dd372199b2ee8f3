// SPDX-License-Identifier: Apache-2.0
// Last phase of the plant kernel: the coefficients' build-up and the equations of motion. The laws
// are those of envs/reference/aerodynamics.cpp and envs/reference/plant.cpp.

#if defined(SKEIN_ENVS_KERNELS_PLANT_KERNEL_EQUATIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_KERNELS_PLANT_KERNEL_EQUATIONS_INL_H_
#undef SKEIN_ENVS_KERNELS_PLANT_KERNEL_EQUATIONS_INL_H_
#else
#define SKEIN_ENVS_KERNELS_PLANT_KERNEL_EQUATIONS_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/kernels/plant_kernel_block-inl.h"
#include "envs/state/air_velocity-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace plant_kernel {

struct Coefficients {
  V Cx, Cy, Cz, Cl, Cm, Cn;
};

/// Evaluates what ReadTables left for one vector of aircraft.
struct CoefficientReader {
  const KernelBlock& block;
  int lane;
  V alpha_fraction, beta_fraction;

  template <PatchSet kSet>
  HWY_INLINE V Patch(int place) const {
    const FloatTag d;
    const auto term = [&](PatchTerm which) HWY_ATTR {
      return hn::Load(d, block.patch[kSet][which * kPatchesPerLine + place] + lane);
    };
    const V low = hn::MulAdd(alpha_fraction, term(kAlongAlpha), term(kCorner));
    const V step = hn::MulAdd(alpha_fraction, term(kAlongBoth), term(kAlongBeta));
    return hn::MulAdd(beta_fraction, step, low);
  }
  HWY_INLINE V Alpha(AlphaFunction function) const {
    const FloatTag d;
    return hn::MulAdd(alpha_fraction, hn::Load(d, block.alpha_step[function] + lane),
                      hn::Load(d, block.alpha_value[function] + lane));
  }
};

/// Cm about the cg but its damping; `Cz` is whole. The cg's shift acts by the forces.
template <class Plant>
HWY_INLINE V StaticPitchingMoment(const KernelConstants& k, const Plant& plant,
                                  const CoefficientReader& c, V Cz) {
  const V elevator_effect = hn::Load(FloatTag(), c.block.elevator_effect + c.lane);
  const V Cm = hn::MulAdd(elevator_effect, c.Patch<kLongitudinal>(kPatchCm), c.Alpha(kAlphaCm));
  const V flap = c.Patch<kLateral>(kPatchCmFlap);
  if constexpr (Plant::kDrawn) {
    const V shift = hn::Sub(Constant(k.cg_shift), plant.Get(kPlantCgShift, c.lane));
    return hn::MulAdd(Cz, shift, plant.Scaled(kPlantPitchingMoment, c.lane, hn::Add(Cm, flap)));
  } else {
    return hn::Add(hn::MulAdd(Cz, Constant(k.cg_shift), Cm), flap);
  }
}

/// What Cn loses by Cy, since moments are taken elsewhere than at the cg.
template <class Plant>
HWY_INLINE V CgShiftYaw(const KernelConstants& k, const Plant& plant, int lane) {
  const V shift = Constant(k.cg_shift_yaw);
  if constexpr (Plant::kDrawn) {
    return hn::NegMulAdd(plant.Get(kPlantCgShift, lane), Constant(k.chord_per_span), shift);
  } else {
    return shift;
  }
}

/// One of the engine's gyroscopic terms: as configured, or of the drawn momentum.
template <class Plant>
HWY_INLINE V EngineTerm(const Plant& plant, int lane, float configured, float per_momentum) {
  if constexpr (Plant::kDrawn) {
    return hn::Mul(plant.Get(kPlantEngineMomentum, lane), Constant(per_momentum));
  } else {
    return Constant(configured);
  }
}

template <class State>
HWY_INLINE Coefficients EvaluateAerodynamics(const KernelConstants& k, const State& state, int lane,
                                             const KernelBlock& block) {
  const FloatTag d;
  const CoefficientReader c{block, lane, hn::Load(d, block.alpha_fraction + lane),
                            hn::Load(d, block.beta_fraction + lane)};
  const auto& plant = state.plant;
  // The rates made dimensionless stand before every damping, and nowhere else.
  const V inverse_speed =
      plant.Scaled(kPlantDamping, lane, hn::Load(d, block.inverse_speed + lane));
  const V half_span = hn::Mul(inverse_speed, Constant(k.half_span));
  const V p_hat = hn::Mul(state.RateThroughAir(kP, lane), half_span);
  const V q_hat =
      hn::Mul(state.RateThroughAir(kQ, lane), hn::Mul(inverse_speed, Constant(k.half_chord)));
  const V r_hat = hn::Mul(state.RateThroughAir(kR, lane), half_span);

  Coefficients sum;
  const V Cx = plant.Scaled(kPlantAxialForce, lane, c.Patch<kLongitudinal>(kPatchCx));
  sum.Cx = hn::MulAdd(q_hat, c.Alpha(kAlphaCxq), Cx);
  const V Cz = plant.Scaled(kPlantNormalForce, lane, c.Patch<kLongitudinal>(kPatchCz));
  sum.Cz = hn::MulAdd(q_hat, c.Alpha(kAlphaCzq), Cz);
  sum.Cm = hn::MulAdd(q_hat, c.Alpha(kAlphaCmq), StaticPitchingMoment(k, plant, c, sum.Cz));

  const auto lateral = [&](LateralPatch patch) HWY_ATTR {
    return plant.Scaled(kPlantLateral, lane, c.Patch<kLateral>(patch));
  };
  sum.Cy = hn::MulAdd(r_hat, c.Alpha(kAlphaCyr), lateral(kPatchCy));
  sum.Cy = hn::MulAdd(p_hat, c.Alpha(kAlphaCyp), sum.Cy);
  sum.Cn = hn::NegMulAdd(sum.Cy, CgShiftYaw(k, plant, lane), lateral(kPatchCn));
  sum.Cn = hn::MulAdd(r_hat, c.Alpha(kAlphaCnr), sum.Cn);
  sum.Cn = hn::MulAdd(p_hat, c.Alpha(kAlphaCnp), sum.Cn);
  sum.Cl = hn::MulAdd(r_hat, c.Alpha(kAlphaClr), lateral(kPatchCl));
  sum.Cl = hn::MulAdd(p_hat, c.Alpha(kAlphaClp), sum.Cl);
  return sum;
}

/// Rates of the thirteen rigid-body columns for the aircraft in lanes `lane` to `lane + kLanes`.
template <class State>
HWY_INLINE void EquationsOfMotion(const KernelConstants& k, const State& state,
                                  const Coefficients& c, int lane, const KernelBlock& block) {
  const FloatTag d;
  const auto put = [&](int column, V rate) HWY_ATTR { state.Put(column, lane, rate); };
  const V u = state.Get(kU, lane), v = state.Get(kV, lane), w = state.Get(kW, lane);
  const V p = state.Get(kP, lane), q = state.Get(kQ, lane), r = state.Get(kR, lane);
  const V q0 = state.Get(kQ0, lane), qx = state.Get(kQx, lane);
  const V qy = state.Get(kQy, lane), qz = state.Get(kQz, lane);
  const V qbar_S = hn::Load(d, block.qbar_S + lane);

  const AttitudeMatrix<V> t = AttitudeMatrixOf(q0, qx, qy, qz);
  const V gravity = hn::Load(d, block.gravity + lane);
  const V inverse_mass = state.plant.Scaled(kPlantInverseMass, lane, Constant(k.inverse_mass));
  const V per_mass = hn::Mul(qbar_S, inverse_mass);
  const V thrust = hn::Mul(hn::Load(d, block.thrust + lane), inverse_mass);
  V rate = hn::MulAdd(gravity, t.t13, hn::MulAdd(r, v, hn::MulAdd(per_mass, c.Cx, thrust)));
  put(kU, hn::NegMulAdd(q, w, rate));
  rate = hn::MulAdd(gravity, t.t23, hn::MulAdd(p, w, hn::Mul(per_mass, c.Cy)));
  put(kV, hn::NegMulAdd(r, u, rate));
  rate = hn::MulAdd(gravity, t.t33, hn::MulAdd(q, u, hn::Mul(per_mass, c.Cz)));
  put(kW, hn::NegMulAdd(p, v, rate));

  const V per_inertia = state.plant.Scaled(kPlantInverseInertia, lane, qbar_S);
  const V qbar_S_Cl = hn::Mul(per_inertia, c.Cl), qbar_S_Cn = hn::Mul(per_inertia, c.Cn);
  const auto engine = [&](float configured, float per_momentum) HWY_ATTR {
    return EngineTerm(state.plant, lane, configured, per_momentum);
  };
  rate = hn::MulAdd(qbar_S_Cl, Constant(k.p_Cl), hn::Mul(qbar_S_Cn, Constant(k.p_Cn)));
  V gyration = hn::MulAdd(p, Constant(k.p_pq),
                          hn::MulAdd(r, Constant(k.p_qr), engine(k.p_q, k.p_q_per_momentum)));
  put(kP, hn::MulAdd(q, gyration, rate));
  rate = hn::MulAdd(qbar_S_Cn, Constant(k.r_Cn), hn::Mul(qbar_S_Cl, Constant(k.r_Cl)));
  gyration = hn::MulAdd(p, Constant(k.r_pq),
                        hn::MulAdd(r, Constant(k.r_qr), engine(k.r_q, k.r_q_per_momentum)));
  put(kR, hn::MulAdd(q, gyration, rate));
  rate = hn::Mul(hn::Mul(per_inertia, c.Cm), Constant(k.q_Cm));
  rate = hn::MulAdd(r, hn::MulAdd(p, Constant(k.q_pr), engine(k.q_r, k.q_r_per_momentum)), rate);
  put(kQ, hn::NegMulAdd(Constant(k.q_pp), hn::NegMulAdd(r, r, hn::Mul(p, p)), rate));

  put(kNorth, hn::MulAdd(t.t31, w, hn::MulAdd(t.t21, v, hn::Mul(t.t11, u))));
  put(kEast, hn::MulAdd(t.t32, w, hn::MulAdd(t.t22, v, hn::Mul(t.t12, u))));
  put(kDown, hn::MulAdd(t.t33, w, hn::MulAdd(t.t23, v, hn::Mul(t.t13, u))));

  const V half = Constant(0.5f);
  const V hp = hn::Mul(p, half), hq = hn::Mul(q, half), hr = hn::Mul(r, half);
  state.PutAttitude(lane, hn::Neg(hn::MulAdd(hp, qx, hn::MulAdd(hq, qy, hn::Mul(hr, qz)))),
                    hn::MulAdd(hp, q0, hn::NegMulAdd(hq, qz, hn::Mul(hr, qy))),
                    hn::MulAdd(hq, q0, hn::NegMulAdd(hr, qx, hn::Mul(hp, qz))),
                    hn::MulAdd(hr, q0, hn::NegMulAdd(hp, qy, hn::Mul(hq, qx))));
}

/// Rates at one stage. `coefficients(lane, Coefficients)` is given what they come from.
template <class State, class Observer>
HWY_INLINE void EvaluateStateRates(const KernelConstants& k, const State& state,
                                   const KernelBlock& block, const Observer& coefficients) {
  for (int lane = 0; lane < kLanesPerBlock; lane += kLanes) {
    const Coefficients c = EvaluateAerodynamics(k, state, lane, block);
    coefficients(lane, c);
    EquationsOfMotion(k, state, c, lane, block);
  }
}

}  // namespace plant_kernel
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_KERNELS_PLANT_KERNEL_EQUATIONS_INL_H_
