// SPDX-License-Identifier: Apache-2.0
#include "src/run/rank_leader.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "src/bench/machine.h"
#include "src/files/text_table.h"
#include "train/policy/policy_parameters.h"
#include "train/ppo/training_state.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

/// Signals between ranks, behind the bits of RankCommand.
constexpr std::array<std::pair<std::uint64_t, int>, 4> kSignals{
    {{1 << 8, SIGINT}, {1 << 9, SIGTERM}, {1 << 10, SIGHUP}, {1 << 11, SIGUSR1}}};
constexpr std::uint64_t kCommands = 0xFF;

/// Threads of ranks and what they may run on; as it is sent.
struct Workers {
  int threads;
  cpu_set_t processors;
  char host[256];

  bool AreCrowded() const { return threads > CPU_COUNT(&processors); }
};

Workers OwnWorkers(const WorkerPool& pool) {
  Workers own{};
  own.threads = pool.threads();
  // Of more processors than a set holds all may do: then nothing is warned of.
  if (sched_getaffinity(0, sizeof own.processors, &own.processors) != 0) {
    for (std::size_t i = 0; i < CPU_SETSIZE; ++i) CPU_SET(i, &own.processors);
  }
  gethostname(own.host, sizeof own.host - 1);
  return own;
}

std::string WarningOf(const std::string& host, const char* who, const Workers& workers) {
  return fmt::format(
      "\nwarning: {} lets {} use {} for {}: give ranks fewer (--threads), or bind them otherwise "
      "(--bind-to none)",
      host, who, Counted(CPU_COUNT(&workers.processors), "processor"),
      Counted(workers.threads, "thread"));
}

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
  std::vector<Workers> of_ranks(static_cast<std::size_t>(ranks.count()));
  of_ranks[static_cast<std::size_t>(ranks.rank())] = OwnWorkers(pool);
  ShareWithAllRanks(ranks, of_ranks);
  struct Machine {
    int ranks = 0;
    Workers all{}, crowded{};  ///< `crowded`: of one rank, if it has too few processors
  };
  std::map<std::string, Machine> machines;
  for (const Workers& workers : of_ranks) {
    Machine& machine = machines[workers.host];
    ++machine.ranks;
    machine.all.threads += workers.threads;
    CPU_OR(&machine.all.processors, &machine.all.processors, &workers.processors);
    if (workers.AreCrowded()) machine.crowded = workers;
  }
  std::string lines = fmt::format("  {} ranks, {} of {} shards each", ranks.count(),
                                  config.learner.shards / ranks.count(), config.learner.shards);
  for (const auto& [name, machine] : machines) {
    lines +=
        fmt::format("\n    {}: {} ranks, {} threads", name, machine.ranks, machine.all.threads);
    if (machine.all.AreCrowded()) {
      lines += WarningOf(name, "its ranks", machine.all);
    } else if (machine.crowded.AreCrowded()) {
      lines += WarningOf(name, "a rank", machine.crowded);
    }
  }
  return lines;
}

}  // namespace skein
