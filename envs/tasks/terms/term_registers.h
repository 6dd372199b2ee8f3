// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>

#include "envs/tasks/terms/term_columns.h"
#include "envs/tasks/terms/term_program.h"
#include "envs/tasks/terms/term_task_config.h"

namespace skein {

/// A program under construction: gives what terms read its registers. Each value is computed once,
/// where it is first needed.
class TermRegisters {
 public:
  /// Both must outlive it.
  TermRegisters(const TermTaskConfig& config, const TermColumns& columns);

  /// `count` registers side by side; the first.
  int New(int count = 1);
  /// Appends an instruction; the register that it writes.
  int Add(const TermInstruction& instruction);
  /// The register of a column of the task.
  int TaskColumn(int column);
  /// Of a value; `target` is the index of a target error's, `constant` what TermValue::kOne is.
  int Value(TermValue value, int target = 0, float constant = 1);
  /// Of `number` times a factor, unless that is 1.
  int Scaled(int number, double factor);
  void AddResult(int number) { program_.results.push_back(number); }

  /// The program. Throws Error if it needs more registers than there are.
  TermProgram Take();

 private:
  int FlightColumn(TermOperation operation, int column);
  /// Of an operation that gives `count` values at once, of which `first` is the first.
  int OneOf(TermValue value, TermValue first, int count, TermInstruction instruction);
  int Angle(TermValue sine, TermValue cosine);
  int FlightValue(TermValue value);
  int SingleValue(TermValue value);
  int PointValue(TermValue value);
  int TargetError(int target);

  const TermTaskConfig& config_;
  const TermColumns& columns_;
  TermProgram program_;
  /// By value, and the target of an error; a group of values that come at once by its first and -1.
  std::map<std::pair<TermValue, int>, int> values_;
  std::map<int, int> task_columns_;
  std::map<std::pair<int, float>, int> scaled_;
};

}  // namespace skein
