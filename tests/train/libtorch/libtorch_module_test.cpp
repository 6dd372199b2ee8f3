// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <torch/version.h>

#include "base/error.h"
#include "train/network/backend_module.h"

namespace skein {
namespace {

TEST(LibTorchModuleTest, GivesTheVersionThatItWasBuiltWith) {
  EXPECT_EQ(LibTorchVersion(), TORCH_VERSION);
}

TEST(LibTorchModuleTest, IsLoadedOnce) { EXPECT_EQ(&LoadBackendModule(), &LoadBackendModule()); }

TEST(LibTorchModuleTest, RefusesAnotherBuild) {
  LoadBackendModule();
  void* const library = dlopen(kLibTorchModule, RTLD_NOW | RTLD_NOLOAD);
  ASSERT_NE(library, nullptr);
  const auto entry = reinterpret_cast<BackendModuleEntry*>(dlsym(library, kBackendModuleEntry));
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(entry("0.0.1 (another compiler)"), nullptr);
}

TEST(LibTorchModuleTest, ItsErrorsAreCaughtAsSkeins) {
  NetworkConfig config;
  config.hidden_size = config.gru_size = 8;
  config.activation = static_cast<Activation>(99);
  const NetworkLayout layout(CriticShape(config, 3));
  const auto network = MakeNetwork(Backend::kLibTorch, layout);
  const std::vector<float> zeros(layout.size(), 0.0f);
  network->SetParameters(zeros.data());
  const float not_done = 1;
  NetworkWorkspace workspace;
  EXPECT_THROW(network->Forward({1, 1, zeros.data(), zeros.data(), &not_done}, workspace), Error);
}

}  // namespace
}  // namespace skein
