// SPDX-License-Identifier: Apache-2.0
#include "src/replay/acmi_writer.h"

#include <fmt/format.h>

namespace skein {
namespace {

/// A text as a property's value: commas and backslashes escaped, no control characters.
std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == ',' || c == '\\') escaped += '\\';
    escaped += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? ' ' : c;
  }
  return escaped;
}

/// A text of an event, whose parts are separated by bars.
std::string WithoutBars(std::string text) {
  for (char& c : text) {
    if (c == '|') c = '/';
  }
  return text;
}

}  // namespace

std::string AcmiFile(const AcmiRecording& recording) {
  std::string text = "\xEF\xBB\xBF" + recording.header;
  for (const AcmiFrame& frame : recording.frames) text += frame.text;
  return text;
}

std::string AcmiNumber(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

AcmiWriter::AcmiWriter(const std::vector<AcmiProperty>& properties) {
  recording_.header = "FileType=text/acmi/tacview\nFileVersion=2.2\n";
  for (const auto& [name, value] : properties) {
    recording_.header += fmt::format("0,{}={}\n", name, Escaped(value));
  }
}

void AcmiWriter::BeginFrame(double time_s) {
  recording_.frames.push_back({time_s, fmt::format("#{}\n", AcmiNumber(time_s, 4))});
}

void AcmiWriter::Place(std::uint64_t object, const AcmiTransform& transform) {
  AcmiTransform& last = objects_[object].transform;
  if (transform == last) return;
  std::string value;
  for (std::size_t i = 0; i < transform.size(); ++i) {
    if (i > 0) value += '|';
    if (transform[i] != last[i]) value += transform[i];
  }
  last = transform;
  text() += fmt::format("{:x},T={}\n", object, value);
}

void AcmiWriter::Set(std::uint64_t object, const std::vector<AcmiProperty>& properties) {
  std::map<std::string, std::string>& last = objects_[object].properties;
  std::string changed;
  for (const auto& [name, value] : properties) {
    const auto [known, is_new] = last.emplace(name, value);
    if (!is_new && known->second == value) continue;
    known->second = value;
    changed += fmt::format(",{}={}", name, Escaped(value));
  }
  if (!changed.empty()) text() += fmt::format("{:x}{}\n", object, changed);
}

void AcmiWriter::AddEvent(const std::string& kind, const std::vector<std::uint64_t>& objects,
                          const std::string& event_text) {
  std::string value = kind;
  for (const std::uint64_t object : objects) value += fmt::format("|{:x}", object);
  text() += fmt::format("0,Event={}|{}\n", value, Escaped(WithoutBars(event_text)));
}

void AcmiWriter::Remove(std::uint64_t object) {
  objects_.erase(object);
  text() += fmt::format("-{:x}\n", object);
}

}  // namespace skein
