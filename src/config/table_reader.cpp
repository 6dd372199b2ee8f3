// SPDX-License-Identifier: Apache-2.0
#include "src/config/table_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"
#include "src/files/plain_line.h"

namespace skein {

toml::table ParseToml(const std::string& text, const std::string& source) {
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    throw Error(fmt::format("{}:{}: not valid TOML: {}", source, error.source().begin.line,
                            PlainLine(std::string(error.description()))));
  }
}

const toml::node* TableReader::Find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return table_.get(key);
}

std::string TableReader::TextIn(const toml::node& node, const std::string& key,
                                const char* form) const {
  const auto* const text = node.as_string();
  if (text == nullptr) throw Error(fmt::format("{} must be a {} in quotes", At(node, key), form));
  if (!IsOneLine(text->get())) throw Error(At(node, key) + " must be of one line");
  return text->get();
}

std::string TableReader::Text(const std::string& key, const std::string& otherwise) {
  const toml::node* const node = Find(key);
  return node == nullptr ? otherwise : TextIn(*node, key, "text");
}

void TableReader::Description(const std::string& key) {
  const toml::node* const node = Find(key);
  if (node != nullptr && !node->is_string()) {
    throw Error(At(*node, key) + " must be a text in quotes");
  }
}

bool TableReader::Flag(const std::string& key, bool otherwise) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return otherwise;
  if (const auto* flag = node->as_boolean()) return flag->get();
  throw Error(At(*node, key) + " must be true or false");
}

std::optional<double> TableReader::WholeNumber(const std::string& key, double min, double max) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return std::nullopt;
  return WholeNumberIn(*node, key, min, max);
}

std::optional<double> TableReader::PositiveNumber(const std::string& key) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return std::nullopt;
  const std::optional<double> number = node->value<double>();
  if (number && *number > 0 && std::isfinite(*number)) return number;
  throw Error(At(*node, key) + " must be a number above 0");
}

std::optional<double> TableReader::Number(const std::string& key, const Bounds& bounds) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return std::nullopt;
  return NumberIn(*node, key, bounds);
}

std::optional<Range> TableReader::NumberRange(const std::string& key, const Bounds& bounds) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_array()) {
    const double end = NumberIn(*node, key, bounds);
    if (end < 0) throw Error(At(*node, key) + " must not be negative: it reaches to either side");
    return Range{-end, end};
  }
  const std::vector<const toml::node*> ends = ElementsOf(*node, key);
  if (ends.size() != 2) throw Error(At(*node, key) + " must be two numbers, [from, to]");
  const Range range{NumberIn(*ends[0], key, bounds), NumberIn(*ends[1], key, bounds)};
  if (range.min > range.max) throw Error(At(*node, key) + " must not end before it begins");
  return range;
}

std::vector<std::string> TableReader::Texts(const std::string& key) {
  std::vector<std::string> texts;
  for (const toml::node* element : Elements(key)) {
    texts.push_back(TextIn(*element, key, "list of texts"));
  }
  return texts;
}

std::vector<std::uint64_t> TableReader::WholeNumbers(const std::string& key, double max) {
  std::vector<std::uint64_t> numbers;
  for (const toml::node* element : Elements(key)) {
    numbers.push_back(static_cast<std::uint64_t>(WholeNumberIn(*element, key, 0, max)));
  }
  return numbers;
}

const toml::table* TableReader::Table(const std::string& key) {
  const toml::node* const node = Find(key);
  if (node == nullptr || node->is_table()) return node == nullptr ? nullptr : node->as_table();
  throw Error(At(*node, key) + " must be one table, [" + key + "]");
}

std::vector<const toml::table*> TableReader::Tables(const std::string& key) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return {};
  if (node->is_table()) return {node->as_table()};
  std::vector<const toml::table*> tables;
  for (const toml::node* element : ElementsOf(*node, key)) {
    if (!element->is_table()) throw Error(At(*element, key) + " must be tables, [[" + key + "]]");
    tables.push_back(element->as_table());
  }
  return tables;
}

std::vector<const toml::node*> TableReader::Elements(const std::string& key) {
  const toml::node* const node = Find(key);
  return node == nullptr ? std::vector<const toml::node*>() : ElementsOf(*node, key);
}

void TableReader::RefuseOld(const std::string& old, const std::string& name) const {
  const toml::node* const node = table_.get(old);
  if (node != nullptr) throw Error(At(*node, old) + " is now called " + name);
}

void TableReader::RefuseOthers() const {
  for (const auto& [name, node] : table_) {
    const std::string key(name.str());
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    throw Error(fmt::format("{}:{}: unknown key {}{}; known keys: {}", source_,
                            node.source().begin.line, PlainLine(key), DidYouMean(key, known_),
                            fmt::join(known_, ", ")));
  }
}

void TableReader::RefuseLack(const std::vector<std::string>& missing,
                             const std::string& rule) const {
  for (const auto& [name, node] : table_) {
    const std::string key(name.str()), meant = DidYouMean(key, missing);
    if (meant.empty() || std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    throw Error(fmt::format("{}:{}: unknown key {}{}", source_, node.source().begin.line,
                            PlainLine(key), meant));
  }
  throw Error(Here() + ": " + rule);
}

std::string TableReader::At(const toml::node& node, const std::string& key) const {
  return fmt::format("{}:{}: {}", source_, node.source().begin.line, key);
}

std::string TableReader::Here() const {
  return fmt::format("{}:{}", source_, table_.source().begin.line);
}

std::vector<const toml::node*> TableReader::ElementsOf(const toml::node& node,
                                                       const std::string& key) const {
  const toml::array* const array = node.as_array();
  if (array == nullptr) throw Error(At(node, key) + " must be a list, in brackets");
  std::vector<const toml::node*> elements;
  for (const toml::node& element : *array) elements.push_back(&element);
  return elements;
}

double TableReader::WholeNumberIn(const toml::node& node, const std::string& key, double min,
                                  double max) const {
  const std::optional<double> number = node.value<double>();
  if (!number || !(*number >= min && *number <= max) || *number != std::floor(*number)) {
    throw Error(
        fmt::format("{} must be a whole number in [{:.16g}, {:.16g}]", At(node, key), min, max));
  }
  return *number;
}

double TableReader::NumberIn(const toml::node& node, const std::string& key,
                             const Bounds& bounds) const {
  const std::optional<double> number = node.value<double>();
  if (number && bounds.Contains(*number)) return *number;
  throw Error(fmt::format("{} must be a finite number in {}{:.10g}, {:.10g}]", At(node, key),
                          bounds.min_open ? "(" : "[", bounds.min, bounds.max));
}

}  // namespace skein
