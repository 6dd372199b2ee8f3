// SPDX-License-Identifier: Apache-2.0
#include "src/bench/machine.h"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace skein {
namespace {

CpuFacts FactsIn(const std::string& text) {
  std::istringstream cpuinfo(text);
  return ReadCpuFacts(cpuinfo);
}

TEST(Machine, ProcessorsOfOneShortNameAreToldApart) {
  const CpuFacts facts = FactsIn(
      "processor\t: 0\nvendor_id\t: AuthenticAMD\ncpu family\t: 25\nmodel\t\t: 17\n"
      "model name\t: AMD EPYC\nstepping\t: 1\npower management:\n\n"
      "processor\t: 1\ncpu family\t: 26\nmodel\t\t: 68\nmodel name\t: other\n");
  EXPECT_EQ(facts.name, "AMD EPYC");
  EXPECT_EQ(facts.family, 25);
  EXPECT_EQ(facts.model, 17);
  EXPECT_EQ(facts.stepping, 1);
}

TEST(Machine, WhatTheSystemDoesNotSayIsNotMadeUp) {
  const CpuFacts arm = FactsIn("processor\t: 0\nCPU implementer\t: 0x41\nCPU part\t: 0xd0c\n");
  EXPECT_EQ(arm.name, "unknown");
  EXPECT_FALSE(arm.family || arm.model || arm.stepping);
  EXPECT_FALSE(FactsIn("model\t\t: unknown\nstepping\t: 3 or 4\n").model);
  EXPECT_FALSE(FactsIn("stepping\t: 3 or 4\n").stepping);
  EXPECT_EQ(FactsIn("").name, "unknown");
}

TEST(Machine, TheDocumentHasWhatTheSystemSays) {
  const nlohmann::ordered_json document = DescribeMachine();
  std::ifstream cpuinfo("/proc/cpuinfo");
  const CpuFacts facts = ReadCpuFacts(cpuinfo);
  EXPECT_EQ(document["cpu"], facts.name);
  const auto said = [](const std::optional<int>& number) {
    return number ? std::to_string(*number) : "null";
  };
  EXPECT_EQ(document.at("cpu_family").dump(), said(facts.family));
  EXPECT_EQ(document.at("cpu_model").dump(), said(facts.model));
  EXPECT_EQ(document.at("cpu_stepping").dump(), said(facts.stepping));
}

TEST(Machine, TheProgramIsThatOfTheMachinesDocument) {
  const nlohmann::ordered_json machine = DescribeMachine(), program = ProgramJson();
  EXPECT_EQ(program.size(), 4u);
  for (const char* key : {"version", "commit", "compiler", "simd"}) {
    EXPECT_EQ(program.at(key), machine.at(key)) << key;
  }
}

}  // namespace
}  // namespace skein
