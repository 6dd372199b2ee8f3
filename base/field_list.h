// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/name_in.h"
#include "base/range.h"

namespace skein {

/// The largest whole number that no other is read as: 2^53 + 1 is 2^53 in a double.
inline constexpr double kMostWholeNumber = 0x1p53 - 1;

/// The interval that a number must lie in; `min_open` leaves `min` itself out. A number that is not
/// finite lies in none.
struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false;

  bool Contains(double value) const;

  static Bounds Any() { return {}; }
  static Bounds Positive() { return {0, Any().max, true}; }
  static Bounds NotNegative() { return {0, Any().max}; }
  static Bounds Fraction() { return {0, 1}; }
  static Bounds PositiveFraction() { return {0, 1, true}; }
  static Bounds UpToHalfTurn() { return {0, 3.1415926535897932}; }
  static Bounds Count() { return {1, std::numeric_limits<int>::max()}; }
  static Bounds CountOrNone() { return {0, std::numeric_limits<int>::max()}; }
  /// What every reader of numbers holds exactly: TOML's signed integers, and doubles.
  static Bounds WholeNumber() { return {0, kMostWholeNumber}; }
};

/// Where the value of an enumeration lies, read and written by its names. `names` must live as
/// long.
class NamedChoice {
 public:
  template <typename Enum, std::size_t kCount>
  NamedChoice(Enum* place, const std::array<std::pair<Enum, const char*>, kCount>& names)
      : name_([place, &names] { return NameIn(names, *place); }),
        set_([place, &names](std::size_t index) { *place = names[index].first; }) {
    for (const auto& [value, name] : names) names_.emplace_back(name);
  }

  const std::vector<std::string>& names() const { return names_; }
  /// Throws Error if the value has no name.
  std::string name() const { return name_(); }
  /// false, with nothing done, if there is no such name.
  bool Set(const std::string& name) const;

 private:
  std::vector<std::string> names_;
  std::function<const char*()> name_;
  std::function<void(std::size_t)> set_;
};

/// Where a field's value lies.
using FieldPlace = std::variant<bool*, int*, std::uint64_t*, double*, std::string*, NamedChoice>;

/// What a field means to a policy that was trained with it.
enum class PolicyRole {
  kNone,    ///< it may fly with another value
  kFixed,   ///< it cannot fly with another value
  kChosen,  ///< it flies with its own value, whatever the configuration says
};

/// One setting: its name (unit included), its place, its limits, and what depends on it.
struct Field {
  std::string key;         ///< with the groups that it is in: "env.heading.yaw_change_rad"
  std::string former_key;  ///< what older files call it; empty if they call it the same
  FieldPlace place;
  Bounds bounds;  ///< of numbers
  std::string help;
  std::vector<std::string> tasks;  ///< that read it; empty if all do
  /// At present nothing depends on it. Files that say what a result depends on leave it out, so
  /// that a field that is off by default does not set older files apart.
  bool is_off = false;
  PolicyRole role = PolicyRole::kNone;
  bool is_training_only = false;  ///< it serves learning alone: evaluations fly with its default

  bool IsOf(const std::string& task) const;
  bool IsNumber() const;
  /// "a number", "an integer", "true or false", or the names allowed.
  std::string TypeName() const;
  /// "(0, 1]" for numbers, else empty. The ends can be typed: they are rounded inwards.
  std::string BoundsText() const;
  /// The value, without quotes; numbers that are not whole by type as `number` writes them.
  std::string ValueText(std::string (*number)(double)) const;
  /// Takes the value that `text`, as of ValueText, stands for; throws Error if it stands for none.
  void SetText(const std::string& text) const;
  /// "KEY = VALUE is out of range; it must be in BOUNDS".
  std::string OutOfRange(const std::string& value) const;

  Field& OffUnless(bool is_on) {
    is_off = is_off || !is_on;
    return *this;
  }
  Field& FixedForPolicies() {
    role = PolicyRole::kFixed;
    return *this;
  }
  Field& TrainingOnly() {
    is_training_only = true;
    return *this;
  }
  Field& ChosenByPolicies() {
    role = PolicyRole::kChosen;
    return *this;
  }
};

/// What the fields of a group have in common.
struct FieldGroup {
  std::vector<std::string> tasks = {};
  bool is_off = false;
  std::string former_name = {};
};

/// The settings of a configuration struct, in order. Beside each such struct stands its
/// `void ListFields(Config& config, FieldList& list)`, in which every setting is one line; the
/// default is the member's initialiser. Whatever reads, writes, checks, compares or explains
/// settings follows this list. Places point into `config`, which must outlive them.
class FieldList {
 public:
  /// A flag or a name.
  template <typename Value>
  Field& Add(const char* key, Value* place, const char* help) {
    return AddField(key, place, {}, help);
  }
  /// A number.
  template <typename Number>
  Field& Add(const char* key, Number* place, const Bounds& bounds, const char* help) {
    return AddField(key, place, bounds, help);
  }
  /// A choice among names.
  template <typename Enum, std::size_t kCount>
  Field& Add(const char* key, Enum* place,
             const std::array<std::pair<Enum, const char*>, kCount>& names, const char* help) {
    return AddField(key, NamedChoice(place, names), {}, help);
  }
  /// The two fields QUANTITY_min_UNIT and QUANTITY_max_UNIT, the first no more than the second. The
  /// unit may be empty: then they are QUANTITY_min and QUANTITY_max.
  void AddRange(const std::string& quantity, const std::string& unit, Range* place,
                const Bounds& bounds, const char* help_min, const char* help_max);

  /// The fields of `config` as NAME.KEY.
  template <typename Config>
  void Group(const std::string& name, Config& config, const FieldGroup& group = {}) {
    const Prefix outer = prefix_;
    Enter(name, group);
    ListFields(config, *this);
    prefix_ = outer;
  }

  const std::vector<Field>& fields() const { return fields_; }

  /// Throws Error, naming the key, on the first number out of its bounds, and on the first range
  /// whose ends are exchanged.
  void Check() const;

 private:
  struct Prefix {
    std::string key, former_key;
    FieldGroup group;
  };

  void Enter(const std::string& name, const FieldGroup& group);
  Field& AddField(const std::string& key, FieldPlace place, const Bounds& bounds, const char* help);

  std::vector<Field> fields_;
  std::vector<std::size_t> ranges_;  ///< indices of the lower ends; the upper ones follow
  Prefix prefix_;
};

/// Gives values that an older file has under a field's former key its present one.
void RenameFormerKeys(const std::vector<Field>& fields, std::map<std::string, std::string>* values);

/// The fields of one struct.
template <typename Config>
std::vector<Field> FieldsOf(Config& config) {
  FieldList list;
  ListFields(config, list);
  return list.fields();
}

}  // namespace skein
