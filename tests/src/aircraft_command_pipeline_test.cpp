// SPDX-License-Identifier: Apache-2.0
// `skein aircraft check` and `tune` as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "envs/aircraft/registry.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"

namespace skein {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class AircraftCommand : public testing::Test {
 protected:
  /// The Cessna as a user's file, without gains, with `airspeeds` of its starts, ft/s.
  static json Cessna(double slowest, double fastest) {
    json file = json::parse(AircraftText("cessna172"));
    file.erase("presets_of");
    file.erase("flight_control");
    file["env"] = {
        {"atmosphere", "standard_1976"},
        {"initial",
         {{"altitude_min_ft", 3000},
          {"altitude_max_ft", 3500},
          {"true_airspeed_min_fps", slowest},
          {"true_airspeed_max_fps", fastest}}},
        {"heading", {{"altitude_change_ft", 300}, {"speed_change_fps", 20}}},
        {"termination", {{"min_altitude_ft", 500}, {"min_mach", 0.05}, {"max_mach", 0.3}}}};
    return file;
  }

  void Write(const json& file) const { WriteFile(mine_, file.dump(1)); }

  ProgramResult Check(const std::string& aircraft) const {
    return CallSkein({"aircraft", "check", aircraft});
  }
  ProgramResult Tune(const std::string& out) const {
    return CallSkein({"aircraft", "tune", mine_, "-o", out});
  }

  const ScratchDirectory scratch_;
  const std::string mine_ = scratch_ / "mine.json", tuned_ = scratch_ / "tuned.json";
};

TEST_F(AircraftCommand, WhatTuneWritesIsCheckedAndTrained) {
  Write(Cessna(150, 190));
  const ProgramResult without = Check(mine_);
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_THAT(without.output, HasSubstr("there is no section flight_control"));
  ExpectOneLine(without.error, "has 1 error");

  const ProgramResult tuned = Tune(tuned_);
  ASSERT_EQ(tuned.exit_code, 0) << tuned.error;
  EXPECT_THAT(tuned.output, HasSubstr("wrote " + tuned_));
  const ProgramResult checked = Check(tuned_);
  EXPECT_EQ(checked.exit_code, 0) << checked.error;
  EXPECT_THAT(checked.output, HasSubstr("no errors"));
  const ProgramResult trained = CallSkein(TinyTraining(scratch_ / "run", {"--aircraft", tuned_}));
  EXPECT_EQ(trained.exit_code, 0) << trained.error;

  // What is there already is replaced, and the rest of the file stays as it is.
  json before = json::parse(ReadFile(mine_)), after = json::parse(ReadFile(tuned_));
  after.erase("flight_control");
  EXPECT_EQ(before, after);
  ASSERT_EQ(Tune(mine_).exit_code, 0);
  EXPECT_EQ(ReadFile(mine_), ReadFile(tuned_));
}

TEST_F(AircraftCommand, WhatTuneWritesOfShippedAircraftIsRead) {
  for (const std::string& name : AircraftNames()) {
    if (json::parse(AircraftText(name)).value("model", "derivatives") != "derivatives") continue;
    const ProgramResult tuned = CallSkein({"aircraft", "tune", name, "-o", tuned_});
    ASSERT_EQ(tuned.exit_code, 0) << name << ": " << tuned.error;
    EXPECT_NO_THROW(LoadAircraft(tuned_)) << name;
  }
}

TEST_F(AircraftCommand, CheckRefusesSettingsThatCannotBeFlown) {
  json file = Cessna(150, 190);
  file["flight_control"] = json::parse(AircraftText("cessna172"))["flight_control"];
  const auto refused = [&](const json& changed, const std::string& why) {
    Write(changed);
    const ProgramResult result = Check(mine_);
    EXPECT_EQ(result.exit_code, 1) << why;
    EXPECT_THAT(result.output, HasSubstr("error: " + why));
  };
  json wrong = file;
  wrong["env"]["heading"]["altitude_chnge_ft"] = 1;
  refused(wrong,
          "it cannot fly task heading: aircraft mine: unknown key env.heading.altitude_chnge_ft; "
          "did you mean env.heading.altitude_change_ft?");
  wrong = file;
  wrong["env"]["atmosphere"] = "standart_1976";
  refused(wrong, "it cannot fly task heading: aircraft mine: env.atmosphere");
  wrong = file;
  wrong["env"]["initial"]["true_airspeed_min_fps"] = 195;
  refused(wrong,
          "it cannot fly task heading: configuration: env.initial.true_airspeed_min_fps = 195, but "
          "it must be no more than env.initial.true_airspeed_max_fps, 190");
  wrong = file;
  wrong["presets_of"] = "cesna172";
  refused(wrong, "presets_of: unknown aircraft cesna172; did you mean cessna172?");
}

TEST_F(AircraftCommand, CheckSaysWhereStartsCannotBeFlown) {
  json file = Cessna(150, 190);
  file["flight_control"] = json::parse(AircraftText("cessna172"))["flight_control"];
  const auto check = [&](double slowest, double fastest) {
    file["env"]["initial"]["true_airspeed_min_fps"] = slowest;
    file["env"]["initial"]["true_airspeed_max_fps"] = fastest;
    Write(file);
    return Check(mine_);
  };
  EXPECT_THAT(check(150, 190).output, Not(HasSubstr("env.initial")));
  const ProgramResult slow = check(60, 190);
  EXPECT_EQ(slow.exit_code, 1);
  EXPECT_THAT(slow.output, HasSubstr("error: task heading begins at 3500 ft and 60 ft/s "
                                     "(env.initial), and level flight there is below stall speed"));
  const ProgramResult fast = check(150, 260);
  EXPECT_EQ(fast.exit_code, 0) << fast.error;
  EXPECT_THAT(fast.output, HasSubstr("warning: task heading begins at 3500 ft and 260 ft/s "
                                     "(env.initial), and level flight there needs more thrust"));
  file.erase("env");
  Write(file);
  const ProgramResult silent = Check(mine_);
  EXPECT_EQ(silent.exit_code, 0) << silent.error;
  EXPECT_THAT(silent.output, HasSubstr("warning: it cannot fly task heading yet"));
}

TEST_F(AircraftCommand, CheckSaysWhatIsWrongInTheFileBeforeHowItFlies) {
  constexpr double kFeetPerMetre = 1 / 0.3048;
  json file = Cessna(150, 190);
  file["flight_control"] = json::parse(AircraftText("cessna172"))["flight_control"];
  file["airframe"]["span_m"] = file["airframe"]["span_m"].get<double>() * kFeetPerMetre;
  Write(file);
  const std::string output = Check(mine_).output;
  const std::size_t cause = output.find("warning: airframe.chord_m");
  const std::size_t effect = output.find("error: at 0 ft and ");
  ASSERT_NE(cause, std::string::npos) << output;
  ASSERT_NE(effect, std::string::npos) << output;
  EXPECT_LT(cause, effect);
}

TEST_F(AircraftCommand, CheckRefusesTablesThatNothingFlies) {
  json file = json::parse(AircraftText("f16"));
  file["presets_of"] = "f16";
  Write(file);
  EXPECT_EQ(Check(mine_).exit_code, 0);
  file["aerodynamics"]["axes"]["beta_deg"][1] = -27.0;  // where cells are 5 wide
  Write(file);
  const ProgramResult checked = Check(mine_);
  const ProgramResult flown = CallSkein({"compare", "--task", "heading", "--agents", "zero",
                                         "--episodes", "1", "--no-html", "--aircraft", mine_});
  EXPECT_EQ(checked.exit_code, 1);
  EXPECT_THAT(checked.output, HasSubstr("error: aircraft mine: axis beta_deg has a cell of width"));
  ExpectOneLine(flown.error, "aircraft mine: axis beta_deg has a cell of width");
}

TEST_F(AircraftCommand, BadInputIsOneLine) {
  const auto refused = [](const std::vector<std::string>& arguments, int exit_code,
                          const std::string& why) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << why;
    ExpectOneLine(result.error, why);
  };
  refused({"aircraft"}, 2, "a command is needed: check, tune");
  refused({"aircraft", "check"}, 2, "NAME_OR_FILE is required");
  refused({"aircraft", "check", "f17"}, 2, "unknown aircraft \"f17\"");
  refused({"aircraft", "check", "f16", "--task", "nonsense"}, 2, "unknown task nonsense");
  refused({"aircraft", "check", scratch_ / "no.json"}, 2, "no.json");
  refused({"aircraft", "tune", scratch_ / "no.json"}, 2, "no.json");
  refused({"aircraft", "tune", "f17"}, 2, "unknown aircraft \"f17\"");
  WriteFile(mine_, "{");
  refused({"aircraft", "check", mine_}, 1, mine_);
  refused({"aircraft", "tune", mine_}, 1, mine_);
  json broken = Cessna(150, 190);
  broken["airframe"]["mass_kg"] = -1;
  Write(broken);
  refused({"aircraft", "check", mine_}, 1, "mass_kg");
  broken = Cessna(150, 190);
  broken["airframe"].erase("mass_kg");
  Write(broken);
  refused({"aircraft", "tune", mine_, "-o", tuned_}, 1, "mass_kg");
  Write(Cessna(150, 190));
  refused({"aircraft", "tune", mine_, "-o", scratch_ / "no/tuned.json"}, 2, "no/tuned.json");
  WriteFile(mine_, AircraftText("f16"));
  refused({"aircraft", "tune", mine_, "-o", tuned_}, 1, "this one is of tables");
  refused({"aircraft", "tune", "f16", "-o", tuned_}, 1, "this one is of tables");
  EXPECT_FALSE(std::filesystem::exists(tuned_));
}

TEST_F(AircraftCommand, WhatCannotBeFlownIsNotTuned) {
  json wrong = Cessna(150, 190);
  wrong["longitudinal"]["CL_alpha"] = -5;
  Write(wrong);
  const ProgramResult result = Tune(tuned_);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, HasSubstr("error: longitudinal.CL_alpha = -5"));
  ExpectOneLine(result.error, "cannot be derived before these are put right");
  EXPECT_FALSE(std::filesystem::exists(tuned_));
}

}  // namespace
}  // namespace skein
