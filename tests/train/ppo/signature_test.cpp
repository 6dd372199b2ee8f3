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
    {Target::kNeon, LearnerPrecision::kFloat32, 0x00e6349dabc6dc3eu},
    {Target::kNeon, LearnerPrecision::kMixed, 0x8ef63d5184b34741u},
    {Target::kNeon, LearnerPrecision::kFast, 0xaf8997c36759ea74u},
    {Target::kNeon, LearnerPrecision::kBfloat16, 0xf12e8ad9c35b63e4u},
    {Target::kScalar, LearnerPrecision::kFloat32, 0xccfa8d106cf54578u},
    {Target::kScalar, LearnerPrecision::kMixed, 0xffee0fbc142c76beu},
    {Target::kScalar, LearnerPrecision::kFast, 0x7f54b999e3d9a393u},
    {Target::kScalar, LearnerPrecision::kBfloat16, 0x1c181030d48c6edeu},
};
#else
constexpr Expected kExpected[] = {
    {Target::kAvx512, LearnerPrecision::kFloat32, 0x3feaf053217444e6u},
    {Target::kAvx512, LearnerPrecision::kMixed, 0x4bd3f3221bf61695u},
    {Target::kAvx512, LearnerPrecision::kFast, 0xcae29b81cc3c2aa4u},
    {Target::kAvx512, LearnerPrecision::kBfloat16, 0x78ba0472e464c672u},
    {Target::kAvx512, LearnerPrecision::kAmx, 0x028f0bcd8a676fb3u},
    {Target::kAvx2, LearnerPrecision::kFloat32, 0x647823ef713b9794u},
    {Target::kAvx2, LearnerPrecision::kMixed, 0x1a17d5d0d5926be2u},
    {Target::kAvx2, LearnerPrecision::kFast, 0x566bde2479ce1b75u},
    {Target::kAvx2, LearnerPrecision::kBfloat16, 0x75d1818d6b7c9fe2u},
    {Target::kAvx2, LearnerPrecision::kAmx, 0x88eb09495ec29c88u},
    {Target::kSse4, LearnerPrecision::kFloat32, 0x895e3cac0819aaf0u},
    {Target::kSse4, LearnerPrecision::kMixed, 0x11210e925d010b98u},
    {Target::kSse4, LearnerPrecision::kFast, 0xb4f1fe108ecafd50u},
    {Target::kSse4, LearnerPrecision::kBfloat16, 0x5eb7b37b467a1d1eu},
    {Target::kSse4, LearnerPrecision::kAmx, 0x29daa9bd81f31ad5u},
    {Target::kScalar, LearnerPrecision::kFloat32, 0x1f95002271b5426fu},
    {Target::kScalar, LearnerPrecision::kMixed, 0xc66f69be693d9d6fu},
    {Target::kScalar, LearnerPrecision::kFast, 0x6a30d1fd3c4fa061u},
    {Target::kScalar, LearnerPrecision::kBfloat16, 0x1c181030d48c6edeu},
    {Target::kScalar, LearnerPrecision::kAmx, 0x96e834136851d1b6u},
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
