// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/settings_text.h"

#include "src/config/settings.h"

namespace skein {

std::string SettingsText(const ProgramConfig& config, const std::string& beginning) {
  ProgramConfig listed = config;
  std::string text;
  for (const Field& field : FieldsOf(listed)) {
    if (!field.IsOf(config.train.env.task) ||
        field.key.compare(0, beginning.size(), beginning) != 0) {
      continue;
    }
    text += field.key + " = " + TomlText(field) + "\n";
  }
  // Evaluations leave these of a task file out, but keep its hash.
  if (const auto& terms = config.train.env.term_task; terms != nullptr) {
    text += "training_tolerances = " + std::to_string(terms->training_tolerance_min) + " " +
            std::to_string(terms->training_tolerance_max) + "\n";
  }
  return text;
}

}  // namespace skein
