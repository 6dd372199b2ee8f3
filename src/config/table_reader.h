// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/field_list.h"
#include "base/range.h"

namespace skein {

/// The document `text`. Throws Error with `source` and the line if it is not valid TOML.
toml::table ParseToml(const std::string& text, const std::string& source);

/// Reads one table key by key; what was not asked for is an error. All errors name the source, the
/// line and the key.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string source)
      : table_(table), source_(std::move(source)) {}

  const toml::node* Find(const std::string& key);
  bool Has(const std::string& key) { return Find(key) != nullptr; }

  /// A text of one line, as names are.
  std::string Text(const std::string& key, const std::string& otherwise);
  /// A text for people, which is not read. Throws Error if it is none.
  void Description(const std::string& key);
  bool Flag(const std::string& key, bool otherwise);
  std::optional<double> WholeNumber(const std::string& key, double min, double max);
  std::optional<double> PositiveNumber(const std::string& key);
  /// A finite number within the bounds.
  std::optional<double> Number(const std::string& key, const Bounds& bounds);
  /// [a, b] with a <= b, or a number x that stands for [-x, x].
  std::optional<Range> NumberRange(const std::string& key, const Bounds& bounds);
  std::vector<std::string> Texts(const std::string& key);  ///< of one line each
  std::vector<std::uint64_t> WholeNumbers(const std::string& key, double max);

  /// The table of [key]; null if there is none.
  const toml::table* Table(const std::string& key);
  /// The tables of [[key]], or the one of [key].
  std::vector<const toml::table*> Tables(const std::string& key);
  /// What the list of `key` holds, whatever it is.
  std::vector<const toml::node*> Elements(const std::string& key);

  /// Throws Error if `old`, which is now called `name`, is there.
  void RefuseOld(const std::string& old, const std::string& name) const;
  /// Throws Error on the first key that was not read.
  void RefuseOthers() const;
  /// Throws Error: none of `missing` is there, of which `rule` says that there must be one; or, if
  /// a key that was not read is nearly one of them, that it is unknown.
  [[noreturn]] void RefuseLack(const std::vector<std::string>& missing,
                               const std::string& rule) const;

  /// Where the node is and what it is called, for errors.
  std::string At(const toml::node& node, const std::string& key) const;
  /// The same of the table itself.
  std::string Here() const;
  const std::string& source() const { return source_; }

 private:
  std::string TextIn(const toml::node& node, const std::string& key, const char* form) const;
  std::vector<const toml::node*> ElementsOf(const toml::node& node, const std::string& key) const;
  double WholeNumberIn(const toml::node& node, const std::string& key, double min,
                       double max) const;
  double NumberIn(const toml::node& node, const std::string& key, const Bounds& bounds) const;

  const toml::table& table_;
  std::string source_;
  std::vector<std::string> known_;
};

}  // namespace skein
