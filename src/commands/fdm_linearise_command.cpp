// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "src/commands/fdm_commands.h"
#include "src/commands/flight_condition.h"
#include "src/config/one_of.h"
#include "src/fdm/linearised_flight.h"
#include "src/files/output_file.h"
#include "src/plot/picture_file.h"
#include "src/plot/root_locus_picture.h"

namespace skein {
namespace {

const std::map<std::string, FlapMotion> kFlaps = {{"fixed", FlapMotion::kFixed},
                                                  {"scheduled", FlapMotion::kScheduled}};

struct LineariseOptions {
  FlightCondition condition;
  std::string flap = "fixed";
  std::string json, picture;
};

void FindLinearModels(const LineariseOptions& options) {
  if (!options.picture.empty()) CheckPictureFile(options.picture);
  CheckWritable({options.json, options.picture}, options.condition.model.FilesRead());
  RequireEnding(options.json, ".json", "--json writes JSON");
  const Plant plant = options.condition.MakePlant();
  const auto flights = AtEveryPoint<LinearisedFlight>(
      plant, options.condition.grid, [&](const SteadyFlightRequest& request) {
        return LineariseSteadyFlight(plant, request, kFlaps.at(options.flap));
      });
  fmt::print("linear models of {}, flap {}\n", options.condition.Describe(plant), options.flap);
  for (const LinearisedFlight& linearised : flights) {
    for (const ExceededLimit& limit : linearised.flight.exceeded_limits) {
      fmt::print("the flight at {} ft and {:.6g} ft/s {}\n",
                 ShortestText(linearised.request.altitude_ft),
                 linearised.request.true_airspeed_ft_s, limit.words);
    }
  }
  fmt::print("{}", flights.size() == 1 ? Describe(flights.front()) : DescribeModes(flights));
  if (!options.picture.empty()) {
    WritePicture(options.picture, DrawRootLocus(flights, kPictureWidth, ""));
  }
  if (options.json.empty()) return;
  nlohmann::ordered_json json = options.condition.ToJson(plant);
  json["leading_edge_flap"] = options.flap;
  for (const LinearisedFlight& linearised : flights) json["points"].push_back(ToJson(linearised));
  WriteJson(options.json, json);
}

}  // namespace

void AddLineariseCommand(CLI::App* fdm) {
  auto options = std::make_shared<LineariseOptions>();
  CLI::App* command = fdm->add_subcommand(
      "linearise", "Linear models and modes of steady flight, without and with flight control");
  AddFlightCondition(command, &options->condition);
  command
      ->add_option("--flap", options->flap,
                   "the leading-edge flap of the bare airframe: an input, or on its schedule")
      ->check(OneOf(kFlaps))
      ->capture_default_str();
  command->add_option("--json", options->json, "also write the matrices and modes here")
      ->type_name("FILE");
  AddPicture(command, "the modes of the bare airframe over the grid", &options->picture);
  command->footer(
      "What the figures mean: docs/how-to/ask-the-model.md.\n"
      "Example: skein fdm linearise --altitude-ft 15000 --speed-fps 500 --json model.json");
  command->callback([options] { FindLinearModels(*options); });
}

}  // namespace skein
