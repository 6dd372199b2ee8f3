// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "envs/tasks/terms/term_task_config.h"
#include "src/config/table_reader.h"

namespace skein {

/// Finds the numbers that a task file names: those of flights, and its targets' errors.
class TermNumbers {
 public:
  /// Keeps a reference to `task`, whose targets must be known.
  explicit TermNumbers(const TermTaskConfig& task) : task_(task) {}

  /// The number called `name`. Throws Error that begins with `where`, with the nearest name; also
  /// if the task has not what the number is of.
  TermNumber Find(const std::string& name, const std::string& where) const;

  /// A number that is given by its name, or as {quantity = "NAME", unit = UNIT}.
  TermNumber Read(const toml::node& node, const std::string& key, const TableReader& reader) const;

  /// What can be named.
  std::vector<std::string> Names() const;

 private:
  void RequireWhatItIsOf(const TermNumber& number, const std::string& where) const;

  const TermTaskConfig& task_;
};

/// The flight's number called `name` that targets may be compared with. Throws Error as above.
TermNumber FindTargetQuantity(const std::string& name, const std::string& where);

/// "roll" of "roll_deg".
std::string NameWithoutUnit(const std::string& name);

/// The key's unit: a positive number, or the name of one of the aircraft's reference units; if it
/// is not there `otherwise`.
TermUnit ReadUnit(TableReader& reader, const std::string& key, const TermUnit& otherwise);

}  // namespace skein
