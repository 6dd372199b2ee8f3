// SPDX-License-Identifier: Apache-2.0
#include "base/field_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "tests/error_message.h"

namespace skein {

enum class Colour { kRed, kBlue };

struct InnerConfig {
  double size_ft = 3;
  Range span_s{1, 2};
};

struct OuterConfig {
  bool is_lit = false;
  int count = 4;
  Colour colour = Colour::kBlue;
  std::string name = "swan";
  InnerConfig inner;
};

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

constexpr std::array<std::pair<Colour, const char*>, 2> kColours{
    {{Colour::kRed, "red"}, {Colour::kBlue, "blue"}}};

}  // namespace

void ListFields(InnerConfig& config, FieldList& list) {
  list.Add("size_ft", &config.size_ft, Bounds::Positive(), "how large");
  list.AddRange("span", "s", &config.span_s, {0, 9}, "from", "to");
}

void ListFields(OuterConfig& config, FieldList& list) {
  list.Add("is_lit", &config.is_lit, "shines").OffUnless(config.is_lit);
  list.Add("count", &config.count, Bounds::Count(), "how many").FixedForPolicies();
  list.Add("colour", &config.colour, kColours, "what colour").ChosenByPolicies();
  list.Add("name", &config.name, "what it is called");
  list.Group("inner", config.inner, {{"one", "other"}, config.count == 1, "core"});
}

namespace {

TEST(FieldList, KeysCarryTheirGroupsAndFormerNames) {
  OuterConfig config;
  FieldList list;
  list.Group("outer", config);
  std::vector<std::string> keys, former;
  for (const Field& field : list.fields()) {
    keys.push_back(field.key);
    if (!field.former_key.empty()) former.push_back(field.former_key);
  }
  EXPECT_THAT(
      keys, ElementsAre("outer.is_lit", "outer.count", "outer.colour", "outer.name",
                        "outer.inner.size_ft", "outer.inner.span_min_s", "outer.inner.span_max_s"));
  EXPECT_THAT(former,
              ElementsAre("outer.core.size_ft", "outer.core.span_min_s", "outer.core.span_max_s"));
}

TEST(FieldList, AGroupSaysWhoseItsFieldsAreAndWhetherTheyAreOff) {
  OuterConfig config;
  EXPECT_TRUE(FieldsOf(config)[0].is_off);
  EXPECT_FALSE(FieldsOf(config)[4].is_off);
  config.is_lit = true;
  config.count = 1;
  const std::vector<Field> fields = FieldsOf(config);
  EXPECT_FALSE(fields[0].is_off);
  EXPECT_TRUE(fields[4].is_off);
  EXPECT_TRUE(fields[0].IsOf("any"));
  EXPECT_TRUE(fields[4].IsOf("other"));
  EXPECT_FALSE(fields[4].IsOf("third"));
  EXPECT_EQ(fields[1].role, PolicyRole::kFixed);
  EXPECT_EQ(fields[2].role, PolicyRole::kChosen);
}

TEST(FieldList, ChoicesAreReadAndWrittenByName) {
  OuterConfig config;
  const Field field = FieldsOf(config)[2];
  const auto& choice = std::get<NamedChoice>(field.place);
  EXPECT_EQ(field.ValueText(ShortestText), "blue");
  EXPECT_EQ(field.TypeName(), "\"red\" or \"blue\"");
  EXPECT_TRUE(choice.Set("red"));
  EXPECT_FALSE(choice.Set("green"));
  EXPECT_EQ(config.colour, Colour::kRed);
  config.colour = static_cast<Colour>(7);
  EXPECT_THAT(MessageOf([&] { choice.name(); }), HasSubstr("without a name"));
}

TEST(FieldList, WhatIsOutOfBoundsIsNamed) {
  const auto complaint = [](const OuterConfig& faulty) {
    OuterConfig config = faulty;
    FieldList list;
    ListFields(config, list);
    return MessageOf([&] { list.Check(); });
  };
  OuterConfig config;
  EXPECT_EQ(complaint(config), "");
  config.inner.size_ft = 0;
  EXPECT_EQ(complaint(config),
            "configuration: inner.size_ft = 0 is out of range; it must be in (0, inf)");
  config.inner.size_ft = std::nan("");
  EXPECT_THAT(complaint(config), HasSubstr("inner.size_ft = nan is out of range"));
  config = {};
  config.count = 0;
  EXPECT_EQ(complaint(config),
            "configuration: count = 0 is out of range; it must be in [1, 2147483647]");
  config = {};
  config.inner.span_s = {5, 4};
  EXPECT_EQ(complaint(config),
            "configuration: inner.span_min_s = 5, but it must be no more than inner.span_max_s, 4");
}

TEST(FieldList, BoundsAreRoundedInwardsSoThatTheyCanBeTyped) {
  double value = 0;
  FieldList list;
  EXPECT_EQ(list.Add("x", &value, Bounds::UpToHalfTurn(), "").BoundsText(), "[0, 3.14159265]");
  EXPECT_EQ(list.Add("x", &value, {-0.1, 0.04}, "").BoundsText(), "[-0.1, 0.04]");
  EXPECT_EQ(list.Add("x", &value, Bounds::WholeNumber(), "").BoundsText(), "[0, 2^53 - 1]");
}

TEST(FieldList, FormerKeysOfAnOlderFileAreRenamed) {
  OuterConfig config;
  std::map<std::string, std::string> values{
      {"core.size_ft", "8"}, {"count", "2"}, {"core.unknown", "1"}};
  RenameFormerKeys(FieldsOf(config), &values);
  EXPECT_THAT(values, ElementsAre(Pair("core.unknown", "1"), Pair("count", "2"),
                                  Pair("inner.size_ft", "8")));
}

TEST(FieldList, TextsGiveBackTheValuesThatTheyWereMadeOf) {
  OuterConfig made{true, 7, Colour::kRed, "swift", {0.1, {0.5, 8}}}, taken;
  const std::vector<Field> from = FieldsOf(made), to = FieldsOf(taken);
  for (std::size_t i = 0; i < to.size(); ++i) {
    EXPECT_NE(to[i].ValueText(ShortestText), from[i].ValueText(ShortestText)) << to[i].key;
    to[i].SetText(from[i].ValueText(ShortestText));
    EXPECT_EQ(to[i].ValueText(ShortestText), from[i].ValueText(ShortestText)) << to[i].key;
  }
}

TEST(FieldList, TextsThatAreNoValueAreRefused) {
  OuterConfig config;
  const std::vector<Field> fields = FieldsOf(config);
  EXPECT_THAT(MessageOf([&] { fields[0].SetText("yes"); }), HasSubstr("true or false"));
  EXPECT_THAT(MessageOf([&] { fields[1].SetText("4.5"); }), HasSubstr("an integer"));
  EXPECT_THAT(MessageOf([&] { fields[2].SetText("green"); }), HasSubstr("\"red\" or \"blue\""));
  EXPECT_THAT(MessageOf([&] { fields[4].SetText("3 ft"); }), HasSubstr("a number"));
  EXPECT_FALSE(config.is_lit);
  EXPECT_EQ(config.inner.size_ft, 3);
}

}  // namespace
}  // namespace skein
