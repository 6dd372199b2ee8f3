#include "train/backend.h"

#include <gtest/gtest.h>

#include "simd/error.h"
#include "train/recurrent_network.h"

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

}  // namespace
}  // namespace skein
