// SPDX-License-Identifier: Apache-2.0
#include "envs/air/atmosphere.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "envs/aircraft/f16.h"
#include "envs/kernels/kernel_aircraft.h"
#include "envs/kernels/plant_kernel.h"
#include "gtest/gtest.h"
#include "simd/dispatch.h"
#include "tests/scoped_target.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/envs/kernels/atmosphere_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/kernels/atmosphere-inl.h"
#include "tests/extremes.h"
#include "tests/tolerance.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using Column = std::vector<float>;

/// `out`: density, temperature, sound speed, pressure.
void AirColumn(const KernelAircraft& aircraft, const Column& altitude, Column (&out)[4]) {
  const hn::ScalableTag<float> d;
  for (std::size_t i = 0; i < altitude.size(); i += hn::Lanes(d)) {
    const auto air = AirAtAltitude(d, aircraft, hn::LoadU(d, &altitude[i]));
    hn::StoreU(air.density, d, &out[0][i]);
    hn::StoreU(air.temperature, d, &out[1][i]);
    hn::StoreU(hn::Sqrt(air.sound_speed_squared), d, &out[2][i]);
    hn::StoreU(air.pressure, d, &out[3][i]);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
namespace {

HWY_EXPORT(AirColumn);

using Column = std::vector<float>;

class AtmosphereTest : public testing::TestWithParam<std::tuple<simd::Target, AtmosphereModel>> {
 protected:
  AtmosphereModel model() const { return std::get<1>(GetParam()); }

  /// Worst relative error of the four members between two altitudes.
  double WorstError(double low_ft, double high_ft) {
    constexpr int kCount = 1 << 16;
    Column altitude(kCount);
    Column out[] = {altitude, altitude, altitude, altitude};
    for (int i = 0; i < kCount; ++i) {
      altitude[i] = static_cast<float>(low_ft + (high_ft - low_ft) * i / (kCount - 1));
    }
    const auto aircraft = MakeKernelAircraft(F16(), model());
    SKEIN_DISPATCH(AirColumn)(*aircraft, altitude, out);
    double worst = 0;
    for (int i = 0; i < kCount; ++i) {
      const Air air = AirAt(model(), altitude[i]);
      const double exact[] = {air.density_slug_ft3, air.temperature_degR, air.sound_speed_ft_s,
                              air.pressure_lbf_ft2};
      for (int k = 0; k < 4; ++k) worst = Larger(worst, std::abs(out[k][i] / exact[k] - 1));
    }
    return worst;
  }

 private:
  ScopedTarget target_{std::get<0>(GetParam())};
};

TEST_P(AtmosphereTest, AgreesWithTheFloat64Model) {
  constexpr Tolerance kFloat32{2e-6, "float32 polynomials, relative"};
  constexpr Tolerance kFloat32Above{1e-5, "float32 exponentials of large arguments, relative"};
  EXPECT_LE(WorstError(-5000, 60000), kFloat32);
  EXPECT_LE(WorstError(60000, 100000), kFloat32Above);
}

INSTANTIATE_TEST_SUITE_P(EveryTarget, AtmosphereTest,
                         testing::Combine(testing::ValuesIn(simd::SupportedTargets()),
                                          testing::Values(AtmosphereModel::kStevensLewis,
                                                          AtmosphereModel::kStandard1976)),
                         [](const auto& test) {
                           return std::string(simd::Name(std::get<0>(test.param))) +
                                  (std::get<1>(test.param) == AtmosphereModel::kStevensLewis
                                       ? "StevensLewis"
                                       : "Standard1976");
                         });

}  // namespace
}  // namespace skein
#endif
