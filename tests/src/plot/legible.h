// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "src/plot/label_places.h"
#include "src/plot/picture.h"

namespace skein {

/// All words of a picture, in the order in which they are drawn.
inline std::vector<Words> WordsIn(const Picture& picture) {
  std::vector<Words> all;
  for (const Shape& shape : picture.shapes) {
    if (const auto* const words = std::get_if<Words>(&shape)) all.push_back(*words);
  }
  return all;
}

/// What those of them say that are read from below, as beside an axis.
inline std::vector<std::string> NamesOfLeftAxes(const Picture& picture) {
  std::vector<std::string> names;
  for (const Words& words : WordsIn(picture)) {
    if (words.runs_upwards) names.push_back(words.text);
  }
  return names;
}

/// All words lie on the paper, and no two on each other.
inline void ExpectLegible(const Picture& picture) {
  std::vector<PageBox> boxes;
  for (const Words& words : WordsIn(picture)) {
    const PageBox box = BoxOf(words);
    EXPECT_GE(box.left, 0) << words.text;
    EXPECT_LE(box.right, picture.width) << words.text;
    EXPECT_GE(box.top, 0) << words.text;
    EXPECT_LE(box.bottom, picture.height) << words.text;
    for (const PageBox& other : boxes) EXPECT_FALSE(box.Overlaps(other)) << words.text;
    boxes.push_back(box);
  }
}

}  // namespace skein
