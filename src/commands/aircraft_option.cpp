// SPDX-License-Identifier: Apache-2.0
#include "src/commands/aircraft_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "envs/aircraft/registry.h"
#include "src/config/configuration.h"

namespace skein {

std::string AircraftHelp(const std::string& what) {
  return fmt::format("{}: {}, or a file, FILE.json", what, fmt::join(AircraftNames(), ", "));
}

CLI::Option* AddAircraftOption(CLI::App* command, std::string* aircraft) {
  return command
      ->add_option("--aircraft", *aircraft,
                   "aircraft: a name from skein list aircraft, or your own aircraft file, whose "
                   "section env sets starts and targets unless other settings do; same as --set "
                   "env.aircraft=...")
      ->type_name("NAME_OR_FILE");
}

std::vector<std::string> AircraftFilesIn(const std::string& aircraft,
                                         const std::vector<std::string>& assignments) {
  std::vector<std::string> named = {aircraft};
  for (const std::string& assignment : assignments) {
    named.push_back(NameAssigned(assignment, "env.aircraft"));
  }
  std::vector<std::string> files;
  std::copy_if(named.begin(), named.end(), std::back_inserter(files), IsAircraftPath);
  return files;
}

CLI::Validator CompletesAircraft() {
  // Shells complete what stands in braces.
  return {[](const std::string&) { return std::string(); },
          fmt::format("{{{}}}", fmt::join(AircraftNames(), ","))};
}

}  // namespace skein
