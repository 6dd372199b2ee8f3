// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/report/report_data.h"

namespace skein {

/// The data of a report on runs that go on: made again when they have been written to, and flown
/// again when what flies is another policy, configuration or evaluation's seed.
class LiveReport {
 public:
  LiveReport(ReportRequest request, WorkerPool& pool);

  /// As ReportData, of now.
  const std::string& Data();

 private:
  ReportRequest request_;
  WorkerPool& pool_;
  std::string flown_, written_;  ///< the states of the files that were flown, and read
  ReportFlights flights_;
  std::string data_;
};

}  // namespace skein
