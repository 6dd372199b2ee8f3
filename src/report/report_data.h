// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "src/config/program_config.h"
#include "src/evaluation/comparison.h"
#include "src/evaluation/flight_table.h"
#include "src/report/data_pack.h"
#include "src/report/run_record.h"

namespace skein {

/// What a report is made of.
struct ReportRequest {
  std::vector<std::string> runs;  ///< their directories
  int episodes = 1000;            ///< flown for the table of metrics; 0: no table
  int flights = 4;                ///< episodes that are shown in space; 0: none
  /// The option by which so many are asked for; without one as many are shown as memory holds.
  std::string flights_option = {};
  /// Comparisons that are there already (ShownComparison), which the page shows, too.
  std::vector<nlohmann::ordered_json> comparisons = {};
  std::string made = {};  ///< date and time that the page says; empty: now
};

/// Reads the runs, flies their policies beside the autopilots on the same episodes, and returns the
/// deflated pack (src/report/data_pack.h) whose document viewer/src/report.ts describes. A run
/// without a policy has curves alone. If the pool is stopping, the flights say nothing. Throws
/// Error on what is no run, or of a version that this one does not know, and UsageError on flights
/// that are asked for and have more control steps than kMostRecordedSteps.
std::string ReportData(const ReportRequest& request, WorkerPool& pool);

/// The runs of a request; those of the same name are called by their paths. Throws as
/// ReadRunRecord.
std::vector<RunRecord> ReadRuns(const ReportRequest& request);

/// What a report shows that has to be flown.
struct ReportFlights {  // NOLINT(bugprone-exception-escape): of the JSON library's move alone
  nlohmann::ordered_json comparisons, flights;  ///< lists, as in the document
  DataPack pack;                                ///< what `flights` refers into
  std::vector<std::string> notes;  ///< [run] why its policy does not fly; empty if it does
};

/// Flies the policies of the runs beside the autopilots. It reads their config.toml, the files of
/// their policies and the seed in evaluation.json. Throws UsageError as ReportData.
ReportFlights FlyRuns(const std::vector<RunRecord>& runs, const ReportRequest& request,
                      WorkerPool& pool);

/// The same pack, of runs that were read and flown.
std::string ReportData(const std::vector<RunRecord>& runs, const ReportFlights& flown,
                       const ReportRequest& request);

/// A comparison's document (ToJson), paired differences included, as a page needs it: with
/// `quantities`, what its rows are called, how they are shown, and which side is `better`:
/// "higher", "lower", or "" of what only describes a flight.
nlohmann::ordered_json ShownComparison(nlohmann::ordered_json comparison,
                                       const ProgramConfig& config);

/// The same of flights alone, of evaluations with `seed`.
std::string FlightsData(const std::vector<AgentFlights>& agents, std::uint64_t seed);

/// And of a comparison, with flights of its first episodes.
std::string ComparisonData(const Comparison& comparison, const ProgramConfig& config,
                           const std::vector<AgentFlights>& agents);

}  // namespace skein
