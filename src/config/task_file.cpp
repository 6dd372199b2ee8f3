// SPDX-License-Identifier: Apache-2.0
#include "src/config/task_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/field_list.h"
#include "base/fnv_hash.h"
#include "envs/aircraft/aircraft.h"
#include "envs/task_registry.h"
#include "envs/tasks/observation_layout.h"
#include "envs/tasks/termination.h"
#include "src/config/nearest_name.h"
#include "src/config/table_reader.h"
#include "src/config/term_numbers.h"
#include "src/files/output_file.h"

namespace skein {
namespace {

constexpr std::size_t kMostBytes = 1 << 16;
constexpr std::size_t kLongestName = 40;
constexpr double kMost = 1e9;  ///< of any number but a count
constexpr Bounds kAnyNumber{-kMost, kMost};
constexpr Bounds kPositiveNumber{0, kMost, true};

using Kind = TermCondition::Kind;
using Shape = TermReward::Shape;

constexpr std::array<std::pair<const char*, Shape>, 5> kShapes = {
    {{"linear", Shape::kLinear},
     {"absolute", Shape::kAbsolute},
     {"squared", Shape::kSquared},
     {"gaussian", Shape::kGaussian},
     {"tolerance", Shape::kTolerance}}};

/// Names serve in file names and in exported code.
void RequireName(const std::string& name, const std::string& where) {
  const auto is_fit = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (!name.empty() && name.size() <= kLongestName && name[0] >= 'a' && name[0] <= 'z' &&
      std::all_of(name.begin(), name.end(), is_fit)) {
    return;
  }
  throw Error(
      fmt::format("{} must be a name of 1 to {} of a-z, 0-9 and _ that begins with a letter", where,
                  kLongestName));
}

void RequireAtMost(std::size_t count, int most, const std::string& where, const char* what) {
  if (count <= static_cast<std::size_t>(most)) return;
  throw Error(fmt::format("{}: {} {}, but there may be at most {}", where, count, what, most));
}

/// The one of `choices` that the table has; throws Error unless it is just one.
std::string OneOf(TableReader& reader, const std::vector<std::string>& choices) {
  std::vector<std::string> given;
  for (const std::string& choice : choices) {
    if (reader.Has(choice)) given.push_back(choice);
  }
  if (given.size() == 1) return given.front();
  throw Error(fmt::format("{}: {} one of {}", reader.Here(),
                          given.empty() ? "it needs" : "it must have just",
                          fmt::join(choices, ", ")));
}

/// Reads a task file's tables one after another.
class TaskFileReader {
 public:
  TaskFileReader(const toml::table& table, const std::string& source)
      : reader_(table, source), source_(source) {}

  TermTaskConfig Read() {
    ReadName();
    ReadTerrain();
    for (const toml::table* target : reader_.Tables("target")) ReadTarget(*target);
    RequireAtMost(task_.targets.size(), TermTaskConfig::kMaxTargets, source_, "targets");
    ReadObserved();
    for (const toml::table* reward : reader_.Tables("reward")) ReadReward(*reward);
    RequireAtMost(task_.rewards.size(), TermTaskConfig::kMaxRewards, source_, "rewards");
    if (const toml::table* reached = reader_.Table("reached")) ReadReached(*reached);
    for (const toml::table* end : reader_.Tables("termination")) ReadEnd(*end);
    RequireAtMost(task_.ends.size(), TermTaskConfig::kMaxConditions, source_, "terminations");
    return task_;
  }

 private:
  void ReadName() {
    reader_.Text("description", "");
    task_.name = reader_.Text("name", "");
    if (task_.name.empty()) {
      throw Error(source_ + ": a task file needs a name, such as name = \"hold_bank\"");
    }
    const std::string where = source_ + ": name";
    RequireName(task_.name, where);
    const std::vector<std::string> known = TaskNames();
    if (std::find(known.begin(), known.end(), task_.name) != known.end()) {
      throw Error(
          fmt::format("{} must be another than {}, which is a built-in task", where, task_.name));
    }
  }

  void ReadTerrain() {
    const toml::table* const table = reader_.Table("terrain");
    if (table == nullptr) return;
    TableReader own(*table, source_);
    task_.terrain_base_ft = own.Number("base_ft", kAnyNumber).value_or(0);
    for (const toml::node* node : own.Elements("waves")) {
      if (!node->is_table()) throw Error(own.At(*node, "waves") + " must be tables in braces");
      TableReader wave(*node->as_table(), source_);
      TerrainWave read;
      read.height_ft = wave.Number("height_ft", kAnyNumber).value_or(0);
      // Shorter ones would be steps to an aircraft, and lose their phase in float32.
      const Bounds length{1000, kMost};
      read.wavelength_north_ft = wave.Number("wavelength_north_ft", length).value_or(0);
      read.wavelength_east_ft = wave.Number("wavelength_east_ft", length).value_or(0);
      read.phase_rad = wave.Number("phase_deg", {-360, 360}).value_or(0) / kDegPerRad;
      wave.RefuseOthers();
      task_.terrain.push_back(read);
    }
    RequireAtMost(task_.terrain.size(), TermTaskConfig::kMaxWaves, own.Here(), "waves");
    own.RefuseOthers();
  }

  void ReadTarget(const toml::table& table) {
    TableReader own(table, source_);
    TermTarget target;
    const std::string quantity = own.Text("quantity", "");
    if (quantity.empty()) throw Error(own.Here() + ": a target needs a quantity");
    if (quantity == "point") {
      ReadPoint(own, &target);
    } else {
      ReadDraw(own, quantity, &target);
    }
    RequireName(target.name, own.Here() + ": name of a target");
    target.unit = ReadUnit(own, "unit", UsualUnit(target));
    for (const TermTarget& other : task_.targets) {
      if (other.name == target.name) {
        throw Error(fmt::format("{}: two targets are called {}", own.Here(), target.name));
      }
      if (other.quantity.value == target.quantity.value || IsPartOfPoint(other, target)) {
        throw Error(
            fmt::format("{}: {} has a target already, {}", own.Here(), quantity, other.name));
      }
    }
    own.RefuseOthers();
    task_.targets.push_back(target);
  }

  void ReadPoint(TableReader& own, TermTarget* target) {
    target->name = own.Text("name", "point");
    target->draw_from = TermTarget::Draw::kPoint;
    target->quantity.name = "point";
    target->quantity.value = TermValue::kPointNorth;
    target->distance_ft = own.NumberRange("distance_ft", {0, 1e6}).value_or(Range{0, 0});
    if (target->distance_ft.max <= 0 || target->distance_ft.min < 0) {
      throw Error(own.Here() + ": a point needs distance_ft = [from, to]");
    }
    target->azimuth_deg = own.Number("azimuth_deg", {0, 180}).value_or(0);
    target->elevation_deg = own.Number("elevation_deg", {0, 90}).value_or(0);
    if (!task_.targets.empty()) throw Error(own.Here() + ": a point must be the first target");
  }

  void ReadDraw(TableReader& own, const std::string& quantity, TermTarget* target) {
    target->quantity = FindTargetQuantity(quantity, own.Here());
    target->name = own.Text("name", quantity.substr(0, quantity.rfind('_')));
    const std::string draw = OneOf(own, {"around_start", "between"});
    target->draw_from =
        draw == "between" ? TermTarget::Draw::kBetween : TermTarget::Draw::kAroundStart;
    const Range range = own.NumberRange(draw, kAnyNumber).value_or(Range());
    target->draw = {range.min / target->quantity.per_value, range.max / target->quantity.per_value};
    if (target->draw_from == TermTarget::Draw::kAroundStart && !CanBeAroundStart(*target)) {
      throw Error(fmt::format(
          "{}: around_start is for altitude, airspeed, position and attitude; {} needs between",
          own.Here(), quantity));
    }
  }

  static bool CanBeAroundStart(const TermTarget& target) {
    switch (target.quantity.value) {
      case TermValue::kAltitude:
      case TermValue::kTrueAirspeed:
      case TermValue::kPitch:
      case TermValue::kYaw:
      case TermValue::kRoll:
      case TermValue::kNorth:
      case TermValue::kEast:
        return true;
      default:
        return false;
    }
  }

  static bool IsPartOfPoint(const TermTarget& other, const TermTarget& target) {
    const TermValue value = target.quantity.value;
    return other.draw_from == TermTarget::Draw::kPoint &&
           (value == TermValue::kNorth || value == TermValue::kEast ||
            value == TermValue::kAltitude);
  }

  /// Of lengths and speeds the aircraft's own, of angles a radian, of rates a radian per second.
  static TermUnit UsualUnit(const TermTarget& target) {
    const std::string& name = target.quantity.name;
    const auto ends_in = [&name](const std::string& end) {
      return name.size() > end.size() &&
             name.compare(name.size() - end.size(), end.size(), end) == 0;
    };
    if (name == "point" || ends_in("_ft")) return {ReferenceUnit::kAltitudeError, 1};
    if (ends_in("_fps")) return {ReferenceUnit::kSpeed, 1};
    if (ends_in("_deg_s")) return {ReferenceUnit::kNone, kDegPerRad};
    return {};
  }

  void ReadObserved() {
    const toml::table* const table = reader_.Table("observe");
    if (table == nullptr) throw Error(source_ + ": a task file needs [observe]");
    TableReader own(*table, source_);
    const TermNumbers numbers(task_);
    std::set<std::string> known;
    for (const toml::node* node : own.Elements("numbers")) {
      task_.observed.push_back(numbers.Read(*node, "numbers", own));
      if (!known.insert(task_.observed.back().name).second) {
        throw Error(
            fmt::format("{} has {} twice", own.At(*node, "numbers"), task_.observed.back().name));
      }
    }
    RequireAtMost(task_.observed.size(), TermTaskConfig::kMaxNumbers, own.Here(), "numbers");
    task_.observes_flight = own.Flag("flight", true);
    task_.observes_actions = own.Flag("last_actions", false);
    own.RefuseOthers();
    ObservationLayout layout;
    layout.lead = static_cast<int>(task_.observed.size());
    layout.flight = task_.observes_flight;
    layout.actions = task_.observes_actions ? kObservedActions : 0;
    if (layout.size() < kFewestObservations) {
      throw Error(fmt::format("{}: it observes {} numbers, but there must be at least {}",
                              own.Here(), layout.size(), kFewestObservations));
    }
  }

  void ReadReward(const toml::table& table) {
    TableReader own(table, source_);
    const TermNumbers numbers(task_);
    TermReward reward;
    const toml::node* const of = own.Find("quantity");
    if (of == nullptr) throw Error(own.Here() + ": a reward needs a quantity");
    if (of->is_array()) {
      for (const toml::node* node : own.Elements("quantity")) {
        reward.numbers.push_back(numbers.Read(*node, "quantity", own));
      }
    } else {
      reward.numbers.push_back(numbers.Read(*of, "quantity", own));
    }
    RequireAtMost(reward.numbers.size(), TermTaskConfig::kMaxOfNorm, own.Here(), "quantities");
    if (reward.numbers.empty()) throw Error(own.At(*of, "quantity") + " must name at least one");
    const std::optional<double> weight = own.Number("weight", kAnyNumber);
    if (!weight) throw Error(own.Here() + ": a reward needs a weight; a cost has one below 0");
    reward.weight = *weight;
    reward.unit = ReadUnit(own, "unit", {});
    reward.shape = ReadShape(own);
    ReadWidth(own, &reward);
    own.RefuseOthers();
    task_.rewards.push_back(reward);
  }

  Shape ReadShape(TableReader& own) {
    const std::string asked = own.Text("shape", "absolute");
    std::vector<std::string> names;
    for (const auto& [name, shape] : kShapes) {
      if (asked == name) return shape;
      names.emplace_back(name);
    }
    throw Error(fmt::format("{}: unknown shape {}{}; known: {}", own.Here(), asked,
                            DidYouMean(asked, names), fmt::join(names, ", ")));
  }

  void ReadWidth(TableReader& own, TermReward* reward) {
    const bool is_wide = reward->shape == Shape::kGaussian || reward->shape == Shape::kTolerance;
    if (!is_wide) return;
    const std::optional<double> width = own.Number("width", kPositiveNumber);
    if (!width) throw Error(own.Here() + ": this shape needs a width");
    reward->width = *width;
    if (reward->shape == Shape::kTolerance) {
      reward->margin = own.Number("margin", {0, kMost}).value_or(0);
    }
  }

  /// A condition on a number.
  TermCondition ReadCondition(TableReader& own, const std::vector<std::string>& kinds) {
    TermCondition condition;
    const toml::node* const of = own.Find("quantity");
    if (of == nullptr) throw Error(own.Here() + ": a condition needs a quantity");
    condition.number = TermNumbers(task_).Read(*of, "quantity", own);
    const std::string kind = OneOf(own, kinds);
    condition.kind = kind == "within"  ? Kind::kWithin
                     : kind == "below" ? Kind::kBelow
                     : kind == "above" ? Kind::kAbove
                                       : Kind::kBeyond;
    const bool is_size = kind == "within" || kind == "beyond";
    condition.limit = own.Number(kind, is_size ? kPositiveNumber : kAnyNumber).value_or(0);
    return condition;
  }

  void ReadReached(const toml::table& table) {
    TableReader own(table, source_);
    for (const toml::node* node : own.Elements("conditions")) {
      if (!node->is_table()) throw Error(own.At(*node, "conditions") + " must be tables in braces");
      TableReader reader(*node->as_table(), source_);
      task_.reached.push_back(reader.Has("box_ft")
                                  ? ReadBox(reader)
                                  : ReadCondition(reader, {"within", "below", "above"}));
      reader.RefuseOthers();
    }
    RequireAtMost(task_.reached.size(), TermTaskConfig::kMaxConditions, own.Here(), "conditions");
    if (task_.reached.empty()) throw Error(own.Here() + ": [reached] needs conditions");
    task_.dwell_s = own.Number("dwell_s", {0, 1e6}).value_or(0);
    task_.earliest_step = static_cast<int>(own.WholeNumber("earliest_step", 0, 1e9).value_or(0));
    task_.training_tolerance_min =
        own.Number("training_tolerance_min", Bounds::PositiveFraction()).value_or(1);
    task_.training_tolerance_max = own.Number("training_tolerance_max", {1, 1000}).value_or(1);
    if (task_.dwell_s > 0 && task_.has_point()) {
      throw Error(own.Here() + ": dwell_s must be 0: a point is passed, not held");
    }
    own.RefuseOthers();
  }

  TermCondition ReadBox(TableReader& own) {
    if (!task_.has_point()) {
      throw Error(own.Here() + ": box_ft is of a target that is a point, and there is none");
    }
    for (const TermCondition& other : task_.reached) {
      if (other.kind == Kind::kBox) throw Error(own.Here() + ": there is a box_ft already");
    }
    TermCondition box;
    box.kind = Kind::kBox;
    box.limit = own.Number("box_ft", kPositiveNumber).value_or(0);
    box.number.value = TermValue::kPointNorth;
    return box;
  }

  void ReadEnd(const toml::table& table) {
    TableReader own(table, source_);
    TermEnd end;
    end.condition = ReadCondition(own, {"below", "above", "beyond"});
    const std::string as = own.Text("as", "extreme_state");
    std::vector<std::string> failures;
    for (int k = static_cast<int>(Termination::kExtremeState);
         k <= static_cast<int>(Termination::kOverload); ++k) {
      failures.emplace_back(kTerminationNames[static_cast<std::size_t>(k)]);
      if (as == failures.back()) end.termination = k;
    }
    if (end.termination == 0) {
      throw Error(fmt::format("{}: it cannot end as {}{}; it can as {}", own.Here(), as,
                              DidYouMean(as, failures), fmt::join(failures, ", ")));
    }
    own.RefuseOthers();
    task_.ends.push_back(end);
  }

  static constexpr int kFewestObservations = 4;

  TableReader reader_;
  std::string source_;
  TermTaskConfig task_;
};

std::string HashOf(const std::string& text) {
  FnvHash hash;
  hash.Add(text.data(), text.size());
  return hash.Hex();
}

/// All that gives a row of observations its meaning.
std::string InterfaceOf(const TermTaskConfig& task) {
  const auto unit = [](const TermUnit& of) {
    return fmt::format("{}*{}", static_cast<int>(of.reference), of.number);
  };
  std::string text =
      fmt::format("{} {} {}", task.name, task.observes_flight, task.observes_actions);
  for (const TermNumber& number : task.observed) {
    const bool is_error = number.value == TermValue::kTargetError;
    const std::string of =
        is_error ? task.targets[static_cast<std::size_t>(number.target)].quantity.name : "";
    text += fmt::format(" {} {} {}", number.name, of, unit(number.unit));
  }
  return HashOf(text);
}

const std::vector<std::string>& TaskKeys() {
  static const std::vector<std::string> keys = {"name",   "description", "observe", "target",
                                                "reward", "reached",     "terrain", "termination"};
  return keys;
}

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

bool IsTaskFile(const std::string& task) {
  const std::string end = ".toml";
  return task.size() > end.size() && task.compare(task.size() - end.size(), end.size(), end) == 0;
}

std::string ReadTaskFileText(const std::string& path) {
  std::string text = ReadFile(path);
  if (text.size() <= kMostBytes) return text;
  throw Error(
      fmt::format("{}: a task file has at most {} bytes, not {}", path, kMostBytes, text.size()));
}

namespace {

TaskFile ReadTables(const std::string& text, const std::string& source,
                    const std::vector<std::string>& settings_tables) {
  if (text.size() > kMostBytes) {
    throw Error(fmt::format("{}: a task file has at most {} bytes", source, kMostBytes));
  }
  toml::table table = ParseToml(text, source);
  TaskFile file;
  for (const auto& [name, node] : table) {
    const std::string key(name.str());
    if (Contains(TaskKeys(), key)) continue;
    if (!Contains(settings_tables, key)) {
      std::vector<std::string> known = TaskKeys();
      known.insert(known.end(), settings_tables.begin(), settings_tables.end());
      throw Error(fmt::format("{}:{}: unknown key {}{}; known keys: {}", source,
                              node.source().begin.line, key, DidYouMean(key, known),
                              fmt::join(known, ", ")));
    }
    file.settings.insert(key, node);
  }
  file.terms = TaskFileReader(table, source).Read();
  file.terms.text = text;
  file.terms.hash = HashOf(text);
  file.terms.interface = InterfaceOf(file.terms);
  return file;
}

}  // namespace

TaskFile ReadTaskFile(const std::string& text, const std::string& source,
                      const std::vector<std::string>& settings_tables) {
  try {
    return ReadTables(text, source, settings_tables);
  } catch (const Error& error) {
    throw Error(OneLine(error.what()));
  }
}

}  // namespace skein
