// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/report/report_data.h"

namespace skein {

/// The data of a report on runs that go on: made again when they have been written to.
class LiveReport {
 public:
  LiveReport(ReportRequest request, WorkerPool& pool);

  /// As ReportData, of now.
  const std::string& Data();

 private:
  ReportRequest request_;
  WorkerPool& pool_;
  std::string written_, data_;
};

}  // namespace skein
