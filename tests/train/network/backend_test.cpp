// SPDX-License-Identifier: Apache-2.0
#include "train/network/backend.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "simd/target.h"
#include "tests/scoped_target.h"
#include "tests/train/libtorch.h"
#include "train/network/network.h"
#include "train/network/precision.h"
#include "train/network/recurrent_network.h"

namespace skein {
namespace {

NetworkShape ShapeWith(Activation activation) {
  NetworkConfig config;
  config.activation = activation;
  return CriticShape(config, 22);
}

TEST(ChooseBackendTest, GivesWhatWasAskedForWhereItCan) {
  const BackendChoice fused = ChooseBackend(Backend::kFused, ShapeWith(Activation::kRelu));
  EXPECT_EQ(fused.backend, Backend::kFused);
  EXPECT_EQ(fused.fallback_reason, "");
  EXPECT_EQ(Describe(fused), "networks by the fused kernels, in fp32");
  for (const Activation activation : {Activation::kRelu, Activation::kTanh}) {
    const BackendChoice libtorch = ChooseBackend(Backend::kLibTorch, ShapeWith(activation));
    EXPECT_EQ(libtorch.backend, Backend::kLibTorch);
    EXPECT_EQ(Describe(libtorch), "networks by LibTorch, as asked");
  }
}

TEST(ChooseBackendTest, FallsBackToLibTorchAndSaysWhy) {
  SKEIN_SKIP_WITHOUT_LIBTORCH();
  for (const auto& [activation, name] : kActivationNames) {
    if (activation == Activation::kRelu) continue;
    const NetworkShape shape = ShapeWith(activation);
    const BackendChoice choice = ChooseBackend(Backend::kFused, shape);
    EXPECT_EQ(choice.backend, Backend::kLibTorch);
    EXPECT_EQ(Describe(choice),
              "networks by LibTorch, slower: the fused kernels do not know network.activation = "
              "\"" +
                  std::string(name) + "\"");
    EXPECT_THROW(MakeNetwork(Backend::kFused, NetworkLayout(shape)), Error);
    EXPECT_NO_THROW(MakeNetwork(choice.backend, NetworkLayout(shape)));
  }
}

std::string EmulationNote() {
  return simd::NativeBfloat16() ? "" : ", emulated: this processor has no bf16 products";
}

/// The fastest that this processor has.
LearnerPrecision ExpectedDefault() {
  if (simd::NativeTiles()) return LearnerPrecision::kAmx;
  return simd::FastBfloat16() ? LearnerPrecision::kFast : LearnerPrecision::kFloat32;
}

TEST(ChooseBackendTest, AutomaticPrecisionIsTheFastestOfTheProcessor) {
  const LearnerPrecision expected = ExpectedDefault();
  EXPECT_EQ(DefaultPrecision(), expected);
  const NetworkShape shape = ShapeWith(Activation::kRelu);
  EXPECT_EQ(ChooseBackend(Backend::kFused, shape, LearnerPrecision::kAuto).precision, expected);
}

TEST(ChooseBackendTest, OnlyAvx512HasBfloat16AndTiles) {
  for (const simd::Target target : simd::SupportedTargets()) {
    const ScopedTarget scoped(target);
    if (target != simd::Target::kAvx512) {
      EXPECT_FALSE(simd::NativeBfloat16());
      EXPECT_FALSE(simd::FastBfloat16());
      EXPECT_FALSE(simd::NativeTiles());
      EXPECT_EQ(DefaultPrecision(), LearnerPrecision::kFloat32);
    }
  }
}

TEST(ChooseBackendTest, PrecisionIsWhatWasAskedForAndIsDescribed) {
  const NetworkShape shape = ShapeWith(Activation::kRelu);
  const auto choose = [&](LearnerPrecision precision) {
    const BackendChoice choice = ChooseBackend(Backend::kFused, shape, precision);
    EXPECT_EQ(choice.precision, precision);
    return Describe(choice);
  };
  const std::string fused = "networks by the fused kernels, ";
  EXPECT_EQ(choose(LearnerPrecision::kFloat32), fused + "in fp32");
  EXPECT_EQ(choose(LearnerPrecision::kMixed), fused + "in mixed" + EmulationNote());
  EXPECT_EQ(choose(LearnerPrecision::kBfloat16), fused + "in bf16" + EmulationNote());
  EXPECT_EQ(choose(LearnerPrecision::kFast),
            fused + "the actor in mixed precision and the critic in bf16" + EmulationNote());
  EXPECT_EQ(choose(LearnerPrecision::kAmx),
            fused + "in tiles of bf16, forward through the actor with two for each number" +
                (simd::NativeTiles() ? "" : ", emulated, slowly: this processor has no AMX"));
}

TEST(ChooseBackendTest, LibTorchComputesInFloat32Alone) {
  for (const auto& [precision, name] : kPrecisionNames) {
    EXPECT_EQ(ChooseBackend(Backend::kLibTorch, ShapeWith(Activation::kRelu), precision).precision,
              LearnerPrecision::kFloat32)
        << name;
    EXPECT_EQ(ChooseBackend(Backend::kFused, ShapeWith(Activation::kTanh), precision).precision,
              LearnerPrecision::kFloat32)
        << name;
  }
  const BackendChoice mixed =
      ChooseBackend(Backend::kLibTorch, ShapeWith(Activation::kRelu), LearnerPrecision::kMixed);
  EXPECT_EQ(Describe(mixed),
            "networks by LibTorch, as asked; in fp32, not mixed: LibTorch computes in nothing else "
            "here");
  const BackendChoice automatic =
      ChooseBackend(Backend::kLibTorch, ShapeWith(Activation::kRelu), LearnerPrecision::kAuto);
  EXPECT_EQ(Describe(automatic), "networks by LibTorch, as asked");
}

TEST(ChooseBackendTest, PrecisionsAreThoseOfForwardAndBackwardProducts) {
  constexpr simd::Precision kFloat32 = simd::Precision::kFloat32;
  constexpr simd::Precision kBfloat16 = simd::Precision::kBfloat16;
  const auto expect = [](const NetworkPrecision& precision, simd::Precision forward,
                         simd::Precision backward) {
    EXPECT_EQ(precision.forward, forward);
    EXPECT_EQ(precision.backward, backward);
  };
  for (const auto& of_network : {ActorPrecision, CriticPrecision}) {
    expect(of_network(LearnerPrecision::kFloat32), kFloat32, kFloat32);
    expect(of_network(LearnerPrecision::kMixed), kFloat32, kBfloat16);
    expect(of_network(LearnerPrecision::kBfloat16), kBfloat16, kBfloat16);
    EXPECT_THROW(of_network(LearnerPrecision::kAuto), Error);
  }
  expect(ActorPrecision(LearnerPrecision::kFast), kFloat32, kBfloat16);
  expect(CriticPrecision(LearnerPrecision::kFast), kBfloat16, kBfloat16);
  constexpr simd::Precision kTiles = simd::Precision::kTiles;
  expect(ActorPrecision(LearnerPrecision::kAmx), simd::Precision::kSplitTiles, kTiles);
  expect(CriticPrecision(LearnerPrecision::kAmx), kTiles, kTiles);
  EXPECT_EQ(RoofPrecision(LearnerPrecision::kAmx), kTiles);
  EXPECT_EQ(RoofPrecision(LearnerPrecision::kBfloat16), kBfloat16);
  EXPECT_EQ(RoofPrecision(LearnerPrecision::kFast), kFloat32);
}

}  // namespace
}  // namespace skein
