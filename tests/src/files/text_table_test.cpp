// SPDX-License-Identifier: Apache-2.0
#include "src/files/text_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "src/config/conditions.h"
#include "src/config/configuration.h"

namespace skein {
namespace {

std::vector<std::string> LinesOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(TextTableTest, PartsThatFitAreOnOneLine) {
  EXPECT_EQ(InLines("  ", "one; two"), "  one; two");
  EXPECT_EQ(InLines("x ", {"one", "two"}, "   "), "x one   two");
  EXPECT_EQ(InLines("x ", ""), "x ");
}

TEST(TextTableTest, LinesOfPartsHaveAtMostAHundredColumnsAndLoseNothing) {
  for (std::size_t size = 1; size < 60; ++size) {
    const std::string part(size, 'p');
    std::string text = part;
    for (int i = 0; i < 12; ++i) text += "; " + part;
    std::string joined;
    for (const std::string& line : LinesOf(InLines("  ", text))) {
      EXPECT_LE(line.size(), 100u);
      EXPECT_EQ(line.rfind("  p", 0), 0u) << line;
      joined += (joined.empty() ? "" : " ") + line.substr(2);
    }
    EXPECT_EQ(joined, text);
  }
  // What is too long by itself stays whole.
  EXPECT_EQ(InLines("", std::string(120, 'p') + "; q"), std::string(120, 'p') + ";\nq");
}

TEST(TextTableTest, EveryConditionTogetherIsDescribedInAHundredColumns) {
  const ProgramConfig config =
      ResolveConfig({"heading",
                     "default",
                     "",
                     {},
                     {"windy=0..120fps,light..severe", "plant=middle", "noisy=0.01..0.05",
                      "high_altitude=30..35kft,held", "high_speed=mild,held"}});
  for (const std::string& line : LinesOf(InLines("  ", DescribeConditions(config.train.env)))) {
    EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST(TextTableTest, ColumnsAreAsWideAsTheirWidestCell) {
  EXPECT_EQ(InColumns({{"a", "bb", "c"}, {"aaa", "b"}, {"a sentence of its own"}}),
            "a    bb  c\naaa  b\na sentence of its own\n");
}

TEST(TextTableTest, HeadingsKeepCharactersWhole) {
  std::string text;
  TextTable(4, 20, &text).Headings({"abcdefghijklmnopq\u00e4\u00f6"});
  EXPECT_THAT(LinesOf(text)[0], testing::EndsWith("opq"));
  EXPECT_THAT(LinesOf(text)[1], testing::EndsWith(" \u00e4\u00f6"));
}

TEST(TextTableTest, CellsAreWholeAndLabelsCut) {
  std::string text;
  TextTable table(12, 12, &text);
  table.Begin("rms roll rate, deg/s");
  table.Cell("1.2 +- 0.1");
  table.Cell("-119.96 +- 9.59");
  table.Cell("3");
  table.Name("a name of some length");
  table.End();
  EXPECT_EQ(text, "..e, deg/s    1.2 +- 0.1  -119.96 +- 9.59           3  ..e length\n");
}

TEST(TextTableTest, HeadingsShowNamesWhole) {
  std::string text;
  TextTable table(4, 20, &text);
  table.Headings({"autopilot", "policy:runs/seed-1/checkpoints/policy-best.skein",
                  "policy:a-name-without-any-place-to-break"});
  EXPECT_EQ(LinesOf(text),
            (std::vector<std::string>{
                "                                policy:runs/",
                "                                     seed-1/  policy:a-name-with",
                "                                checkpoints/  out-any-place-to-b",
                "               autopilot   policy-best.skein                reak"}));
}

}  // namespace
}  // namespace skein
