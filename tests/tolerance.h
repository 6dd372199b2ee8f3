// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <ostream>
#include <string>

#include "base/error.h"

namespace skein {

/// The environment variable SKEIN_TOLERANCE_SCALE, 1 without it. With 0.01, say, tests fail and
/// show how far results really are from what they are held against.
inline double ToleranceScale() {
  static const double scale = [] {
    const char* text = std::getenv("SKEIN_TOLERANCE_SCALE");
    if (text == nullptr) return 1.0;
    char* end = nullptr;
    const double value = std::strtod(text, &end);
    if (end == text || *end != '\0' || !(value >= 0)) {
      throw Error("SKEIN_TOLERANCE_SCALE is '" + std::string(text) +
                  "', and a number from 0 up is expected");
    }
    return value;
  }();
  return scale;
}

/// How far a result may lie from what it is held against, and why it may at all.
class Tolerance {
 public:
  constexpr Tolerance(double value, const char* reason) : value_(value), reason_(reason) {}

  operator double() const { return value_ * ToleranceScale(); }

  friend std::ostream& operator<<(std::ostream& out, const Tolerance& tolerance) {
    return out << static_cast<double>(tolerance) << " (" << tolerance.reason_ << ")";
  }

 private:
  double value_;
  const char* reason_;
};

/// For what is drawn at random.
inline constexpr Tolerance kStandardErrors{5, "standard errors: one false alarm in two million"};

}  // namespace skein
