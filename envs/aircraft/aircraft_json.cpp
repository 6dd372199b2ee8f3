// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/aircraft_json.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <locale>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/nearest_name.h"

namespace skein {
namespace {

using nlohmann::json;

std::string Text(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

/// A key of the file as an error may print it: on one line, and not the whole of a long one.
std::string Printable(const std::string& key) {
  constexpr std::size_t kLongest = 60;
  const std::string escaped = json(key).dump();
  std::string text = escaped.substr(1, escaped.size() - 2);
  if (text.size() > kLongest) {
    text.resize(kLongest);
    text += "...";
  }
  return text;
}

/// The library's message without the name of its exception and what it read last, which may be all
/// of a long text.
std::string Reason(const json::exception& error) {
  const std::string text = error.what();
  const auto start = text.find("] ");
  const std::string reason = start == std::string::npos ? text : text.substr(start + 2);
  return reason.substr(0, reason.find("; last read"));
}

double ToNumber(const json& value, const std::string& path) {
  if (!value.is_number()) throw Error(path + " must be a number");
  const double number = value.get<double>();
  const double size = std::abs(number);
  if (number == 0 || (size >= kSmallestNumber && size <= kLargestNumber)) return number;
  throw Error(path + " is " + Text(number) + ", but must be zero or between " +
              Text(kSmallestNumber) + " and " + Text(kLargestNumber) + " in magnitude");
}

void Flatten(const json& values, const std::vector<std::size_t>& shape, std::size_t level,
             const std::string& path, std::vector<double>* flat) {
  if (level == shape.size()) {
    flat->push_back(ToNumber(values, path));
    return;
  }
  if (!values.is_array() || values.size() != shape[level]) {
    throw Error(path + " must be a list of " + std::to_string(shape[level]) +
                (level + 1 < shape.size() ? " lists" : " numbers") + ", not " +
                (values.is_array() ? "of " + std::to_string(values.size()) : values.type_name()));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    Flatten(values[i], shape, level + 1, path + "[" + std::to_string(i) + "]", flat);
  }
}

/// Follows the parser through the file: how deep it is, and which keys its objects have had.
class Watcher {
 public:
  explicit Watcher(std::string who) : who_(std::move(who)) {}

  const std::string& last_key() const { return last_key_; }

  bool operator()(int depth, json::parse_event_t event, const json& value) {
    if (depth > kMaxAircraftDepth) {
      throw Error(who_ + " is nested more than " + std::to_string(kMaxAircraftDepth) +
                  " levels deep" + After());
    }
    if (event == json::parse_event_t::object_start) keys_.emplace_back();
    if (event == json::parse_event_t::object_end) keys_.pop_back();
    if (event == json::parse_event_t::key) {
      last_key_ = value.get<std::string>();
      if (!keys_.back().insert(last_key_).second) {
        throw Error(who_ + " has the key " + Printable(last_key_) + " twice in one object");
      }
    }
    return true;
  }

  std::string After() const {
    return last_key_.empty() ? "" : ", at the key " + Printable(last_key_);
  }

 private:
  std::string who_;
  std::vector<std::set<std::string>> keys_;
  std::string last_key_;
};

/// Without the unit in which it ends; empty if it ends in none.
std::string WithoutUnit(const std::string& key) {
  // What ends in another one stands before it.
  for (const std::string unit : {"_slug_ft2", "_kg_m2", "_slug", "_kg", "_ft2", "_m2", "_ft", "_m",
                                 "_lbf", "_n", "_deg", "_rad"}) {
    if (key.size() <= unit.size()) continue;
    const std::size_t length = key.size() - unit.size();
    if (key.compare(length, unit.size(), unit) == 0) return key.substr(0, length);
  }
  return "";
}

/// " (it has mass_kg: another unit)" if there is such a key in place of `key`.
std::string InAnotherUnit(const json& values, const std::string& key) {
  const std::string quantity = WithoutUnit(key);
  if (quantity.empty()) return "";
  for (const auto& [other, value] : values.items()) {
    if (WithoutUnit(other) == quantity) return " (it has " + other + ": another unit)";
  }
  return "";
}

/// Whether a key is for readers alone.
bool IsText(const std::string& key) { return key == "source" || key == "about"; }

}  // namespace

json ParseAircraftJson(std::string_view text, const std::string& who) {
  if (text.size() > kMaxAircraftBytes) {
    throw Error(who + " has " + std::to_string(text.size()) + " bytes; an aircraft may have " +
                std::to_string(kMaxAircraftBytes));
  }
  Watcher watcher(who);
  try {
    return json::parse(text.begin(), text.end(), std::ref(watcher));
  } catch (const json::exception& error) {
    throw Error(who + ": its data cannot be read" + watcher.After() + ": " + Reason(error));
  }
}

Section::Section(const json& values, std::string path) : values_(values), path_(std::move(path)) {
  if (!values_.is_object()) throw Error(path_ + " must be an object of named values");
}

const json* Section::Find(const char* key) {
  known_.insert(key);
  const auto found = values_.find(key);
  if (found == values_.end()) {
    missing_.emplace_back(key);
    return nullptr;
  }
  read_.insert(key);
  return &*found;
}

const json& Section::At(const char* key) {
  if (const json* value = Find(key)) return *value;
  if (knows_all_ && InAnotherUnit(values_, key).empty()) RefuseAllBut(known_);
  throw Error(Lacks(key));
}

void Section::Expect(std::initializer_list<const char*> keys) {
  Know(keys);
  RefuseAllBut(known_);
}

void Section::Know(std::initializer_list<const char*> keys) {
  known_.insert(keys.begin(), keys.end());
  knows_all_ = true;
}

bool Section::Has(const char* key) {
  known_.insert(key);
  return values_.contains(key);
}

void Section::Skip(const char* key) {
  known_.insert(key);
  read_.insert(key);
}

bool Section::ReadNumber(const char* key, double* value) {
  const json* const number = Find(key);
  if (number != nullptr) *value = ToNumber(*number, path_ + "." + key);
  return number != nullptr;
}

void Section::Read(const char* key, double* value) { ReadNumber(key, value); }

void Section::ReadFraction(const char* key, double* value) {
  if (!ReadNumber(key, value) || (*value > 0 && *value <= 1)) return;
  Refuse(key, *value, "above 0 and at most 1");
}

void Section::ReadBetween(double low, double high, const char* key, double* value) {
  if (!ReadNumber(key, value) || (*value > low && *value < high)) return;
  Refuse(key, *value, "above " + Text(low) + (std::isinf(high) ? "" : " and below " + Text(high)));
}

void Section::Read(const char* key, FirstOrder* law) {
  if (!ReadList(key, "b1, b0, a0 of (b1 s + b0) / (s + a0)", {&law->b1, &law->b0, &law->a0})) {
    return;
  }
  // With zero it integrates: no state of it is steady.
  if (!(law->a0 > 0)) Refuse(key, law->a0, "above 0 in a0: the filter never comes to rest");
}

void Section::Read(const char* key, Ramp* ramp) {
  const bool is_there = ReadList(key, "x_low, y_low, x_high, y_high",
                                 {&ramp->x_low, &ramp->y_low, &ramp->x_high, &ramp->y_high});
  if (!is_there || ramp->x_low < ramp->x_high) return;
  Refuse(key, ramp->x_high, "above its x_low, " + Text(ramp->x_low));
}

void Section::Read(const char* key, Actuator* actuator) {
  const json* const values = Find(key);
  if (values == nullptr) return;
  Section section(*values, path_ + "." + key);
  section.ReadPositive("bandwidth_per_s", &actuator->bandwidth_per_s);
  section.ReadPositive("rate_limit_deg_per_s", &actuator->rate_limit_deg_per_s);
  section.Read("min_deg", &actuator->min_deg);
  section.Read("max_deg", &actuator->max_deg);
  section.Finish();
  if (!(actuator->min_deg < 0 && actuator->max_deg > 0)) {
    throw Error(section.path() + " must have min_deg below zero and max_deg above");
  }
}

void Section::Read(const char* key, const std::vector<std::size_t>& shape,
                   std::vector<double>* values) {
  std::size_t size = 1;
  for (const std::size_t elements : shape) size *= elements;
  values->clear();
  values->reserve(size);
  Flatten(At(key), shape, 0, path_ + "." + key, values);
}

void Section::ReadAxis(const char* key, std::vector<double>* nodes) {
  const json& list = At(key);
  const std::string path = path_ + "." + key;
  if (!list.is_array() || list.size() < 2 || list.size() > kMaxAxisNodes) {
    throw Error(path + " must be a list of 2 to " + std::to_string(kMaxAxisNodes) + " numbers");
  }
  Read(key, {list.size()}, nodes);
  for (std::size_t i = 1; i < nodes->size(); ++i) {
    if ((*nodes)[i - 1] < (*nodes)[i]) continue;
    throw Error(path + "[" + std::to_string(i) + "] is " + Text((*nodes)[i]) +
                ", but must be above the number before it, " + Text((*nodes)[i - 1]));
  }
}

std::string Section::ReadText(const char* key) {
  const json& value = At(key);
  if (!value.is_string()) throw Error(path_ + "." + key + " must be a text");
  return value.get<std::string>();
}

std::vector<std::string> Section::ReadTexts(const char* key) {
  const json& list = At(key);
  const auto is_text = [](const json& text) { return text.is_string(); };
  if (!list.is_array() || !std::all_of(list.begin(), list.end(), is_text)) {
    throw Error(path_ + "." + key + " must be a list of texts");
  }
  return list.get<std::vector<std::string>>();
}

std::vector<std::string> Section::ReadKeys() {
  std::vector<std::string> keys;
  for (const auto& entry : values_.items()) {
    read_.insert(entry.key());
    if (!IsText(entry.key())) keys.push_back(entry.key());
  }
  return keys;
}

std::string Section::Lacks(const std::string& key) const {
  return path_ + " lacks " + key + InAnotherUnit(values_, key);
}

std::string Section::MeantBy(const std::string& key) const {
  std::vector<std::string> absent;
  for (const std::string& known : known_) {
    if (!values_.contains(known)) absent.push_back(known);
  }
  return DidYouMean(key, absent);
}

void Section::RefuseAllBut(const std::set<std::string>& allowed) const {
  std::vector<std::string> unknown;
  for (const auto& entry : values_.items()) {
    if (!IsText(entry.key()) && allowed.count(entry.key()) == 0) unknown.push_back(entry.key());
  }
  for (const std::string& key : unknown) {
    if (!MeantBy(key).empty()) RefuseKey(key);
  }
  if (!unknown.empty()) RefuseKey(unknown.front());
}

void Section::RefuseKey(const std::string& key) const {
  std::string rest = MeantBy(key);
  if (rest.empty() && !missing_.empty()) rest = ", and lacks " + missing_.front();
  throw Error(path_ + " has the unknown key " + Printable(key) + rest);
}

void Section::Refuse(const char* key, double value, const std::string& rule) const {
  if (!missing_.empty()) throw Error(Lacks(missing_.front()));
  throw Error(path_ + "." + key + " is " + Text(value) + ", but must be " + rule);
}

void Section::Finish() const {
  for (const std::string& key : missing_) {
    if (!InAnotherUnit(values_, key).empty()) throw Error(Lacks(key));
  }
  RefuseAllBut(read_);
  if (!missing_.empty()) throw Error(Lacks(missing_.front()));
}

bool Section::ReadList(const char* key, const char* meaning,
                       std::initializer_list<double*> numbers) {
  const json* const found = Find(key);
  if (found == nullptr) return false;
  const json& list = *found;
  const std::string path = path_ + "." + key;
  if (!list.is_array() || list.size() != numbers.size()) {
    throw Error(path + " must be a list of " + std::to_string(numbers.size()) +
                " numbers: " + meaning);
  }
  std::size_t i = 0;
  for (double* number : numbers) *number = ToNumber(list[i++], path);
  return true;
}

}  // namespace skein
