// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace skein {

/// The page that viewer/ is built to, beside the program: of an installation in share/skein, else
/// of the build. Nothing if it was built without Node.
std::optional<std::string> FindReportTemplate();

/// The same; throws Error that says how to get one.
std::string ReportTemplate();

/// The page with the deflated pack (src/report/data_pack.h) in it. Base64 alone goes in: nothing
/// that a run contains can become part of the page's text. Throws Error if the template is not one.
std::string ReportPage(const std::string& page_template, const std::string& deflated);

/// Writes the page with these data to `path`. Throws Error if there is no template, or as
/// WriteFile.
void WriteReport(const std::string& path, const std::string& deflated);

/// The page that asks the server which sent it for its data (src/report/report_server.h).
std::string LivePage(const std::string& page_template);

}  // namespace skein
