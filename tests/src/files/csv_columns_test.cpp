// SPDX-License-Identifier: Apache-2.0
#include "src/files/csv_columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

using ::testing::ElementsAre;

TEST(CsvColumnsTest, ReadsWholeRowsAndCountsTornOnes) {
  const CsvColumns table = ParseCsv("a,b\n1,2.5\n3,\n4\n5,6");
  EXPECT_THAT(table.names, ElementsAre("a", "b"));
  EXPECT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.rows_left_out, 2);
  EXPECT_THAT(*table.Find("a"), ElementsAre(1, 3));
  EXPECT_EQ((*table.Find("b"))[0], 2.5);
  EXPECT_TRUE(std::isnan((*table.Find("b"))[1]));
  EXPECT_EQ(table.Find("c"), nullptr);
}

TEST(CsvColumnsTest, TakesNoNumberThatFloat32DoesNotHold) {
  const CsvColumns table = ParseCsv("a,b,c\n3e38,1e39,-inf\n");
  EXPECT_THAT(*table.Find("a"), ElementsAre(3e38));
  EXPECT_TRUE(std::isnan((*table.Find("b"))[0]));
  EXPECT_TRUE(std::isnan((*table.Find("c"))[0]));
}

TEST(CsvColumnsTest, ReadsWhatOtherProgramsMakeOfAFile) {
  const CsvColumns plain = ParseCsv("a,word\n1,up\n2,\n", "word");
  const CsvColumns marked = ParseCsv(
      "\xEF\xBB\xBF"
      "a,word\r\n1,up\r\n2,\r\n",
      "word");
  EXPECT_EQ(marked.names, plain.names);
  EXPECT_EQ(marked.values[0], plain.values[0]);
  EXPECT_EQ(marked.words, plain.words);
  EXPECT_THAT(marked.words, ElementsAre("up", ""));
  EXPECT_EQ(marked.rows_left_out, 0);
  EXPECT_TRUE(ParseCsv("\xEF\xBB\xBF").names.empty());
  EXPECT_THAT(ParseCsv("a\rb\n").names, ElementsAre("a\rb")) << "ends no line";
}

TEST(CsvColumnsTest, HasNothingOfAnEmptyOrHeadlessFile) {
  EXPECT_EQ(ParseCsv("").rows(), 0u);
  EXPECT_EQ(ParseCsv("iteration,env_st").rows_left_out, 1);
  EXPECT_TRUE(ParseCsv("iteration,env_st").names.empty());
}

}  // namespace
}  // namespace skein
