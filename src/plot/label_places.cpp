// SPDX-License-Identifier: Apache-2.0
#include "src/plot/label_places.h"

#include <algorithm>
#include <limits>

namespace skein {
namespace {

constexpr double kLaterCost = 0.15;  // of an offset than of the one before it

/// Around a point: to its sides, in the corners, above and below, each nearer and farther.
std::vector<Words> PlacesAround() {
  std::vector<Words> places;
  for (const double reach : {1.0, 1.5, 2.2}) {
    const double side = 12 * reach, corner = 10 * reach;
    const auto add = [&](double x, double y, Anchor anchor) {
      Words place;
      place.at = {x, y + 3};
      place.anchor = anchor;
      places.push_back(place);
    };
    add(side, 0, Anchor::kStart);
    add(-side, 0, Anchor::kEnd);
    add(corner, -corner, Anchor::kStart);
    add(-corner, -corner, Anchor::kEnd);
    add(corner, corner, Anchor::kStart);
    add(-corner, corner, Anchor::kEnd);
    add(0, -side, Anchor::kMiddle);
    add(0, side + 2, Anchor::kMiddle);
  }
  return places;
}

}  // namespace

PageBox BoxOf(const Words& words) {
  const double width = TextWidth(words.text, words.size);
  const double before = words.anchor == Anchor::kStart    ? 0
                        : words.anchor == Anchor::kMiddle ? width / 2
                                                          : width;
  const double over = 0.85 * words.size, under = 0.25 * words.size;
  const auto& [x, y] = words.at;
  if (words.runs_upwards) return {x - over, y + before - width, x + under, y + before};
  return {x - before, y - over, x - before + width, y + under};
}

void LabelPlaces::Avoid(PagePoint middle, double reach, double weight) {
  taken_.push_back(
      {{middle.x - reach, middle.y - reach, middle.x + reach, middle.y + reach}, weight});
}

std::optional<Words> LabelPlaces::Put(Words words, PagePoint beside,
                                      const std::vector<Words>& offsets) {
  double least = std::numeric_limits<double>::infinity();
  std::optional<Words> best;
  for (const Words& offset : offsets) {
    words.at = {beside.x + offset.at.x, beside.y + offset.at.y};
    words.anchor = offset.anchor;
    const PageBox box = BoxOf(words);
    const double cost = CostOf(box) + kLaterCost * static_cast<double>(&offset - offsets.data());
    if (cost >= least || !IsFree(box)) continue;
    least = cost;
    best = words;
  }
  if (best) Forbid(BoxOf(*best));
  return best;
}

std::optional<Words> LabelPlaces::PutAround(const Words& words, PagePoint point) {
  static const std::vector<Words> places = PlacesAround();
  return Put(words, point, places);
}

bool LabelPlaces::IsFree(const PageBox& box) const {
  const bool is_inside = box.left >= paper_.left && box.right <= paper_.right &&
                         box.top >= paper_.top && box.bottom <= paper_.bottom;
  return is_inside && std::none_of(forbidden_.begin(), forbidden_.end(),
                                   [&](const PageBox& other) { return box.Overlaps(other); });
}

double LabelPlaces::CostOf(const PageBox& box) const {
  double cost = 0;
  for (const Obstacle& obstacle : taken_) {
    if (obstacle.box.Overlaps(box)) cost += obstacle.weight;
  }
  return cost;
}

}  // namespace skein
