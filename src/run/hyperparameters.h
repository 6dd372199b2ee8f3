// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// An encoded Summary (tensorflow/core/framework/summary.proto) of a run's configuration: as a text
/// under the tag "configuration", and as the start of a session for TensorBoard's HParams plugin,
/// key by key. `toml` is what DumpToml wrote; `name` that of the run; `unix_time_s` its start.
std::string EncodeHyperparameters(const std::string& toml, const std::string& name,
                                  double unix_time_s);

}  // namespace skein
