// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "train/network/backend_module.h"

/// For tests of what only LibTorch computes: a build without it has nothing to test.
#define SKEIN_SKIP_WITHOUT_LIBTORCH() \
  if (skein::LibTorchVersion().empty()) GTEST_SKIP() << "built without LibTorch"
