// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/aircraft_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "envs/aircraft/aircraft_json.h"
#include "envs/aircraft/derivative_aircraft_file.h"
#include "envs/aircraft/registry.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

json Aerosonde() { return json::parse(*AircraftFiles()[0].text); }

AircraftDocument Read(const std::string& text) {
  return ReadAircraftDocument("mine", text, "here");
}

std::string HashOf(const json& content) { return Read(content.dump()).hash; }

std::string ErrorOf(const std::string& text) {
  return MessageOf([&] { Read(text); });
}

void Write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

TEST(AircraftDocument, TheHashIsOfTheModelAlone) {
  const json original = Aerosonde();
  const std::string hash = HashOf(original);
  EXPECT_EQ(hash.size(), 16u);
  EXPECT_EQ(Read(original.dump(4)).hash, hash) << "white space";
  json same = original;
  same["about"] = "another text";
  same["airframe"]["source"] = "a report";
  same["name"] = "goose";
  same["presets_of"] = "f16";
  same["env"] = {{"hold_s", 1}};
  same["airframe"]["mass_kg"] = 11;  // was 11.0
  EXPECT_EQ(HashOf(same), hash);
  json other = original;
  other["airframe"]["mass_kg"] = 11.0000001;
  EXPECT_NE(HashOf(other), hash);
}

TEST(AircraftDocument, ItsNameIsTheFilesUnlessItSaysItsOwn) {
  const ScratchDirectory scratch;
  json content = Aerosonde();
  Write(scratch / "my plane.json", content.dump());
  EXPECT_EQ(ReadAircraftDocumentFile(scratch / "my plane.json").name, "my_plane");
  content["name"] = "goose-2";
  EXPECT_EQ(Read(content.dump()).name, "goose-2");
  content["name"] = "a\nb";
  EXPECT_THAT(ErrorOf(content.dump()), HasSubstr("here: name must be 1 to 60"));
}

TEST(AircraftDocument, SettingsBecomeAssignments) {
  json content = Aerosonde();
  content["env"] = {{"about", "for readers"},
                    {"atmosphere", "standard_1976"},
                    {"initial", {{"altitude_min_ft", 1500}}},
                    {"drag_rise", false}};
  EXPECT_THAT(Read(content.dump()).settings,
              ElementsAre("env.atmosphere=\"standard_1976\"", "env.drag_rise=false",
                          "env.initial.altitude_min_ft=1500"));
  content["env"] = {{"initial", {1, 2}}};
  EXPECT_THAT(ErrorOf(content.dump()), HasSubstr("here.env: its values must be numbers"));
  content["env"] = {{"a=b", 1}};
  EXPECT_THAT(ErrorOf(content.dump()), HasSubstr("here.env has a key that is no"));
}

TEST(AircraftDocument, WhatIsNoJsonWithinTheLimitsIsRefusedInOneLine) {
  const auto refused = [](const std::string& text, const std::string& why) {
    EXPECT_THAT(ErrorOf(text), AllOf(HasSubstr("here"), HasSubstr(why), Not(HasSubstr("\n"))));
  };
  refused("", "cannot be read");
  refused("[]", "must be an object");
  refused("{\"a\": 1e999}", "at the key a: number overflow");
  refused("{\"a\": NaN}", "at the key a");
  refused("{\"a\": {\"b\": 1, \"b\": 2}}", "has the key b twice");
  refused("{\"a\": \"\xff\"}", "cannot be read");
  refused("{\"model\": \"tables\", \"a\\nb\": 1} x", "cannot be read");
  refused("{\"model\": \"guess\"}", "model must be \"derivatives\" or \"tables\"");
  std::string deep = "{\"a\": ";
  for (int i = 0; i < 100000; ++i) deep += '[';
  refused(deep, "nested more than 12 levels deep, at the key a");
  refused(std::string(kMaxAircraftBytes + 1, ' '), "may have 4194304");
}

TEST(AircraftDocument, WhatIsNoFileIsRefused) {
  const ScratchDirectory scratch;
  const auto refused = [](const std::string& path) {
    return MessageOf([&] { LoadAircraft(path); });
  };
  EXPECT_THAT(refused(scratch / "none.json"), HasSubstr("there is no such aircraft file"));
  EXPECT_THAT(refused(scratch.path()), HasSubstr("is not a file"));
  EXPECT_THAT(refused("/dev/zero"), HasSubstr("is not a file"));
}

TEST(AircraftDocument, AKeptFileOutlivesItsFile) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "heavy.json";
  json content = Aerosonde();
  content["airframe"]["mass_kg"] = 13.5;
  Write(path, content.dump());
  const std::string kept = KeepAircraftFile(path);
  EXPECT_EQ(kept, "heavy#" + HashOf(content));
  EXPECT_TRUE(IsKeptFile(kept));
  EXPECT_FALSE(IsAircraftPath(kept));
  content["airframe"]["mass_kg"] = 1;
  Write(path, content.dump());
  EXPECT_GT(LoadAircraft(kept).airframe.mass_slug, LoadAircraft("aerosonde").airframe.mass_slug);
  std::filesystem::remove(path);
  EXPECT_EQ(IdentifyAircraft(kept).name, "heavy");
  EXPECT_EQ(FindAircraft({"another name", IdentifyAircraft(kept).hash}), kept);
  EXPECT_EQ(PresetsOf(kept), "aerosonde");
  EXPECT_THAT(MessageOf([] {
                FindAircraft({"heavy", "0123456789abcdef"});
              }),
              HasSubstr("heavy#0123456789abcdef is not at hand"));
}

TEST(AircraftDocument, ACopyOfABuiltInAircraftIsThatAircraft) {
  const ScratchDirectory scratch;
  for (const AircraftFile& file : AircraftFiles()) {
    Write(scratch / "copy.json", std::string(*file.text));
    const AircraftIdentity copy = IdentifyAircraft(scratch / "copy.json");
    EXPECT_EQ(copy.name, "copy");
    EXPECT_EQ(copy.hash, IdentifyAircraft(file.name).hash);
    EXPECT_EQ(FindAircraft(copy), file.name);
  }
}

}  // namespace
}  // namespace skein
