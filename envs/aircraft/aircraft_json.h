// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "envs/aircraft/aircraft.h"

namespace skein {

/// What an aircraft's file may be at most: the F-16's has 130 kB, six levels and 20 nodes.
inline constexpr std::size_t kMaxAircraftBytes = std::size_t{4} << 20;
inline constexpr int kMaxAircraftDepth = 12;
inline constexpr std::size_t kMaxAxisNodes = 64;
/// Numbers in a file are zero or lie between these in magnitude.
inline constexpr double kSmallestNumber = 1e-12, kLargestNumber = 1e12;

/// Keys of every aircraft's file that are not of its model: what it is called, which model it is,
/// settings of the environment for it, and the aircraft whose presets serve it, too.
inline constexpr const char* kNameKey = "name";
inline constexpr const char* kModelKey = "model";
inline constexpr const char* kSettingsKey = "env";
inline constexpr const char* kPresetsKey = "presets_of";
inline constexpr const char* kNotOfTheModel[] = {kNameKey, kModelKey, kSettingsKey, kPresetsKey};

/// The JSON in `text`. Throws Error that begins with `who` on text that is no JSON, too long or
/// nested too deeply, and on a key that an object has twice.
nlohmann::json ParseAircraftJson(std::string_view text, const std::string& who);

/// An object of an aircraft's file, whose every key must be read once Finish is called; "source"
/// and "about" are for the human reader. Errors name the path of the key. Numbers, laws, ramps and
/// actuators that are missing stay as they are until Finish, which names an unknown key first: that
/// is mostly the missing one, misspelt. All else that is missing is an error at once, which does so
/// after Know.
class Section {
 public:
  /// `values` must live as long.
  Section(const nlohmann::json& values, std::string path);

  /// Throws Error if there is a key but these and what was skipped.
  void Expect(std::initializer_list<const char*> keys);
  /// Says which keys there may be, beside those asked for: where one is missing, any other is
  /// named.
  void Know(std::initializer_list<const char*> keys);
  bool Has(const char* key);
  Section Below(const char* key) { return {At(key), path_ + "." + key}; }
  const std::string& path() const { return path_; }

  void Read(const char* key, double* value);
  /// A number above `low` and below `high`.
  void ReadBetween(double low, double high, const char* key, double* value);
  void ReadPositive(const char* key, double* value) {
    ReadBetween(0, std::numeric_limits<double>::infinity(), key, value);
  }
  /// [b1, b0, a0], of which a0 must be above 0.
  void Read(const char* key, FirstOrder* law);
  /// [x_low, y_low, x_high, y_high], of which x_high must be above x_low.
  void Read(const char* key, Ramp* ramp);
  /// A number above 0, and at most 1.
  void ReadFraction(const char* key, double* value);
  /// An object; its range must hold zero within.
  void Read(const char* key, Actuator* actuator);
  /// Numbers nested as deep as `shape` is long, row-major; each level must have as many elements as
  /// `shape` says.
  void Read(const char* key, const std::vector<std::size_t>& shape, std::vector<double>* values);
  /// Two to kMaxAxisNodes numbers, strictly increasing.
  void ReadAxis(const char* key, std::vector<double>* nodes);
  std::string ReadText(const char* key);
  std::vector<std::string> ReadTexts(const char* key);
  /// The names of all keys but "source" and "about", which count as read.
  std::vector<std::string> ReadKeys();
  /// Counts `key` as read, if it is there.
  void Skip(const char* key);

  /// Throws Error that `key` has the value, and what it must be; or that a number is missing, which
  /// the value may come from.
  [[noreturn]] void Refuse(const char* key, double value, const std::string& rule) const;

  /// Throws Error if there is a key that was not read, or a number is missing.
  void Finish() const;

 private:
  const nlohmann::json& At(const char* key);
  /// Null if there is no such key, which is then missing.
  const nlohmann::json* Find(const char* key);
  /// False if there is none.
  bool ReadNumber(const char* key, double* value);
  bool ReadList(const char* key, const char* meaning, std::initializer_list<double*> numbers);
  std::string Lacks(const std::string& key) const;
  [[noreturn]] void RefuseKey(const std::string& key) const;
  std::string MeantBy(const std::string& key) const;
  /// Throws Error that names a key which is none of `allowed`, if there is one; if several, one
  /// that is near to a key which is not there.
  void RefuseAllBut(const std::set<std::string>& allowed) const;

  const nlohmann::json& values_;
  std::string path_;
  std::set<std::string> known_;  ///< what was asked for
  std::set<std::string> read_;
  bool knows_all_ = false;  ///< known_ is all that there may be
  std::vector<std::string> missing_;
};

}  // namespace skein
