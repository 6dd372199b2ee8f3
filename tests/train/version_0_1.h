// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>

#include "train/files/tensor_file.h"

namespace skein {

/// Gives what begins with `current` a name that begins with `old` instead.
template <typename Value>
void BeginWith(const std::string& old, const std::string& current,
               std::map<std::string, Value>* entries) {
  std::map<std::string, Value> renamed;
  for (const auto& [name, value] : *entries) {
    const bool begins = name.compare(0, current.size(), current) == 0;
    renamed[begins ? old + name.substr(current.size()) : name] = value;
  }
  *entries = std::move(renamed);
}

/// A policy or checkpoint as version 0.1 would have written it: with its formats and its names.
inline TensorFile AsOfVersion01(TensorFile file) {
  for (const char* key : {"policy.format", "low_level.policy.format"}) {
    if (file.metadata.count(key) > 0) file.metadata[key] = "skein-policy-1";
  }
  if (file.metadata.count("checkpoint.format") > 0) {
    file.metadata["checkpoint.format"] = "skein-checkpoint-1";
  }
  BeginWith("config.env.planner.", "config.env.high_level.", &file.metadata);
  BeginWith("policy.env.planner.", "policy.env.high_level.", &file.metadata);
  BeginWith("controller.", "low_level.", &file.metadata);
  BeginWith("controller/", "low_level/", &file.tensors);
  BeginWith("recurrent/keep", "recurrent/not_done", &file.tensors);
  return file;
}

}  // namespace skein
