// SPDX-License-Identifier: Apache-2.0
#include "train/ranks/ranks.h"

#include "base/error.h"

namespace skein {
namespace {

class SingleRank final : public Ranks {
 public:
  int rank() const override { return 0; }
  int count() const override { return 1; }
  std::string Describe(int /*rank*/) const override { return "the only process"; }
  void ExchangeAll(int partner, const std::vector<Transfer>& /*transfers*/) override {
    Refuse(partner);
  }
  void Notify(int rank, std::int64_t /*word*/) override { Refuse(rank); }
  std::optional<Notice> TakeNotice() override { return std::nullopt; }
  bool EndsWithin(double /*seconds*/) override { return true; }
  [[noreturn]] void Abort(const char* reason) override { throw Error(reason); }

 private:
  [[noreturn]] static void Refuse(int rank) {
    throw Error("there is no rank " + std::to_string(rank) + " to exchange anything with");
  }
};

}  // namespace

Ranks& OneRank() {
  static SingleRank rank;
  return rank;
}

}  // namespace skein
