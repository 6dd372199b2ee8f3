// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace skein::validation {

/// A number that others published, and Skein's.
struct Figure {
  std::string what;
  /// As published: the median of several sources, and the range that they span.
  double published = 0, lowest = 0, highest = 0;
  double skein = 0;
  /// What Skein leaves out and a formula gives: it is added before the two are compared.
  double correction = 0;
  /// How far outside of the published range the sum may lie.
  double tolerance = 0;
  int decimals = 3;  ///< printed

  double difference() const { return skein + correction - published; }
  bool holds() const {
    return lowest - tolerance <= skein + correction && skein + correction <= highest + tolerance;
  }
};

/// One source's number.
Figure PublishedOnce(const std::string& what, double published, double skein, double tolerance,
                     int decimals);

/// Several sources' numbers.
Figure PublishedOften(const std::string& what, std::vector<double> published, double skein,
                      double correction, double tolerance, int decimals);

/// Figures of one table of docs/explanation/validation.md.
struct Section {
  const char* name;    ///< of the table in the page
  const char* source;  ///< heading of the published column
  std::vector<Figure> figures;
  /// Heading of the corrections; without them a null pointer, and the tolerances are shown.
  const char* correction = nullptr;
};

/// Every table of the page, in its order.
std::vector<Section> AllSections();

}  // namespace skein::validation
