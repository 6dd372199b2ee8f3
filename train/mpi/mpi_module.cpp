// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "train/mpi/mpi_ranks.h"
#include "train/ranks/rank_module.h"

namespace skein {
namespace {

class MpiModule final : public RankModule {
 public:
  std::unique_ptr<Ranks> Join(double timeout_s) const override {
    return std::make_unique<MpiRanks>(timeout_s);
  }
};

}  // namespace
}  // namespace skein

extern "C" const skein::RankModule* skein_rank_module(const char* build) {
  static const skein::MpiModule module;
  return std::strcmp(build, SKEIN_BUILD_ID) == 0 ? &module : nullptr;
}
