// SPDX-License-Identifier: Apache-2.0
#include "src/config/other_names.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>
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
  for (const SettingOfOthers& setting : SettingsOfOthers()) {
    EXPECT_EQ(FindField(fields, setting.key, "").key, setting.key);
    std::istringstream names(setting.names);
    for (std::string name; names >> name;) {
      EXPECT_TRUE(seen.insert(name).second) << name << " is there twice";
      EXPECT_EQ(last_parts.count(name), 0u) << name << " is a key here";
      EXPECT_EQ(WrittenAsKey(name), name);
      const MeantSetting meant = FindMeantSetting(fields, "--" + name);
      EXPECT_EQ(meant.name, setting.key);
      EXPECT_EQ(meant.difference, setting.difference);
    }
  }
}

TEST(OtherNames, AreFoundByTheLastPartHoweverTheyAreWritten) {
  ASSERT_NE(FindSettingOfOthers("ppo.num_envs"), nullptr);
  EXPECT_EQ(FindSettingOfOthers("--Num-Envs"), FindSettingOfOthers("ppo.num_envs"));
  for (const char* name : {"", "-", "--", "ppo.", "ppo.num_envs.x", "num_env"}) {
    EXPECT_EQ(FindSettingOfOthers(name), nullptr) << name;
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
