// SPDX-License-Identifier: Apache-2.0
#include "src/agents/agent_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/ends_with.h"
#include "base/fnv_hash.h"
#include "base/nearest_name.h"
#include "base/trimmed.h"
#include "envs/autopilot/autopilot.h"
#include "src/agents/policy_file.h"
#include "src/config/usage_error.h"
#include "src/files/output_file.h"
#include "src/run/run_directory.h"
#include "train/policy/other_aircraft.h"
#include "train/policy/policy_environment.h"

namespace skein {
namespace {

constexpr const char* kPolicy = "policy";
constexpr const char* kAutopilot = "autopilot";
constexpr const char* kRandom = "random";
constexpr const char* kZero = "zero";
constexpr const char* kSampledSuffix = "@sampled";
constexpr const char* kOtherAircraftSuffix = "@other-aircraft";
constexpr double kRandomHold_s = 1;
constexpr int kLongestHold = 1000;  // control steps, as of env.action_repeat

/// What follows "kind:" in `name`; empty if there is no colon.
std::string ArgumentOf(const std::string& name) {
  const auto colon = name.find(':');
  return colon == std::string::npos ? "" : name.substr(colon + 1);
}

std::string KindOf(const std::string& name) { return name.substr(0, name.find(':')); }

/// What follows "policy:", apart.
struct PolicyArgument {
  std::string file;
  bool is_sampled = false;
  bool is_of_other_aircraft = false;
};

/// Throws UsageError if `file` is not there, but would be without what follows its last '@'.
void RequireKnownSuffix(const std::string& file, const std::string& name) {
  const std::size_t at = file.rfind('@');
  if (at == std::string::npos || at == 0 || file.find('/', at) != std::string::npos) return;
  if (IsPolicyThere(file) || !IsPolicyThere(file.substr(0, at))) return;
  const std::string suffix = file.substr(at);
  const std::vector<std::string> known = {kSampledSuffix, kOtherAircraftSuffix};
  throw UsageError(fmt::format("agent {}: unknown suffix {}{}; known: {}", name, suffix,
                               DidYouMean(suffix, known), fmt::join(known, ", ")));
}

/// A file whose name ends as a suffix comes first.
PolicyArgument WithoutSuffixes(const std::string& name) {
  PolicyArgument argument{ArgumentOf(name)};
  const auto takes = [&argument](const std::string& suffix) {
    if (IsPolicyThere(argument.file) || !EndsWith(argument.file, suffix)) return false;
    argument.file.resize(argument.file.size() - suffix.size());
    return true;
  };
  // In either order.
  argument.is_of_other_aircraft = takes(kOtherAircraftSuffix);
  argument.is_sampled = takes(kSampledSuffix);
  argument.is_of_other_aircraft = takes(kOtherAircraftSuffix) || argument.is_of_other_aircraft;
  return argument;
}

PolicyArgument PolicyArgumentOf(const std::string& name) {
  PolicyArgument argument = WithoutSuffixes(name);
  RequireKnownSuffix(argument.file, name);
  return argument;
}

/// Whether `name` is that of a policy that is not there.
bool IsMissingPolicy(const std::string& name) {
  return KindOf(name) == kPolicy && !IsPolicyThere(WithoutSuffixes(name).file);
}

/// Where the name that begins at `begin` ends: at the next comma, but for the path of a policy that
/// is there and has commas of its own.
std::size_t EndOfName(const std::string& list, std::size_t begin) {
  const auto comma_from = [&list](std::size_t from) {
    return std::min(list.find(',', from), list.size());
  };
  const std::size_t next = comma_from(begin);
  if (!IsMissingPolicy(Trimmed(list.substr(begin, next - begin)))) return next;
  for (std::size_t end = next; end < list.size();) {
    end = comma_from(end + 1);
    if (!IsMissingPolicy(Trimmed(list.substr(begin, end - begin)))) return end;
  }
  return next;
}

Agent PolicyAgent(const std::string& name, const ProgramConfig& config, std::uint64_t seed) {
  const PolicyArgument argument = PolicyArgumentOf(name);
  RecurrentPolicy policy = LoadPolicy(PolicyFileOfAgent(name), config, seed);
  if (argument.is_of_other_aircraft) policy = ForAnyAircraft(policy);
  policy.CheckMadeFor(policy.EnvironmentFor(config.train.env), "agent " + name);
  return argument.is_sampled ? Agent::SamplingFrom(policy) : Agent::MeanOf(policy);
}

Agent RandomAgent(const std::string& name, double control_interval_s) {
  double hold_s = kRandomHold_s;
  if (name.find(':') != std::string::npos) {
    const std::string text = ArgumentOf(name);
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, hold_s);
    if (failure != std::errc() || stop != end) hold_s = std::nan("");
  }
  const double steps = std::round(hold_s / control_interval_s);
  if (!(hold_s >= control_interval_s && steps <= kLongestHold)) {
    throw UsageError(fmt::format("agent {}: actions are held for {} to {} s, as in random:0.5",
                                 name, control_interval_s, control_interval_s * kLongestHold));
  }
  return Agent::Random(static_cast<int>(steps));
}

Agent AutopilotAgent(const std::string& name, const EnvConfig& env) {
  EnvConfig own = env;
  own.tracking.error_axes = kAutopilotErrorAxes;
  return AsUsage(
      [&] { return Agent::Of(MakeAutopilot(own, AutopilotOf(AutopilotVariantOf(name)))); });
}

/// The names of these forms on one line.
std::string Listed(const std::vector<AgentForm>& forms) {
  std::vector<std::string> names;
  for (const AgentForm& form : forms) names.push_back(form.name);
  return fmt::format("{} (autopilot means autopilot:aggressive)", fmt::join(names, ", "));
}

}  // namespace

bool IsOtherAgent(const std::string& policy) {
  const std::string kind = KindOf(policy);
  return (kind == kAutopilot || kind == kRandom || kind == kZero) && !IsPolicyThere(policy);
}

bool IsAutopilot(const std::string& name) { return KindOf(name) == kAutopilot; }

std::string AutopilotVariantOf(const std::string& name) {
  // The strongest stands for all: a comparison should not be won against less.
  return name == kAutopilot ? "aggressive" : ArgumentOf(name);
}

std::vector<AgentForm> AgentForms() {
  return {{fmt::format("autopilot[:{}]", fmt::join(AutopilotNames(), "|:")),
           "the autopilot of TECS and L1 (autopilot means autopilot:aggressive)"},
          {"policy:FILE_OR_RUN[@sampled][@other-aircraft]",
           "a trained policy with its mean action, or as sampled; on another aircraft than its own",
           true},
          {"random[:SECONDS]", "random actions, drawn anew every second, or every SECONDS"},
          {kZero, "zero actions"}};
}

std::string AgentNames() { return Listed(AgentForms()); }

std::string OtherAgentNames() {
  std::vector<AgentForm> forms = AgentForms();
  forms.erase(std::remove_if(forms.begin(), forms.end(),
                             [](const AgentForm& form) { return form.is_policy; }),
              forms.end());
  return Listed(forms);
}

std::vector<std::string> AgentsIn(const std::string& list) {
  std::vector<std::string> agents;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = EndOfName(list, begin);
    agents.push_back(Trimmed(list.substr(begin, end - begin)));
    if (agents.back().empty()) throw UsageError(fmt::format("agents {}: one has no name", list));
    begin = end + 1;
  }
  return agents;
}

std::string PolicyFileOfAgent(const std::string& name) {
  if (KindOf(name) != kPolicy) return "";
  const std::string file = PolicyArgumentOf(name).file;
  if (file.empty()) throw UsageError(fmt::format("agent {}: policy: needs a file or a run", name));
  return PolicyFileOf(file);
}

std::string RunOfAgent(const std::string& name) {
  if (KindOf(name) != kPolicy) return "";
  const PolicyArgument argument = PolicyArgumentOf(name);
  return argument.is_of_other_aircraft || !IsRunDirectory(argument.file) ? "" : argument.file;
}

bool FliesAnyAircraft(const std::string& name) {
  return KindOf(name) == kPolicy && PolicyArgumentOf(name).is_of_other_aircraft;
}

std::vector<std::string> FilesOfRunsOfAgents(const std::vector<std::string>& names) {
  std::vector<std::string> files;
  for (const std::string& name : names) {
    const std::vector<std::string> own = FilesOfPolicy(RunOfAgent(name));
    files.insert(files.end(), own.begin(), own.end());
  }
  return files;
}

bool DrawsActions(const std::string& name) {
  const std::string kind = KindOf(name);
  return kind == kRandom || (kind == kPolicy && PolicyArgumentOf(name).is_sampled);
}

std::vector<std::string> PolicyFilesOfAgents(const std::vector<std::string>& names) {
  std::vector<std::string> files;
  for (const std::string& name : names) {
    const std::string file = PolicyFileOfAgent(name);
    if (!file.empty() && file != kUntrained) files.push_back(file);
  }
  return files;
}

std::string FingerprintOfAgent(const std::string& name) {
  const std::string file = PolicyFileOfAgent(name);
  return file.empty() || file == kUntrained ? "" : HexHash(ReadFile(file, kLargestRecord));
}

Agent FindAgent(const std::string& name, const ProgramConfig& config, std::uint64_t seed) {
  const std::string kind = KindOf(name);
  if (kind == kPolicy) return PolicyAgent(name, config, seed);
  if (kind == kRandom) return RandomAgent(name, config.train.env.control_interval_s);
  if (name == kZero) return Agent::Zero();
  if (IsAutopilot(name)) return AutopilotAgent(name, config.train.env);
  if (name == "idle") throw UsageError("agent idle is now called zero");
  const bool is_path = name.find_first_of(":=") == std::string::npos;
  const bool is_policy = name == kUntrained || EndsWith(name, ".skein") || IsRunDirectory(name);
  const std::string policy = is_policy ? name : PolicyMeant(name);
  if (is_path && !policy.empty()) {
    throw UsageError(fmt::format("unknown agent {}; did you mean {}:{}?", name, kPolicy, policy));
  }
  throw UsageError(fmt::format("unknown agent {}{}; known agents: {}", name,
                               DidYouMean(kind, {kAutopilot, kPolicy, kRandom, kZero}),
                               AgentNames()));
}

}  // namespace skein
