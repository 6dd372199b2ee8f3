// SPDX-License-Identifier: Apache-2.0
#include "tests/envs/validation/figure.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "tests/envs/validation/sections.h"

namespace skein::validation {

Figure PublishedOnce(const std::string& what, double published, double skein, double tolerance,
                     int decimals) {
  return PublishedOften(what, {published}, skein, 0, tolerance, decimals);
}

Figure PublishedOften(const std::string& what, std::vector<double> published, double skein,
                      double correction, double tolerance, int decimals) {
  std::sort(published.begin(), published.end());
  const std::size_t count = published.size();
  Figure figure;
  figure.what = what;
  figure.published = (published[(count - 1) / 2] + published[count / 2]) / 2;
  figure.lowest = published.front();
  figure.highest = published.back();
  figure.skein = skein;
  figure.correction = correction;
  figure.tolerance = tolerance;
  figure.decimals = decimals;
  return figure;
}

std::vector<Section> AllSections() {
  std::vector<Section> all;
  for (auto* sections : {FallingBodies, PublishedF16Figures, PublishedManoeuvres, PublishedTrims,
                         PublishedAirFigures}) {
    std::vector<Section> next = sections();
    std::move(next.begin(), next.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace skein::validation
