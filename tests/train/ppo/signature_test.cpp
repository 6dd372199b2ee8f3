// SPDX-License-Identifier: Apache-2.0
// What a short training gives on every SIMD target and in every precision, to the bit: a change of
// one of these numbers is a change of results, and its message says why. They are those of g++ 12
// and glibc 2.36; other compilers and libraries may round elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "simd/target.h"
#include "tests/train/small_config.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

using simd::Target;

struct Expected {
  Target target;
  LearnerPrecision precision;
  std::uint64_t signature;
};

#if defined(__aarch64__)
// The scalar numbers but the last are not those of x86-64: glibc's tanhf rounds elsewhere.
constexpr Expected kExpected[] = {
    {Target::kNeon, LearnerPrecision::kFloat32, 0x2ee94af9ca5fe68du},
    {Target::kNeon, LearnerPrecision::kMixed, 0x8fb946be05298fceu},
    {Target::kNeon, LearnerPrecision::kFast, 0xd8c19f9c3360caf4u},
    {Target::kNeon, LearnerPrecision::kBfloat16, 0x4b3e3b350f643f91u},
    {Target::kScalar, LearnerPrecision::kFloat32, 0x9a334976a8d7db93u},
    {Target::kScalar, LearnerPrecision::kMixed, 0xc0467c669f177624u},
    {Target::kScalar, LearnerPrecision::kFast, 0x7491db58f79121bau},
    {Target::kScalar, LearnerPrecision::kBfloat16, 0x95335454a87f2991u},
};
#else
constexpr Expected kExpected[] = {
    {Target::kAvx512, LearnerPrecision::kFloat32, 0x22dbcc307423886du},
    {Target::kAvx512, LearnerPrecision::kMixed, 0xb76331ac9428da07u},
    {Target::kAvx512, LearnerPrecision::kFast, 0xac3b898e3cc2c2a0u},
    {Target::kAvx512, LearnerPrecision::kBfloat16, 0x4fc88d90f802ad18u},
    {Target::kAvx512, LearnerPrecision::kAmx, 0x66b8f69904ff6b1cu},
    {Target::kAvx2, LearnerPrecision::kFloat32, 0xf529b791c1e795b7u},
    {Target::kAvx2, LearnerPrecision::kMixed, 0x23aea04c4d32be6au},
    {Target::kAvx2, LearnerPrecision::kFast, 0x2ea56d6060fc1674u},
    {Target::kAvx2, LearnerPrecision::kBfloat16, 0xbae907509110eedeu},
    {Target::kAvx2, LearnerPrecision::kAmx, 0xf17539565a05d35bu},
    {Target::kSse4, LearnerPrecision::kFloat32, 0xa5c8659b25b90b6bu},
    {Target::kSse4, LearnerPrecision::kMixed, 0xf77c24b3767551f4u},
    {Target::kSse4, LearnerPrecision::kFast, 0xf3a9103d491a8d6bu},
    {Target::kSse4, LearnerPrecision::kBfloat16, 0x5750a500bc55ab5bu},
    {Target::kSse4, LearnerPrecision::kAmx, 0x2cd9abbef105e42au},
    {Target::kScalar, LearnerPrecision::kFloat32, 0xdf74a984cad5347cu},
    {Target::kScalar, LearnerPrecision::kMixed, 0x3814dace5ea5acb5u},
    {Target::kScalar, LearnerPrecision::kFast, 0xbb06e40e32a44800u},
    {Target::kScalar, LearnerPrecision::kBfloat16, 0x95335454a87f2991u},
    {Target::kScalar, LearnerPrecision::kAmx, 0x83de3b1a5742bbbau},
};
#endif

bool IsSupported(Target target) {
  const std::vector<Target> supported = simd::SupportedTargets();
  return std::count(supported.begin(), supported.end(), target) > 0;
}

class Signature : public ::testing::TestWithParam<Expected> {
 protected:
  ~Signature() override { simd::ForceTarget(before_); }

 private:
  const Target before_ = simd::ActiveTarget();
};

TEST_P(Signature, IsAsExpected) {
#if !defined(__GNUC__) || defined(__clang__) || __GNUC__ != 12 || __GLIBC__ != 2 || \
    __GLIBC_MINOR__ != 36
  GTEST_SKIP() << "the numbers are of g++ 12 and glibc 2.36";
#endif
  if (!IsSupported(GetParam().target)) GTEST_SKIP() << "this processor has no such target";
  simd::ForceTarget(GetParam().target);
  TrainConfig config = SmallConfig();
  config.learner.precision = GetParam().precision;
  WorkerPool pool(2);
  Trainer trainer(config, pool);
  while (!trainer.finished()) trainer.Iterate();
  EXPECT_EQ(trainer.Signature(), GetParam().signature) << std::hex << trainer.Signature();
}

INSTANTIATE_TEST_SUITE_P(Of, Signature, ::testing::ValuesIn(kExpected), [](const auto& tested) {
  return std::string(Name(tested.param.target)) + "_" + Name(tested.param.precision);
});

}  // namespace
}  // namespace skein
