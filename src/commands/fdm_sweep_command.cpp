// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "src/commands/fdm_commands.h"
#include "src/commands/flight_condition.h"
#include "src/config/one_of.h"
#include "src/fdm/flying_qualities_report.h"
#include "src/files/output_file.h"
#include "src/plot/handling_levels_picture.h"
#include "src/plot/picture_file.h"

namespace skein {
namespace {

struct SweepOptions {
  FlightCondition condition;
  std::string airplane_class = "IV", category = "A";
  std::string json, picture;

  std::string Standard() const {
    return fmt::format("class {}, category {}", airplane_class, category);
  }
};

void Sweep(const SweepOptions& options) {
  if (!options.picture.empty()) CheckPictureFile(options.picture);
  CheckWritable({options.json, options.picture}, options.condition.model.FilesRead());
  RequireEnding(options.json, ".json", "--json writes JSON");
  const Plant plant = options.condition.MakePlant();
  const LevelLimits limits = LimitsNamed(options.airplane_class, options.category);
  const auto flights = AtEveryPoint<AssessedFlight>(
      plant, options.condition.grid, [&](const SteadyFlightRequest& request) {
        return AssessSteadyFlight(plant, request, limits);
      });
  fmt::print("flying qualities of {}, with flight control; levels of {}\n\n{}",
             options.condition.Describe(plant), options.Standard(),
             flights.size() == 1 ? Describe(flights.front().qualities, options.Standard())
                                 : DescribeLevels(flights));
  if (!options.picture.empty()) {
    WritePicture(options.picture, DrawHandlingLevels(flights, limits, kPictureWidth, ""));
  }
  if (options.json.empty()) return;
  nlohmann::ordered_json json = options.condition.ToJson(plant);
  json["class"] = options.airplane_class;
  json["category"] = options.category;
  for (const AssessedFlight& flight : flights) json["points"].push_back(ToJson(flight));
  WriteJson(options.json, json);
}

}  // namespace

void AddSweepCommand(CLI::App* fdm) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = fdm->add_subcommand(
      "sweep",
      "Flying qualities with flight control: steps, levels of MIL-F-8785C, margins of the loops");
  FlightConditionForm form;
  form.may_turn = false;
  AddFlightCondition(command, &options->condition, form);
  command
      ->add_option("--class", options->airplane_class,
                   "of aeroplanes, by MIL-F-8785C: I small and light, II medium weight, III large "
                   "and heavy, IV high manoeuvrability")
      ->check(OneOf(AirplaneClassNames()))
      ->capture_default_str();
  command
      ->add_option("--category", options->category,
                   "of flight phases: A rapid manoeuvres and tracking, B gradual ones, C take-off "
                   "and landing")
      ->check(OneOf(FlightPhaseCategoryNames()))
      ->capture_default_str();
  command->add_option("--json", options->json, "also write the figures here")->type_name("FILE");
  AddPicture(command, "the equivalent short period against the levels", &options->picture);
  command->footer(
      "What the figures mean: docs/how-to/ask-the-model.md.\n"
      "Example: skein fdm sweep --altitude-ft 5000..35000:10000 --speed-fps 400..1000:100");
  command->callback([options] { Sweep(*options); });
}

}  // namespace skein
