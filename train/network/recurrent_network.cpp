// SPDX-License-Identifier: Apache-2.0
#include "train/network/recurrent_network.h"

#include "train/network/backend_module.h"
#include "train/network/fused_network.h"

namespace skein {

std::unique_ptr<RecurrentNetwork> MakeNetwork(Backend backend, const NetworkLayout& layout,
                                              const NetworkPrecision& precision) {
  if (backend == Backend::kFused) return std::make_unique<FusedNetwork>(layout, precision);
  return LoadBackendModule().MakeNetwork(layout);
}

}  // namespace skein
