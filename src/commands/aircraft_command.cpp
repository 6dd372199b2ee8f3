// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <utility>

#include "base/error.h"
#include "src/aircraft/aircraft_report.h"
#include "src/aircraft/aircraft_text.h"
#include "src/aircraft/start_findings.h"
#include "src/commands/aircraft_option.h"
#include "src/commands/commands.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

/// Prints what was found, errors first; returns how many errors there are.
int PrintFindings(const std::vector<Finding>& findings) {
  int errors = 0;
  for (const Finding& finding : findings) {
    if (finding.kind != Finding::kError) continue;
    fmt::print("error: {}\n", finding.text);
    ++errors;
  }
  for (const Finding& finding : findings) {
    if (finding.kind == Finding::kWarning) fmt::print("warning: {}\n", finding.text);
  }
  return errors;
}

void Check(const std::string& aircraft, const std::string& task) {
  const CheckedAircraft checked = LoadForCheck(aircraft);
  AircraftReport report = CheckAircraft(checked);
  if (checked.has_flight_control) {
    for (Finding& finding : CheckStart(aircraft, task))
      report.findings.push_back(std::move(finding));
  }
  fmt::print("{}\n", report.figures);
  // What is wrong in the file is mostly why it flies badly.
  int errors = PrintFindings(checked.findings);
  errors += PrintFindings(report.findings);
  if (errors > 0) throw Error(fmt::format("{} has {}", aircraft, Counted(errors, "error")));
  fmt::print(
      "{}: {}, no errors\n", checked.document.name,
      Counted(static_cast<int>(checked.findings.size() + report.findings.size()), "warning"));
}

void Tune(const std::string& in, const std::string& out) {
  CheckWritable(out);
  RequireEnding(out, ".json", "aircraft are written as JSON");
  const CheckedAircraft checked = LoadForCheck(in);
  const AircraftDocument& document = checked.document;
  if (document.model != "derivatives") {
    throw Error(in + ": gains are derived of models of derivatives, and this one is of " +
                document.model);
  }
  if (PrintFindings(checked.findings) > 0) {
    throw Error(in + ": flight control cannot be derived before these are put right");
  }
  const Plant tuned =
      checked.plant.WithFlightControl(TuneFlightControl(checked.plant, checked.limits));
  std::vector<Finding> findings;
  fmt::print("{}\n", DescribeHandling(tuned, checked.limits, ReportEnvelope(tuned, checked.limits),
                                      &findings));
  if (const int errors = PrintFindings(findings); errors > 0) {
    throw Error(fmt::format("{}: the gains found leave {}; nothing is written", in,
                            Counted(errors, "error")));
  }
  if (out.empty()) {
    fmt::print("nothing is written; -o FILE writes {} with these gains\n", in);
    return;
  }
  WriteFile(out, TextWithGains(document, tuned.aircraft().flight_control));
  fmt::print("wrote {}\n", out);
}

void AddTune(CLI::App* aircraft) {
  auto in = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  CLI::App* tune = aircraft->add_subcommand(
      "tune", "Derive all gains of flight control from a derivative model's linear model");
  tune->add_option("aircraft", *in,
                   "its file, with or without a section flight_control, or the name of one that "
                   "comes with Skein")
      ->type_name("NAME_OR_FILE")
      ->required()
      ->check(CompletesAircraft());
  tune->add_option("-o,--out", *out, "write the file with the gains here; may be the same file")
      ->type_name("FILE");
  tune->footer("Example: skein aircraft tune my_aircraft.json -o my_aircraft.json");
  tune->callback([in, out] { Tune(*in, *out); });
}

}  // namespace

void AddAircraftCommand(CLI::App* app) {
  CLI::App* aircraft = app->add_subcommand("aircraft", "Check an aircraft, derive its gains");
  aircraft->require_subcommand(1);

  auto checked = std::make_shared<std::string>(), task = std::make_shared<std::string>("heading");
  CLI::App* check = aircraft->add_subcommand(
      "check", "Say what is missing or implausible in an aircraft, with figures");
  check->add_option("aircraft", *checked, "its file, or the name of one that comes with Skein")
      ->type_name("NAME_OR_FILE")
      ->required()
      ->check(CompletesAircraft());
  check->add_option("--task", *task, "whose starts it must be able to fly: a task, or FILE.toml")
      ->type_name("TASK")
      ->capture_default_str();
  check->footer(
      "Exit code 1 if there is an error, 0 if there are warnings alone.\n"
      "Example: skein aircraft check my_aircraft.json");
  check->callback([checked, task] { Check(*checked, *task); });

  AddTune(aircraft);
}

}  // namespace skein
