// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "gtest/gtest.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/simd/math_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/math-inl.h"
#include "tests/extremes.h"
#include "tests/tolerance.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

V SinOfBits(D d, V x) {
  V s, c;
  SinCosOfBits(d, hn::BitCast(hn::RebindToUnsigned<D>(), x), s, c);
  return s;
}
V CosOfBits(D d, V x) {
  V s, c;
  SinCosOfBits(d, hn::BitCast(hn::RebindToUnsigned<D>(), x), s, c);
  return c;
}

V ClampToRange(D d, V x) { return ClampTo(d, x, -1, 2); }

V SinOf(D d, V x) {
  V s, c;
  SinCos(d, x, s, c);
  return s;
}
V CosOf(D d, V x) {
  V s, c;
  SinCos(d, x, s, c);
  return c;
}

using Unary = V (*)(D, V);
using Binary = V (*)(D, V, V);

void Apply(Unary f, const std::vector<float>& x, std::vector<float>& y) {
  const D d;
  for (std::size_t i = 0; i < x.size(); i += hn::Lanes(d)) {
    hn::StoreU(f(d, hn::LoadU(d, &x[i])), d, &y[i]);
  }
}
void Apply(Binary f, const std::vector<float>& x, const std::vector<float>& y,
           std::vector<float>& z) {
  const D d;
  for (std::size_t i = 0; i < x.size(); i += hn::Lanes(d)) {
    hn::StoreU(f(d, hn::LoadU(d, &x[i]), hn::LoadU(d, &y[i])), d, &z[i]);
  }
}

using Column = std::vector<float>;
void ClampColumn(const Column& x, Column& y) { Apply(ClampToRange, x, y); }
void ReciprocalColumn(const Column& x, Column& y) { Apply(Reciprocal<D>, x, y); }
void ReciprocalSqrtColumn(const Column& x, Column& y) { Apply(ReciprocalSqrt<D>, x, y); }
void AtanDegreesColumn(const Column& x, Column& y) { Apply(AtanDegrees<D>, x, y); }
void SinOfBitsColumn(const Column& x, Column& y) { Apply(SinOfBits, x, y); }
void CosOfBitsColumn(const Column& x, Column& y) { Apply(CosOfBits, x, y); }
void SinColumn(const Column& x, Column& y) { Apply(SinOf, x, y); }
void CosColumn(const Column& x, Column& y) { Apply(CosOf, x, y); }
void ExpColumn(const Column& x, Column& y) { Apply(Exp<D>, x, y); }
void LogColumn(const Column& x, Column& y) { Apply(Log<D>, x, y); }
void Atan2DegreesColumn(const Column& y, const Column& x, Column& z) {
  Apply(Atan2Degrees<D>, y, x, z);
}
void Atan2Column(const Column& y, const Column& x, Column& z) { Apply(Atan2<D>, y, x, z); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
namespace {

HWY_EXPORT(ClampColumn);
HWY_EXPORT(ReciprocalColumn);
HWY_EXPORT(ReciprocalSqrtColumn);
HWY_EXPORT(AtanDegreesColumn);
HWY_EXPORT(SinOfBitsColumn);
HWY_EXPORT(CosOfBitsColumn);
HWY_EXPORT(SinColumn);
HWY_EXPORT(CosColumn);
HWY_EXPORT(ExpColumn);
HWY_EXPORT(LogColumn);
HWY_EXPORT(Atan2DegreesColumn);
HWY_EXPORT(Atan2Column);

using Column = std::vector<float>;
using ColumnFunction = void (*)(const Column&, Column&);

// The errors that simd/math-inl.h promises, in ULP or absolute.
constexpr Tolerance kReciprocal{2, "ULP, float32 rounding of Newton's step"};
constexpr Tolerance kArcTangent{4, "ULP, float32 polynomial"};
constexpr Tolerance kQuotientArcTangent{5, "ULP, float32 polynomial of a quotient"};
constexpr Tolerance kExpAndLog{2, "ULP, float32 polynomial"};
constexpr Tolerance kBitAngle{1.2e-7, "float32 polynomial of an exact angle"};
constexpr Tolerance kSine{2e-7, "float32 polynomial of a reduced angle"};
constexpr Tolerance kExponent{1e-5, "float32 rounding of 88"};
constexpr Tolerance kDegrees{3e-5, "float32 rounding of 180 deg"};
constexpr Tolerance kRadians{5e-7, "float32 rounding of pi"};

constexpr double kRadToDeg = 57.295779513082320877;
constexpr int kSamples = 1 << 18;  // a multiple of every vector length

/// Runs each test once per supported target.
class MathTest : public testing::TestWithParam<simd::Target> {
 protected:
  void SetUp() override { simd::ForceTarget(GetParam()); }
  void TearDown() override { simd::ForceTarget(before_); }

 private:
  const simd::Target before_ = simd::ActiveTarget();
};

Column Linear(double low, double high) {
  Column x(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    x[i] = static_cast<float>(low + (high - low) * i / (kSamples - 1));
  }
  return x;
}

Column Geometric(double low, double high) {
  Column x(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    x[i] = static_cast<float>(low * std::pow(high / low, static_cast<double>(i) / (kSamples - 1)));
  }
  return x;
}

double Ulp(double exact) {
  const float magnitude = std::abs(static_cast<float>(exact));
  return static_cast<double>(std::nextafter(magnitude, std::numeric_limits<float>::infinity())) -
         static_cast<double>(magnitude);
}

double WorstUlp(ColumnFunction function, const std::function<double(double)>& exact,
                const Column& x) {
  Column y(x.size());
  function(x, y);
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double expected = exact(x[i]);
    worst = Larger(worst, std::abs(y[i] - expected) / Ulp(expected));
  }
  return worst;
}

double WorstAbsolute(ColumnFunction function, const std::function<double(double)>& exact,
                     const Column& x) {
  Column y(x.size());
  function(x, y);
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    worst = Larger(worst, std::abs(y[i] - exact(x[i])));
  }
  return worst;
}

TEST_P(MathTest, ClampToLimitsToItsRangeAndNaNToItsLowerEnd) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Column x = {-kInfinity,     -5, -1, -0.5f, 0, 0.5f, 2, 7, kInfinity, std::nanf(""),
                    -std::nanf(""), 1,  1,  1,     1, 1};
  const Column expected = {-1, -1, -1, -0.5f, 0, 0.5f, 2, 2, 2, -1, -1, 1, 1, 1, 1, 1};
  Column y(x.size());
  SKEIN_DISPATCH(ClampColumn)(x, y);
  EXPECT_EQ(y, expected);
}

TEST_P(MathTest, Reciprocal) {
  const auto exact = [](double x) { return 1 / x; };
  const auto function = SKEIN_DISPATCH(ReciprocalColumn);
  EXPECT_LE(WorstUlp(function, exact, Geometric(0x1p-125, 0x1p125)), kReciprocal);
  EXPECT_LE(WorstUlp(function, exact, Linear(-2, -1)), kReciprocal);
}

/// As a sigmoid asks for: 1 / (1 + exp(87)).
TEST_P(MathTest, ReciprocalsOfTheLargestNumbersAreNext0) {
  constexpr double kSmallestNormal = 0x1p-126;
  const auto function = SKEIN_DISPATCH(ReciprocalColumn);
  const Column x = Geometric(0x1p125, 0x1.fp127);
  Column y(x.size());
  function(x, y);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_GE(y[i], 0) << x[i];
    EXPECT_LE(y[i], 4 * kSmallestNormal) << x[i];
  }
}

TEST_P(MathTest, ReciprocalSqrt) {
  const auto exact = [](double x) { return 1 / std::sqrt(x); };
  const auto function = SKEIN_DISPATCH(ReciprocalSqrtColumn);
  EXPECT_LE(WorstUlp(function, exact, Geometric(0x1p-125, 0x1p125)), kReciprocal);
  EXPECT_LE(WorstUlp(function, exact, Linear(1, 4)), kReciprocal);
}

TEST_P(MathTest, AtanDegrees) {
  const auto exact = [](double t) { return std::atan(t) * kRadToDeg; };
  const auto function = SKEIN_DISPATCH(AtanDegreesColumn);
  EXPECT_LE(WorstUlp(function, exact, Linear(-1, 1)), kArcTangent);
  EXPECT_LE(WorstUlp(function, exact, Geometric(1e-30, 1)), kArcTangent);
}

/// The angle that SinCosOfBits takes the bits of `x` for, radians.
double AngleOfBits(double x) {
  const float single = static_cast<float>(x);
  std::uint32_t bits;
  std::memcpy(&bits, &single, sizeof bits);
  return M_PI / 2 * (bits >> 30) + M_PI / 4 * static_cast<std::int32_t>(bits << 2) * 0x1.0p-31;
}

TEST_P(MathTest, SinCosOfBits) {
  for (const double sign : {1.0, -1.0}) {
    Column x = Geometric(1e-38, 3e38);  // nearly all patterns of bits
    for (float& value : x) value = static_cast<float>(sign * value);
    EXPECT_LE(
        WorstAbsolute(
            SKEIN_DISPATCH(SinOfBitsColumn), [](double a) { return std::sin(AngleOfBits(a)); }, x),
        kBitAngle);
    EXPECT_LE(
        WorstAbsolute(
            SKEIN_DISPATCH(CosOfBitsColumn), [](double a) { return std::cos(AngleOfBits(a)); }, x),
        kBitAngle);
  }
}

TEST_P(MathTest, SinCos) {
  for (const double range : {1000.0, 4.0, 1e-6}) {
    const Column x = Linear(-range, range);
    EXPECT_LE(WorstAbsolute(
                  SKEIN_DISPATCH(SinColumn), [](double a) { return std::sin(a); }, x),
              kSine);
    EXPECT_LE(WorstAbsolute(
                  SKEIN_DISPATCH(CosColumn), [](double a) { return std::cos(a); }, x),
              kSine);
  }
}

TEST_P(MathTest, Exp) {
  const auto exact = [](double x) { return std::exp(x); };
  EXPECT_LE(WorstUlp(SKEIN_DISPATCH(ExpColumn), exact, Linear(-87, 88)), kExpAndLog);
  EXPECT_LE(WorstUlp(SKEIN_DISPATCH(ExpColumn), exact, Linear(-1, 1)), kExpAndLog);
}

TEST_P(MathTest, ExpLimitsItsArgument) {
  const Column x(16, 1000.0f), minus_x(16, -1000.0f);
  Column y(16);
  SKEIN_DISPATCH(ExpColumn)(x, y);
  EXPECT_NEAR(std::log(static_cast<double>(y[0])), 88, kExponent);
  SKEIN_DISPATCH(ExpColumn)(minus_x, y);
  EXPECT_NEAR(std::log(static_cast<double>(y[0])), -87, kExponent);
}

TEST_P(MathTest, Log) {
  const auto exact = [](double x) { return std::log(x); };
  EXPECT_LE(WorstUlp(SKEIN_DISPATCH(LogColumn), exact,
                     Geometric(std::numeric_limits<float>::min(), 3e38)),
            kExpAndLog);
  EXPECT_LE(WorstUlp(SKEIN_DISPATCH(LogColumn), exact, Linear(0.5, 2)), kExpAndLog);
}

TEST_P(MathTest, Atan2OnCirclesOfEverySize) {
  for (const double radius : {1e-20, 1.0, 1e20}) {
    Column x(kSamples), y(kSamples), degrees(kSamples), radians(kSamples);
    for (int i = 0; i < kSamples; ++i) {
      const double angle = 2 * 3.14159265358979323846 * (i + 0.5) / kSamples;
      x[i] = static_cast<float>(radius * std::cos(angle));
      y[i] = static_cast<float>(radius * std::sin(angle));
    }
    SKEIN_DISPATCH(Atan2DegreesColumn)(y, x, degrees);
    SKEIN_DISPATCH(Atan2Column)(y, x, radians);
    for (int i = 0; i < kSamples; ++i) {
      const double exact = std::atan2(static_cast<double>(y[i]), static_cast<double>(x[i]));
      ASSERT_NEAR(degrees[i], exact * kRadToDeg, kDegrees);
      ASSERT_NEAR(radians[i], exact, kRadians);
      if (std::abs(y[i]) <= x[i]) {
        ASSERT_LE(std::abs(degrees[i] - exact * kRadToDeg),
                  kQuotientArcTangent * Ulp(exact * kRadToDeg));
      }
    }
  }
}

TEST_P(MathTest, Atan2OnTheAxes) {
  const float cases[][3] = {{0, 0, 0},     {0, 1, 0},         {1, 0, 90},     {-1, 0, -90},
                            {0, -1, 180},  {1, 1, 45},        {-1, -1, -135}, {1, -1, 135},
                            {-0.0f, 1, 0}, {-0.0f, -1, -180}, {0, -0.0f, 0},  {-0.0f, -0.0f, 0}};
  for (const auto& c : cases) {
    Column y(16, c[0]), x(16, c[1]), degrees(16), radians(16);
    SKEIN_DISPATCH(Atan2DegreesColumn)(y, x, degrees);
    SKEIN_DISPATCH(Atan2Column)(y, x, radians);
    SCOPED_TRACE(testing::Message() << c[0] << ", " << c[1]);
    EXPECT_NEAR(degrees[0], c[2], kDegrees);
    EXPECT_NEAR(radians[0], c[2] / kRadToDeg, kRadians);
    EXPECT_EQ(std::signbit(degrees[0]), std::signbit(c[0])) << "the sign of y, of a zero, too";
    EXPECT_EQ(std::signbit(radians[0]), std::signbit(c[0]));
  }
}

TEST_P(MathTest, NaNStaysInItsLane) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const ColumnFunction function :
       {SKEIN_DISPATCH(ReciprocalColumn), SKEIN_DISPATCH(ReciprocalSqrtColumn),
        SKEIN_DISPATCH(AtanDegreesColumn), SKEIN_DISPATCH(ExpColumn), SKEIN_DISPATCH(SinColumn),
        SKEIN_DISPATCH(CosColumn)}) {
    Column clean(16, 0.7f), spoilt(16, 0.7f), y(16), z(16);
    spoilt[5] = nan;
    function(clean, y);
    function(spoilt, z);
    for (int i = 0; i < 16; ++i) {
      if (i == 5) {
        EXPECT_TRUE(std::isnan(z[i]));
      } else {
        EXPECT_EQ(z[i], y[i]);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryTarget, MathTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return simd::Name(test.param); });

}  // namespace
}  // namespace skein
#endif
