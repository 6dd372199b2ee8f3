// SPDX-License-Identifier: Apache-2.0
#include "src/run/rank_leader.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "src/bench/machine.h"
#include "train/policy/policy_parameters.h"
#include "train/ppo/training_state.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

/// Signals between ranks, behind the bits of RankCommand.
constexpr std::array<std::pair<std::uint64_t, int>, 4> kSignals{
    {{1 << 8, SIGINT}, {1 << 9, SIGTERM}, {1 << 10, SIGHUP}, {1 << 11, SIGUSR1}}};
constexpr std::uint64_t kCommands = 0xFF;

/// What must be the same on all ranks, for people.
std::string Identity(const Trainer& trainer) {
  std::string configuration;
  for (const auto& [key, value] : DescribeConfig(trainer.config())) {
    configuration += key + "=" + value + "\n";
  }
  TensorFile beginning;
  StorePolicy(*trainer.policy().parameters(), beginning);
  return fmt::format("{}, configuration {}, policy {} of iteration {}", DescribeProgram(),
                     HexHash(configuration), HexHash(beginning.Bytes()), trainer.iteration());
}

}  // namespace

RankCommand AgreeOnNext(Ranks& ranks, RunSignals& signals, RankCommand rank_zeros) {
  auto bits = static_cast<std::uint64_t>(rank_zeros);
  for (const auto& [bit, signal] : kSignals) {
    const bool is_here =
        signal == SIGUSR1 ? signals.TakeSaveRequest() : signals.StopSignal() == signal;
    if (is_here) bits |= bit;
  }
  bits = UnionOverRanks(ranks, bits);
  for (const auto& [bit, signal] : kSignals) {
    // Rank 0 alone saves: others would ask for it again.
    const bool is_for_here = signal != SIGUSR1 || ranks.rank() == 0;
    if (is_for_here && (bits & bit) != 0) signals.Adopt(signal);
  }
  return static_cast<RankCommand>(bits & kCommands);
}

RankLeader::~RankLeader() { Say(RankCommand::kEnd); }

void RankLeader::Say(RankCommand command) {
  UnionOverRanks(ranks_, static_cast<std::uint64_t>(command));
}

void FollowLeader(Trainer& trainer, WorkerPool& pool, Ranks& ranks,
                  const std::function<void()>& evaluate) {
  RunSignals signals(pool);
  for (;;) {
    switch (AgreeOnNext(ranks, signals, RankCommand::kNone)) {
      case RankCommand::kNone:
        break;
      case RankCommand::kIterate:
        try {
          trainer.Iterate();
        } catch (const Error&) {  // rank 0 has the same, and says so
        }
        break;
      case RankCommand::kSave:
        trainer.Save("");
        break;
      case RankCommand::kEvaluate:
        try {
          evaluate();
        } catch (const JointError&) {  // what else fails would leave others in their exchanges
        }
        break;
      case RankCommand::kEnd:
        return;
    }
  }
}

std::unique_ptr<Trainer> MakeTrainer(const TrainConfig& config, WorkerPool& pool, Ranks& ranks,
                                     const std::function<void(Trainer&)>& begin) {
  std::unique_ptr<Trainer> trainer;
  DoTogether(ranks, [&] {
    trainer = std::make_unique<Trainer>(config, pool, ranks);
    begin(*trainer);
  });
  if (ranks.count() > 1) RequireSameOnRanks(ranks, "what they train with", Identity(*trainer));
  return trainer;
}

std::string DescribeRanks(const TrainConfig& config, const WorkerPool& pool, Ranks& ranks) {
  if (ranks.count() == 1) return "";
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  const std::string own =
      fmt::format("{} {} {}", pool.threads(), sysconf(_SC_NPROCESSORS_ONLN), host);
  struct Machine {
    int ranks = 0, threads = 0, processors = 0;
  };
  std::map<std::string, Machine> machines;
  for (const std::string& text : TextsOfRanks(ranks, own)) {
    const std::size_t second = text.find(' ') + 1, third = text.find(' ', second) + 1;
    Machine& machine = machines[text.substr(third)];
    ++machine.ranks;
    machine.threads += std::stoi(text);
    machine.processors = std::stoi(text.substr(second));
  }
  std::string lines = fmt::format("  {} ranks, {} of {} shards each", ranks.count(),
                                  config.learner.shards / ranks.count(), config.learner.shards);
  for (const auto& [name, machine] : machines) {
    lines += fmt::format("\n    {}: {} ranks, {} threads", name, machine.ranks, machine.threads);
    if (machine.threads > machine.processors) {
      lines += fmt::format(
          "\nwarning: {} has {} processors for {} threads: give ranks fewer (--threads)", name,
          machine.processors, machine.threads);
    }
  }
  return lines;
}

}  // namespace skein
