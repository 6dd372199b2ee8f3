#include "src/settings.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "simd/error.h"

namespace skein {
namespace {

std::string MessageOf(void (*action)()) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Settings, KeysAreUnique) {
  std::set<std::string> keys;
  for (const Setting& setting : Settings()) EXPECT_TRUE(keys.insert(setting.key).second);
}

TEST(Settings, FieldsAreDistinct) {
  ProgramConfig config;
  std::set<const void*> places;
  for (const Setting& setting : Settings()) {
    const void* place =
        std::visit([](auto* field) -> const void* { return field; }, setting.field(config));
    EXPECT_TRUE(places.insert(place).second) << setting.key;
  }
}

TEST(Settings, BuiltInDefaultsLieWithinTheirBounds) {
  ProgramConfig config;
  config.train.total_steps = 1;  // the only field without a usable default
  for (const Setting& setting : Settings()) {
    const SettingField field = setting.field(config);
    if (const auto* const* number = std::get_if<double*>(&field)) {
      EXPECT_NO_THROW(Assign(setting, **number, "default", &config)) << setting.key;
    } else if (const auto* const* integer = std::get_if<int*>(&field)) {
      EXPECT_NO_THROW(Assign(setting, std::int64_t{**integer}, "default", &config)) << setting.key;
    }
  }
}

TEST(Settings, TheUnitOfEveryPhysicalQuantityIsInItsName) {
  for (const Setting& setting : Settings()) {
    for (const char* quantity : {"altitude", "airspeed", "alpha_m", "beta_m", "yaw", "speed_"}) {
      if (setting.key.find(quantity) == std::string::npos) continue;
      const std::string unit = setting.key.substr(setting.key.rfind('_'));
      EXPECT_TRUE(unit == "_ft" || unit == "_fps" || unit == "_deg" || unit == "_rad")
          << setting.key;
    }
  }
}

TEST(Settings, UnknownKeysSuggestTheNearest) {
  EXPECT_EQ(MessageOf([] { FindSetting("ppo.learnig_rate", "--set"); }),
            "--set: unknown key ppo.learnig_rate; did you mean ppo.learning_rate?");
  EXPECT_EQ(MessageOf([] { FindSetting("gamma", "--set"); }),
            "--set: unknown key gamma; did you mean ppo.gamma?");
  EXPECT_EQ(MessageOf([] { FindSetting("zzzzzzzz", "--set"); }),
            "--set: unknown key zzzzzzzz; `skein train --help-keys` lists all keys");
}

TEST(Settings, WrongTypesAndValuesOutOfRangeAreNamed) {
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign(FindSetting("ppo.gamma", ""), 1.5, "file:3", &config);
            }),
            "file:3: ppo.gamma = 1.5 is out of range; it must be in [0, 1]");
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign(FindSetting("ppo.epochs", ""), 2.5, "file:3", &config);
            }),
            "file:3: ppo.epochs must be an integer, not 2.5");
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign(FindSetting("env.flight_control", ""), std::string("off"), "--set", &config);
            }),
            "--set: env.flight_control must be \"full\" or \"direct\", not \"off\"");
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign(FindSetting("ppo.popart", ""), std::int64_t{1}, "--set", &config);
            }),
            "--set: ppo.popart must be true or false, not 1");
}

TEST(Settings, WholeNumbersServeAsIntegersAndIntegersAsNumbers) {
  ProgramConfig config;
  Assign(FindSetting("run.total_steps", ""), 1.35e9, "", &config);
  EXPECT_EQ(config.train.total_steps, 1350000000u);
  Assign(FindSetting("ppo.clip", ""), std::int64_t{1}, "", &config);
  EXPECT_EQ(config.train.ppo.clip, 1.0);
}

TEST(Settings, DocumentationListsEveryKey) {
  std::ifstream file(SKEIN_TEST_DATA "/../../docs/program.md");
  std::ostringstream text;
  text << file.rdbuf();
  for (const Setting& setting : Settings()) {
    EXPECT_NE(text.str().find("`" + setting.key + "`"), std::string::npos) << setting.key;
  }
}

}  // namespace
}  // namespace skein
