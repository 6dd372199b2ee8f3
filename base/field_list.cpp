// SPDX-License-Identifier: Apache-2.0
#include "base/field_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"

namespace skein {
namespace {

/// A bound in at most ten digits: as many as leave it within the bounds, so that it can be typed.
std::string TextOfBound(double bound, const Bounds& bounds) {
  constexpr int kMostDigits = 10;
  if (bound == kMostWholeNumber) return "2^53 - 1";
  for (int digits = kMostDigits; digits > 0 && std::isfinite(bound); --digits) {
    std::string text = RoundedText(bound, digits);
    double typed = 0;
    std::from_chars(text.data(), text.data() + text.size(), typed);
    if (bounds.Contains(typed) || typed == bounds.min) return text;
  }
  return RoundedText(bound, kMostDigits);
}

/// "a", "b" or "c".
std::string ListNames(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 < names.size() ? ", " : " or ";
    list += '"' + names[i] + '"';
  }
  return list;
}

struct TypeNamer {
  std::string operator()(const bool*) const { return "true or false"; }
  std::string operator()(const int*) const { return "an integer"; }
  std::string operator()(const std::uint64_t*) const { return "an integer"; }
  std::string operator()(const double*) const { return "a number"; }
  std::string operator()(const std::string*) const { return "a name in quotes"; }
  std::string operator()(const NamedChoice& choice) const { return ListNames(choice.names()); }
};

struct Formatter {
  std::string (*number)(double);

  std::string operator()(const bool* place) const { return *place ? "true" : "false"; }
  std::string operator()(const int* place) const { return std::to_string(*place); }
  std::string operator()(const std::uint64_t* place) const { return std::to_string(*place); }
  std::string operator()(const double* place) const { return number(*place); }
  std::string operator()(const std::string* place) const { return *place; }
  std::string operator()(const NamedChoice& choice) const { return choice.name(); }
};

/// Puts the value that a text stands for in its place; false, with nothing done, if it stands for
/// none.
struct TextReader {
  const std::string& text;

  template <typename Number>
  bool operator()(Number* place) const {
    const char* const end = text.data() + text.size();
    Number value{};
    const auto [rest, failure] = std::from_chars(text.data(), end, value);
    if (failure != std::errc() || rest != end) return false;
    *place = value;
    return true;
  }
  bool operator()(bool* place) const {
    if (text != "true" && text != "false") return false;
    *place = text == "true";
    return true;
  }
  bool operator()(std::string* place) const {
    *place = text;
    return true;
  }
  bool operator()(const NamedChoice& choice) const { return choice.Set(text); }
};

/// Whether a number lies within its bounds; what is no number has none. By pointers as they lie in
/// the variant: to others the template would be the better match.
struct BoundsCheck {
  const Bounds& bounds;

  bool operator()(int* place) const { return bounds.Contains(*place); }
  bool operator()(std::uint64_t* place) const {
    return bounds.Contains(static_cast<double>(*place));
  }
  bool operator()(double* place) const { return bounds.Contains(*place); }
  template <typename Place>
  bool operator()(const Place&) const {
    return true;
  }
};

}  // namespace

bool Bounds::Contains(double value) const {
  const bool is_above = min_open ? value > min : value >= min;
  return std::isfinite(value) && is_above && value <= max;
}

bool NamedChoice::Set(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) return false;
  set_(static_cast<std::size_t>(found - names_.begin()));
  return true;
}

bool Field::IsOf(const std::string& task) const {
  return tasks.empty() || std::find(tasks.begin(), tasks.end(), task) != tasks.end();
}

bool Field::IsNumber() const {
  return std::holds_alternative<int*>(place) || std::holds_alternative<std::uint64_t*>(place) ||
         std::holds_alternative<double*>(place);
}

std::string Field::TypeName() const { return std::visit(TypeNamer{}, place); }

std::string Field::BoundsText() const {
  if (!IsNumber()) return "";
  const bool is_open_below = bounds.min_open || std::isinf(bounds.min);
  return (is_open_below ? "(" : "[") + TextOfBound(bounds.min, bounds) + ", " +
         TextOfBound(bounds.max, bounds) + (std::isinf(bounds.max) ? ")" : "]");
}

std::string Field::ValueText(std::string (*number)(double)) const {
  return std::visit(Formatter{number}, place);
}

void Field::SetText(const std::string& text) const {
  if (std::visit(TextReader{text}, place)) return;
  throw Error(key + " = " + text + " is not right; it must be " + TypeName());
}

std::string Field::OutOfRange(const std::string& value) const {
  return key + " = " + value + " is out of range; it must be in " + BoundsText();
}

void FieldList::AddRange(const std::string& quantity, const std::string& unit, Range* place,
                         const Bounds& bounds, const char* help_min, const char* help_max) {
  ranges_.push_back(fields_.size());
  const std::string suffix = unit.empty() ? "" : "_" + unit;
  AddField(quantity + "_min" + suffix, &place->min, bounds, help_min);
  AddField(quantity + "_max" + suffix, &place->max, bounds, help_max);
}

void FieldList::Check() const {
  for (const Field& field : fields_) {
    if (std::visit(BoundsCheck{field.bounds}, field.place)) continue;
    throw Error("configuration: " + field.OutOfRange(field.ValueText(ShortestText)));
  }
  for (const std::size_t i : ranges_) {
    const double min = *std::get<double*>(fields_[i].place);
    const double max = *std::get<double*>(fields_[i + 1].place);
    if (min <= max) continue;
    throw Error("configuration: " + fields_[i].key + " = " + ShortestText(min) +
                ", but it must be no more than " + fields_[i + 1].key + ", " + ShortestText(max));
  }
}

void FieldList::Enter(const std::string& name, const FieldGroup& group) {
  const std::string& former = group.former_name.empty() ? name : group.former_name;
  const bool is_renamed = !group.former_name.empty() || !prefix_.former_key.empty();
  const std::string& outer = prefix_.former_key.empty() ? prefix_.key : prefix_.former_key;
  prefix_.former_key = is_renamed ? outer + former + "." : "";
  prefix_.key += name + ".";
  if (!group.tasks.empty()) prefix_.group.tasks = group.tasks;
  prefix_.group.is_off = prefix_.group.is_off || group.is_off;
}

Field& FieldList::AddField(const std::string& key, FieldPlace place, const Bounds& bounds,
                           const char* help) {
  Field field;
  field.key = prefix_.key + key;
  if (!prefix_.former_key.empty()) field.former_key = prefix_.former_key + key;
  field.place = std::move(place);
  field.bounds = bounds;
  field.help = help;
  field.tasks = prefix_.group.tasks;
  field.is_off = prefix_.group.is_off;
  return fields_.emplace_back(std::move(field));
}

void RenameFormerKeys(const std::vector<Field>& fields,
                      std::map<std::string, std::string>* values) {
  for (const Field& field : fields) {
    const auto former = values->find(field.former_key);
    if (field.former_key.empty() || former == values->end()) continue;
    values->emplace(field.key, former->second);
    values->erase(former);
  }
}

}  // namespace skein
