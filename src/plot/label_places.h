// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "src/plot/picture.h"

namespace skein {

/// A rectangle of the paper.
struct PageBox {
  double left = 0, top = 0, right = 0, bottom = 0;

  bool Overlaps(const PageBox& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

/// What words of that size take up.
PageBox BoxOf(const Words& words);

/// Puts words beside points where they cover least of what is there.
class LabelPlaces {
 public:
  /// Words had better stay within `paper`.
  explicit LabelPlaces(const PageBox& paper) : paper_(paper) {}

  /// What words had better not cover: a square of half side `reach`.
  void Avoid(PagePoint middle, double reach, double weight);
  /// What no words may cover, such as other words.
  void Forbid(const PageBox& box) { forbidden_.push_back(box); }

  /// Places `words`, which may lie at any of the `offsets` from a point, an earlier one rather than
  /// a later, and takes note of them; nothing if all of them cover other words or leave the paper.
  std::optional<Words> Put(Words words, PagePoint beside, const std::vector<Words>& offsets);
  /// Anywhere around the point.
  std::optional<Words> PutAround(const Words& words, PagePoint point);

 private:
  struct Obstacle {
    PageBox box;
    double weight;
  };

  bool IsFree(const PageBox& box) const;
  double CostOf(const PageBox& box) const;

  PageBox paper_;
  std::vector<Obstacle> taken_;
  std::vector<PageBox> forbidden_;
};

}  // namespace skein
