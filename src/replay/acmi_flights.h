// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "src/evaluation/flight_table.h"
#include "src/replay/acmi_writer.h"

namespace skein {

/// The episodes one after another, in each all agents side by side: aircraft with attitude, air
/// data, commands and surfaces, a colour for every agent; targets with tolerances; events where
/// targets are reached and flights end (docs/reference/file-formats.md). `title` says what is
/// flown, `comments` under what conditions. All agents have recorded the same episodes.
AcmiRecording RecordAcmi(const std::vector<AgentFlights>& agents, const std::string& title,
                         const std::string& comments);

}  // namespace skein
