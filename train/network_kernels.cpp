#include "train/network_kernels.h"

#include <cmath>

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "train/network_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Vector = hn::Vec<Floats>;

HWY_INLINE float Sum(Vector v) {
  const Floats d;
  return hn::GetLane(hn::SumOfLanes(d, v));
}

/// 1 / (1 + exp(-x)); the argument is clamped where the result is 0 or 1 to float32.
HWY_INLINE Vector Sigmoid(Vector x) {
  const Floats d;
  constexpr float kLimit = 30;
  const Vector clamped = hn::Min(hn::Max(x, hn::Set(d, -kLimit)), hn::Set(d, kLimit));
  const Vector one = hn::Set(d, 1.0f);
  const Vector result = hn::Div(one, hn::Add(one, Exp(d, hn::Neg(clamped))));
  // Min and Max swallow not-a-number; adding 0 x brings it back.
  return hn::MulAdd(x, hn::Zero(d), result);
}

HWY_INLINE Vector Tanh(Vector x) {
  const Floats d;
  const Vector two = hn::Set(d, 2.0f);
  return hn::MulSub(two, Sigmoid(hn::Mul(two, x)), hn::Set(d, 1.0f));
}

/// `v` with zeros in lanes that lie behind the columns, where it holds the columns from `j` on.
template <bool kPadded>
HWY_INLINE Vector WithinColumns(int columns, int j, Vector v) {
  if constexpr (!kPadded) return v;
  const Floats d;
  const int left = columns - j;
  return hn::IfThenElseZero(hn::FirstN(d, static_cast<std::size_t>(left > 0 ? left : 0)), v);
}

/// Normalises one row; returns its inverse standard deviation and mean.
template <bool kPadded>
HWY_INLINE float NormaliseRow(int columns, const float* in, float* out, float* mean_out) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = PaddedWidth(columns);
  Vector sum = hn::Zero(d);
  for (int j = 0; j < width; j += lanes) sum = hn::Add(sum, hn::LoadU(d, in + j));
  const float mean = Sum(sum) / static_cast<float>(columns);
  const Vector mean_v = hn::Set(d, mean);
  Vector squares = hn::Zero(d);
  for (int j = 0; j < width; j += lanes) {
    const Vector deviation =
        WithinColumns<kPadded>(columns, j, hn::Sub(hn::LoadU(d, in + j), mean_v));
    squares = hn::MulAdd(deviation, deviation, squares);
  }
  const float variance = Sum(squares) / static_cast<float>(columns);
  const float inverse_std = 1.0f / std::sqrt(variance + kLayerNormEpsilon);
  const Vector inverse_std_v = hn::Set(d, inverse_std);
  for (int j = 0; j < width; j += lanes) {
    const Vector deviation =
        WithinColumns<kPadded>(columns, j, hn::Sub(hn::LoadU(d, in + j), mean_v));
    hn::StoreU(hn::Mul(deviation, inverse_std_v), d, out + j);
  }
  *mean_out = mean;
  return inverse_std;
}

template <bool kPadded>
void BiasReluNormaliseRows(std::int64_t rows, int columns, const float* bias, float* values,
                           float* inverse_std, float* zero_level) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = PaddedWidth(columns);
  for (std::int64_t i = 0; i < rows; ++i) {
    float* const row = values + i * width;
    for (int j = 0; j < width; j += lanes) {
      const Vector x = hn::Add(hn::LoadU(d, row + j), hn::LoadU(d, bias + j));
      // Unlike a maximum with zero, this keeps not-a-number on every target.
      hn::StoreU(hn::IfThenZeroElse(hn::Lt(x, hn::Zero(d)), x), d, row + j);
    }
    float mean;
    inverse_std[i] = NormaliseRow<kPadded>(columns, row, row, &mean);
    zero_level[i] = -mean * inverse_std[i];
  }
}

void BiasReluNormaliseKernel(std::int64_t rows, int columns, const float* bias, float* values,
                             float* inverse_std, float* zero_level) {
  const auto kernel =
      PaddedWidth(columns) == columns ? BiasReluNormaliseRows<false> : BiasReluNormaliseRows<true>;
  kernel(rows, columns, bias, values, inverse_std, zero_level);
}

template <bool kPadded>
void NormaliseWithStdRows(std::int64_t rows, int columns, const float* in, float* out,
                          float* inverse_std) {
  const int width = PaddedWidth(columns);
  for (std::int64_t i = 0; i < rows; ++i) {
    float mean;
    inverse_std[i] = NormaliseRow<kPadded>(columns, in + i * width, out + i * width, &mean);
  }
}

void NormaliseWithStdKernel(std::int64_t rows, int columns, const float* in, float* out,
                            float* inverse_std) {
  const auto kernel =
      PaddedWidth(columns) == columns ? NormaliseWithStdRows<false> : NormaliseWithStdRows<true>;
  kernel(rows, columns, in, out, inverse_std);
}

/// The means that LayerNorm's gradient subtracts: of the gradient, and of gradient times
/// normalised.
HWY_INLINE void GradientMeans(int columns, const float* gradient, const float* normalised,
                              Vector* mean, Vector* projection) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = PaddedWidth(columns);
  Vector sum = hn::Zero(d), product_sum = hn::Zero(d);
  for (int j = 0; j < width; j += lanes) {
    const Vector g = hn::LoadU(d, gradient + j);
    sum = hn::Add(sum, g);
    product_sum = hn::MulAdd(g, hn::LoadU(d, normalised + j), product_sum);
  }
  *mean = hn::Set(d, Sum(sum) / static_cast<float>(columns));
  *projection = hn::Set(d, Sum(product_sum) / static_cast<float>(columns));
}

template <bool kPadded>
void BiasReluNormaliseBackwardRows(std::int64_t rows, int columns, const float* normalised,
                                   const float* inverse_std, const float* zero_level,
                                   float* gradient, float* bias_gradient) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = PaddedWidth(columns);
  for (std::int64_t i = 0; i < rows; ++i) {
    float* const g = gradient + i * width;
    const float* const x = normalised + i * width;
    Vector mean, projection;
    GradientMeans(columns, g, x, &mean, &projection);
    const Vector scale = hn::Set(d, inverse_std[i]), zero = hn::Set(d, zero_level[i]);
    for (int j = 0; j < width; j += lanes) {
      const Vector xj = hn::LoadU(d, x + j);
      const Vector centred = hn::NegMulAdd(xj, projection, hn::Sub(hn::LoadU(d, g + j), mean));
      const Vector passed = hn::IfThenElseZero(hn::Gt(xj, zero), hn::Mul(scale, centred));
      const Vector result = WithinColumns<kPadded>(columns, j, passed);
      hn::StoreU(result, d, g + j);
      hn::StoreU(hn::Add(hn::LoadU(d, bias_gradient + j), result), d, bias_gradient + j);
    }
  }
}

void BiasReluNormaliseBackwardKernel(std::int64_t rows, int columns, const float* normalised,
                                     const float* inverse_std, const float* zero_level,
                                     float* gradient, float* bias_gradient) {
  const auto kernel = PaddedWidth(columns) == columns ? BiasReluNormaliseBackwardRows<false>
                                                      : BiasReluNormaliseBackwardRows<true>;
  kernel(rows, columns, normalised, inverse_std, zero_level, gradient, bias_gradient);
}

template <bool kPadded>
void NormaliseBackwardRows(std::int64_t rows, int columns, const float* normalised,
                           const float* inverse_std, float* gradient) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = PaddedWidth(columns);
  for (std::int64_t i = 0; i < rows; ++i) {
    float* const g = gradient + i * width;
    const float* const x = normalised + i * width;
    Vector mean, projection;
    GradientMeans(columns, g, x, &mean, &projection);
    const Vector scale = hn::Set(d, inverse_std[i]);
    for (int j = 0; j < width; j += lanes) {
      const Vector centred =
          hn::NegMulAdd(hn::LoadU(d, x + j), projection, hn::Sub(hn::LoadU(d, g + j), mean));
      hn::StoreU(WithinColumns<kPadded>(columns, j, hn::Mul(scale, centred)), d, g + j);
    }
  }
}

void NormaliseBackwardKernel(std::int64_t rows, int columns, const float* normalised,
                             const float* inverse_std, float* gradient) {
  const auto kernel =
      PaddedWidth(columns) == columns ? NormaliseBackwardRows<false> : NormaliseBackwardRows<true>;
  kernel(rows, columns, normalised, inverse_std, gradient);
}

void ScaleRowsKernel(std::int64_t rows, int columns, const float* keep, const float* in,
                     float* out) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = PaddedWidth(columns);
  for (std::int64_t i = 0; i < rows; ++i) {
    const Vector factor = hn::Set(d, keep[i]);
    for (std::int64_t j = i * width; j < (i + 1) * width; j += lanes) {
      hn::StoreU(hn::Mul(factor, hn::LoadU(d, in + j)), d, out + j);
    }
  }
}

void AddScaledRowsKernel(std::int64_t rows, int columns, const float* keep, const float* in,
                         float* out) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = PaddedWidth(columns);
  for (std::int64_t i = 0; i < rows; ++i) {
    const Vector factor = hn::Set(d, keep[i]);
    for (std::int64_t j = i * width; j < (i + 1) * width; j += lanes) {
      hn::StoreU(hn::MulAdd(factor, hn::LoadU(d, in + j), hn::LoadU(d, out + j)), d, out + j);
    }
  }
}

void GruStepKernel(std::int64_t rows, int size, const float* input_bias, const float* hidden_bias,
                   const float* hidden_product, const float* previous, float* gates,
                   std::int64_t stride, float* next) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (std::int64_t i = 0; i < rows; ++i) {
    float* const gate_n = gates + i * stride;
    float* const gate_r = gate_n + size;
    float* const gate_z = gate_r + size;
    float* const gate_q = gate_z + size;
    const float* const product = hidden_product + i * 3 * size;
    for (int j = 0; j < size; j += lanes) {
      const auto biased = [&](const float* value, const float* bias) HWY_ATTR {
        return hn::Add(hn::LoadU(d, value + j), hn::LoadU(d, bias + j));
      };
      const Vector r =
          Sigmoid(hn::Add(biased(gate_r, input_bias + size), biased(product, hidden_bias)));
      const Vector z = Sigmoid(hn::Add(biased(gate_z, input_bias + 2 * size),
                                       biased(product + size, hidden_bias + size)));
      const Vector q = biased(product + 2 * size, hidden_bias + 2 * size);
      const Vector n = Tanh(hn::MulAdd(r, q, biased(gate_n, input_bias)));
      const Vector h = hn::LoadU(d, previous + i * size + j);
      hn::StoreU(n, d, gate_n + j);
      hn::StoreU(r, d, gate_r + j);
      hn::StoreU(z, d, gate_z + j);
      hn::StoreU(q, d, gate_q + j);
      hn::StoreU(hn::MulAdd(z, hn::Sub(h, n), n), d, next + i * size + j);
    }
  }
}

void GruStepBackwardKernel(std::int64_t rows, int size, const float* previous, float* gates,
                           std::int64_t stride, float* state_gradient) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const Vector one = hn::Set(d, 1.0f);
  for (std::int64_t i = 0; i < rows; ++i) {
    float* const gate_n = gates + i * stride;
    float* const gate_r = gate_n + size;
    float* const gate_z = gate_r + size;
    float* const gate_q = gate_z + size;
    for (int j = 0; j < size; j += lanes) {
      const Vector n = hn::LoadU(d, gate_n + j), r = hn::LoadU(d, gate_r + j);
      const Vector z = hn::LoadU(d, gate_z + j), q = hn::LoadU(d, gate_q + j);
      const Vector g = hn::LoadU(d, state_gradient + i * size + j);
      const Vector h = hn::LoadU(d, previous + i * size + j);
      const Vector dz = hn::Mul(hn::Mul(g, hn::Sub(h, n)), hn::Mul(z, hn::Sub(one, z)));
      const Vector dn = hn::Mul(hn::Mul(g, hn::Sub(one, z)), hn::NegMulAdd(n, n, one));
      const Vector dr = hn::Mul(hn::Mul(dn, q), hn::Mul(r, hn::Sub(one, r)));
      hn::StoreU(dn, d, gate_n + j);
      hn::StoreU(dr, d, gate_r + j);
      hn::StoreU(dz, d, gate_z + j);
      hn::StoreU(hn::Mul(dn, r), d, gate_q + j);
      hn::StoreU(hn::Mul(g, z), d, state_gradient + i * size + j);
    }
  }
}

void AddColumnSumsKernel(std::int64_t rows, int columns, const float* in, std::int64_t stride,
                         float* sums) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (std::int64_t i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; j += lanes) {
      hn::StoreU(hn::Add(hn::LoadU(d, sums + j), hn::LoadU(d, in + i * stride + j)), d, sums + j);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(BiasReluNormaliseKernel);
HWY_EXPORT(BiasReluNormaliseBackwardKernel);
HWY_EXPORT(NormaliseWithStdKernel);
HWY_EXPORT(NormaliseBackwardKernel);
HWY_EXPORT(ScaleRowsKernel);
HWY_EXPORT(AddScaledRowsKernel);
HWY_EXPORT(GruStepKernel);
HWY_EXPORT(GruStepBackwardKernel);
HWY_EXPORT(AddColumnSumsKernel);

void NormaliseRows(std::int64_t rows, int columns, const float* in, float* out) {
  for (std::int64_t i = 0; i < rows; ++i) {
    const float* const row = in + i * columns;
    float sum = 0, squares = 0;
    for (int j = 0; j < columns; ++j) sum += row[j];
    const float mean = sum / static_cast<float>(columns);
    for (int j = 0; j < columns; ++j) squares += (row[j] - mean) * (row[j] - mean);
    const float inverse_std =
        1.0f / std::sqrt(squares / static_cast<float>(columns) + kLayerNormEpsilon);
    for (int j = 0; j < columns; ++j) out[i * columns + j] = (row[j] - mean) * inverse_std;
  }
}

void BiasReluNormalise(std::int64_t rows, int columns, const float* bias, float* values,
                       float* inverse_std, float* zero_level) {
  SKEIN_DISPATCH(BiasReluNormaliseKernel)(rows, columns, bias, values, inverse_std, zero_level);
}

void BiasReluNormaliseBackward(std::int64_t rows, int columns, const float* normalised,
                               const float* inverse_std, const float* zero_level, float* gradient,
                               float* bias_gradient) {
  SKEIN_DISPATCH(BiasReluNormaliseBackwardKernel)
  (rows, columns, normalised, inverse_std, zero_level, gradient, bias_gradient);
}

void NormaliseWithStd(std::int64_t rows, int columns, const float* in, float* out,
                      float* inverse_std) {
  SKEIN_DISPATCH(NormaliseWithStdKernel)(rows, columns, in, out, inverse_std);
}

void NormaliseBackward(std::int64_t rows, int columns, const float* normalised,
                       const float* inverse_std, float* gradient) {
  SKEIN_DISPATCH(NormaliseBackwardKernel)(rows, columns, normalised, inverse_std, gradient);
}

void ScaleRows(std::int64_t rows, int columns, const float* keep, const float* in, float* out) {
  SKEIN_DISPATCH(ScaleRowsKernel)(rows, columns, keep, in, out);
}

void AddScaledRows(std::int64_t rows, int columns, const float* keep, const float* in, float* out) {
  SKEIN_DISPATCH(AddScaledRowsKernel)(rows, columns, keep, in, out);
}

void GruStep(std::int64_t rows, int size, const float* input_bias, const float* hidden_bias,
             const float* hidden_product, const float* previous, float* gates, std::int64_t stride,
             float* next) {
  SKEIN_DISPATCH(GruStepKernel)
  (rows, size, input_bias, hidden_bias, hidden_product, previous, gates, stride, next);
}

void GruStepBackward(std::int64_t rows, int size, const float* previous, float* gates,
                     std::int64_t stride, float* state_gradient) {
  SKEIN_DISPATCH(GruStepBackwardKernel)(rows, size, previous, gates, stride, state_gradient);
}

void AddColumnSums(std::int64_t rows, int columns, const float* in, std::int64_t stride,
                   float* sums) {
  SKEIN_DISPATCH(AddColumnSumsKernel)(rows, columns, in, stride, sums);
}

}  // namespace skein
#endif  // HWY_ONCE
