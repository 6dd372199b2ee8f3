// SPDX-License-Identifier: Apache-2.0
#include "src/export/manifest.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/error.h"
#include "base/name_in.h"
#include "src/files/output_file.h"
#include "train/policy/autopilot_policy.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

Json Numbers(const std::vector<PolicyNumber>& numbers) {
  Json list = Json::array();
  for (const PolicyNumber& number : numbers) {
    list.push_back({{"name", number.name}, {"scale", number.scale}, {"offset", number.offset}});
  }
  return list;
}

/// Files lie beside the manifest.
std::string FileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

Json Describe(const ExportedPolicy& exported, const std::string& file) {
  return {{"file", FileName(file)},
          {"task", exported.interface.env.task},
          {"action_repeat", exported.interface.action_repeat},
          {"policy_step_s", exported.interface.policy_step_s()},
          {"state_size", exported.policy->shape.state_size()},
          {"observations", Numbers(exported.interface.observations)},
          {"actions", Numbers(exported.interface.actions)}};
}

Json DescribeLowLevel(const StoredPolicy& low_level, const std::string& version,
                      const std::string& file) {
  if (const auto* autopilot = dynamic_cast<const AutopilotPolicy*>(&low_level)) {
    return {{"autopilot", autopilot->variant()}, {"action_repeat", autopilot->action_repeat()}};
  }
  const auto& policy = dynamic_cast<const RecurrentPolicy&>(low_level);
  return Describe(PrepareExport(policy, "the low-level policy", version), file);
}

/// What happens when, in the words of envs/low_level_flight.h.
Json Rules(const EnvConfig& env) {
  Json rules = {
      "Both policies' states are zeros when an episode begins.",
      "A policy step of the high-level policy begins every action_repeat control steps; one of the "
      "low-level policy with it, and every action_repeat of its own control steps after it.",
      "When the high-level policy acts, the targets become: pitch = pitch now + pitch_change, "
      "within "
      "+-pi/2; yaw = yaw now + yaw_change, within +-pi; true airspeed = true airspeed now + "
      "true_airspeed_change. They stay until it acts again.",
      "The low-level policy's first three observations are the targets less what is now, yaw by "
      "the "
      "short way; the others are those of the high-level policy."};
  if (env.high_level.averages_observations) {
    rules.push_back(
        "The high-level policy observes the mean of what is observed now and of what the low-level "
        "policy observed since the high-level policy's last policy step, with the high-level "
        "policy's own errors.");
  }
  return rules;
}

}  // namespace

std::string Manifest(ExportForm form, const ExportedPolicy& high_level,
                     const StoredPolicy& low_level, const HierarchyFiles& files) {
  const EnvConfig& env = high_level.interface.env;
  const std::string& version = high_level.metadata.at("version");
  Json manifest = {{"skein_version", version},
                   {"format", NameIn(kExportForms, form)},
                   {"aircraft", env.aircraft},
                   {"control_interval_s", env.control_interval_s},
                   {"high_level", Describe(high_level, files.high_level)},
                   {"low_level", DescribeLowLevel(low_level, version, files.low_level)},
                   {"rules", Rules(env)}};
  if (!files.combined.empty()) manifest["combined"] = {{"file", FileName(files.combined)}};
  return manifest.dump(1) + "\n";
}

bool IsManifest(const std::string& path) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure)) return false;
  try {
    const Json document = Json::parse(ReadFile(path), nullptr, /*allow_exceptions=*/false);
    return document.is_object() && document.contains("high_level") && document.contains("rules");
  } catch (const Error&) {  // it cannot be read, or is far too large
    return false;
  }
}

}  // namespace skein
