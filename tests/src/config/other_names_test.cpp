// SPDX-License-Identifier: Apache-2.0
#include "src/config/other_names.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "src/config/settings.h"

namespace skein {
namespace {

TEST(OtherNames, EachIsThereOnceAndMeansAKeyThatIsCalledOtherwiseHere) {
  ProgramConfig config;
  const std::vector<Field> fields = FieldsOf(config);
  std::set<std::string> last_parts, seen;
  for (const Field& field : fields) {
    last_parts.insert(field.key.substr(field.key.rfind('.') + 1));
  }
  for (const OtherName& other : OtherNames()) {
    EXPECT_TRUE(seen.insert(other.name).second) << other.name << " is there twice";
    EXPECT_EQ(last_parts.count(other.name), 0u) << other.name << " is a key here";
    EXPECT_EQ(WrittenAsKey(other.name), other.name);
    EXPECT_EQ(FindField(fields, other.key, "").key, other.key);
    const MeantSetting meant = FindMeantSetting(fields, std::string("--") + other.name);
    EXPECT_EQ(meant.name, other.key);
    EXPECT_EQ(meant.difference, other.difference);
  }
}

TEST(OtherNames, AreFoundByTheLastPartHoweverTheyAreWritten) {
  ASSERT_NE(FindOtherName("ppo.num_envs"), nullptr);
  EXPECT_EQ(FindOtherName("--Num-Envs"), FindOtherName("ppo.num_envs"));
  for (const char* name : {"", "-", "--", "ppo.", "ppo.num_envs.x", "num_env"}) {
    EXPECT_EQ(FindOtherName(name), nullptr) << name;
  }
}

TEST(OtherNames, NoSettingIsMeantByNothing) {
  ProgramConfig config;
  for (const char* name : {"", "--", "."}) {
    EXPECT_EQ(FindMeantSetting(FieldsOf(config), name).name, "") << name;
  }
}

}  // namespace
}  // namespace skein
