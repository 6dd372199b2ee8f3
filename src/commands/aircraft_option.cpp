// SPDX-License-Identifier: Apache-2.0
#include "src/commands/aircraft_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "envs/aircraft/registry.h"

namespace skein {

std::string AircraftHelp(const std::string& what) {
  return fmt::format("{}: {}, or a file, FILE.json", what, fmt::join(AircraftNames(), ", "));
}

CLI::Option* AddAircraftOption(CLI::App* command, std::string* aircraft) {
  return command
      ->add_option("--aircraft", *aircraft,
                   "who flies: an aircraft of skein list aircraft, or a file of an own one, which "
                   "then says where it flies, unless other settings do; same as --set "
                   "env.aircraft=...")
      ->type_name("NAME_OR_FILE");
}

CLI::Validator IsAircraft() {
  return {[](const std::string& aircraft) -> std::string {
            const std::vector<std::string> names = AircraftNames();
            const bool is_known = std::find(names.begin(), names.end(), aircraft) != names.end();
            if (is_known || IsAircraftPath(aircraft)) return "";
            return fmt::format(
                "unknown aircraft \"{}\"; known: {}, or the path of a file, FILE.json", aircraft,
                fmt::join(names, ", "));
          },
          // Shells complete what stands in braces.
          fmt::format("{{{}}}", fmt::join(AircraftNames(), ","))};
}

}  // namespace skein
