// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// A closed interval from which a value is drawn uniformly.
struct Range {
  double min = 0, max = 0;
};

}  // namespace skein
