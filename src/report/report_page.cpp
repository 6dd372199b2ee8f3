// SPDX-License-Identifier: Apache-2.0
#include "src/report/report_page.h"

#include "base/error.h"
#include "src/files/installed_file.h"
#include "src/files/output_file.h"
#include "src/report/data_pack.h"

namespace skein {
namespace {

constexpr const char* kDataMark = "SKEIN-REPORT-DATA";
constexpr const char* kNoConnections = "connect-src 'none'";
constexpr const char* kOwnConnections = "connect-src 'self'";

std::string Replaced(std::string page, const std::string& mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos || page.find(mark, at + 1) != std::string::npos) {
    throw Error("the page for reports beside this program is not of its version; build it again");
  }
  return page.replace(at, mark.size(), text);
}

}  // namespace

std::optional<std::string> FindReportTemplate() {
  for (const std::string& path : {InstalledFile("report.html"), BuiltFile("viewer/report.html")}) {
    if (!path.empty()) return ReadFile(path);
  }
  return std::nullopt;
}

std::string ReportTemplate() {
  if (const auto page = FindReportTemplate()) return *page;
  throw Error(
      "this build has no page for reports: it was made without Node 18 or later, or without a "
      "network to get the page's packages (scripts/setup --viewer, then scripts/build)");
}

void WriteReport(const std::string& path, const std::string& deflated) {
  WriteFile(path, ReportPage(ReportTemplate(), deflated));
}

std::string ReportPage(const std::string& page_template, const std::string& deflated) {
  return Replaced(page_template, kDataMark, Base64(deflated));
}

std::string LivePage(const std::string& page_template) {
  return Replaced(Replaced(page_template, kDataMark, ""), kNoConnections, kOwnConnections);
}

}  // namespace skein
