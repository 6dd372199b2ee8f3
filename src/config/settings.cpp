// SPDX-License-Identifier: Apache-2.0
#include "src/config/settings.h"

#include <fmt/format.h>

#include <cmath>

#include "base/ends_with.h"
#include "base/error.h"
#include "base/nearest_name.h"
#include "src/config/other_names.h"
#include "src/files/plain_line.h"

namespace skein {
namespace {

/// A float as TOML writes it, which an integer is not.
std::string FormatNumber(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string Quote(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string Describe(const SettingValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return Quote(std::get<std::string>(value));
}

/// Puts a value into each kind of field.
struct Assigner {
  const Field& field;
  const SettingValue& value;
  const std::string& where;

  [[noreturn]] void RefuseType() const {
    throw Error(fmt::format("{}: {} must be {}, not {}", where, field.key, field.TypeName(),
                            Describe(value)));
  }
  double Number() const {
    double number = 0;
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
      number = static_cast<double>(*integer);
    } else if (const auto* exact = std::get_if<double>(&value)) {
      number = *exact;
    } else {
      RefuseType();
    }
    if (field.bounds.Contains(number)) return number;
    throw Error(fmt::format("{}: {}", where, field.OutOfRange(Describe(value))));
  }
  double WholeNumber() const {
    const double number = Number();
    if (number != std::floor(number)) RefuseType();
    return number;
  }
  template <typename T>
  const T& Exactly() const {
    if (const auto* exact = std::get_if<T>(&value)) return *exact;
    RefuseType();
  }

  void operator()(bool* place) const { *place = Exactly<bool>(); }
  void operator()(int* place) const { *place = static_cast<int>(WholeNumber()); }
  void operator()(std::uint64_t* place) const {
    *place = static_cast<std::uint64_t>(WholeNumber());
  }
  void operator()(double* place) const { *place = Number(); }
  void operator()(std::string* place) const {
    const std::string& text = Exactly<std::string>();
    if (!IsOneLine(text)) {
      throw Error(fmt::format("{}: {} must be of one line, not {}", where, field.key, Quote(text)));
    }
    *place = text;
  }
  void operator()(const NamedChoice& choice) const {
    if (!choice.Set(Exactly<std::string>())) RefuseType();
  }
};

}  // namespace

const Field& FindField(const std::vector<Field>& fields, const std::string& key,
                       const std::string& where) {
  for (const Field& field : fields) {
    if (field.key == key) return field;
    if (!key.empty() && field.former_key == key) {
      throw Error(fmt::format("{}: {} is called {} now", where, key, field.key));
    }
  }
  const std::string meant = DidYouMean(FindMeantSetting(fields, key));
  std::vector<std::string> keys;
  for (const Field& field : fields) keys.push_back(field.key);
  const std::string suggestion = meant.empty() ? DidYouMean(key, keys) : meant;
  throw Error(
      fmt::format("{}: unknown key {}{}", where, PlainLine(key),
                  suggestion.empty() ? "; `skein train --help-keys` lists all keys" : suggestion));
}

MeantSetting FindMeantSetting(const std::vector<Field>& fields, const std::string& name) {
  const std::string written = WrittenAsKey(name);
  const SettingOfOthers* const other = FindSettingOfOthers(name);
  for (const Field& field : fields) {
    if (other != nullptr && field.key == other->key) return {field.key, other->difference};
    if (!written.empty() && (field.key == written || EndsWith(field.key, "." + written))) {
      return {field.key, ""};
    }
  }
  return {};
}

std::string DidYouMean(const MeantSetting& meant) {
  if (meant.name.empty()) return "";
  const std::string difference =
      meant.difference.empty() ? "" : fmt::format(" ({})", meant.difference);
  return fmt::format("; did you mean {}{}?", meant.name, difference);
}

void Assign(const Field& field, const SettingValue& value, const std::string& where) {
  std::visit(Assigner{field, value, where}, field.place);
}

void Assign(const std::string& key, const SettingValue& value, const std::string& where,
            ProgramConfig* config) {
  const std::vector<Field> fields = FieldsOf(*config);
  Assign(FindField(fields, key, where), value, where);
}

std::string TomlText(const Field& field) {
  const std::string text = field.ValueText(FormatNumber);
  const bool is_name = std::holds_alternative<std::string*>(field.place) ||
                       std::holds_alternative<NamedChoice>(field.place);
  return is_name ? Quote(text) : text;
}

}  // namespace skein
