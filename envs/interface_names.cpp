// SPDX-License-Identifier: Apache-2.0
#include "envs/interface_names.h"

namespace skein {

std::vector<std::string> ObservationNames(const Task& task) {
  const std::vector<ObservedNumber> leading = task.leading_numbers();
  const ObservationLayout& layout = task.observation_layout();
  std::vector<std::string> names;
  for (const ObservedNumber& number : leading) {
    names.push_back(number.name + (number.unit == 1 ? "" : "_scaled"));
  }
  // A task that names no numbers of its own leads with its errors.
  const int first = leading.empty() && layout.lead > 0 ? 0 : kNumTaskErrors;
  if (layout.flight) {
    names.insert(names.end(), kObservationNames.begin() + first, kObservationNames.end());
  }
  for (int k = 0; k < layout.actions; ++k) {
    names.push_back(std::string("last_") + kActionNames[static_cast<std::size_t>(k)]);
  }
  return names;
}

}  // namespace skein
