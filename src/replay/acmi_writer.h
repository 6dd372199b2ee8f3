// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace skein {

/// One moment of a recording: its lines, each with a newline; the first says the time.
struct AcmiFrame {
  double time_s = 0;
  std::string text;
};

/// A flight recording for Tacview in its format ACMI 2.2: UTF-8 text, metres, degrees, seconds
/// (https://www.tacview.net/documentation/acmi/).
struct AcmiRecording {
  std::string header;  ///< lines that come first, each with a newline
  std::vector<AcmiFrame> frames;
};

/// The recording as a file holds it, with a byte order mark.
std::string AcmiFile(const AcmiRecording& recording);

/// A fixed number of decimals, without zeros at their end: "1.5", "-3", "0".
std::string AcmiNumber(double value, int decimals);

/// Longitude and latitude relative to the recording's reference, deg; altitude, m; roll, pitch and
/// yaw, deg; then the place on the flat earth that was flown over, U east and V north, m, and the
/// heading there, deg.
using AcmiTransform = std::array<std::string, 9>;

using AcmiProperty = std::pair<std::string, std::string>;

/// Writes a recording moment by moment, and of each object only what has changed.
class AcmiWriter {
 public:
  /// `properties` are those of the whole recording.
  explicit AcmiWriter(const std::vector<AcmiProperty>& properties);

  /// Begins a moment, later than the one before.
  void BeginFrame(double time_s);
  /// A new object's number.
  std::uint64_t NewObject() { return next_object_++; }
  void Place(std::uint64_t object, const AcmiTransform& transform);
  void Set(std::uint64_t object, const std::vector<AcmiProperty>& properties);
  /// `kind` is one of the format's: Message, Bookmark, LeftArea and so on.
  void AddEvent(const std::string& kind, const std::vector<std::uint64_t>& objects,
                const std::string& text);
  void Remove(std::uint64_t object);

  AcmiRecording Finish() { return std::move(recording_); }

 private:
  struct Object {
    AcmiTransform transform;
    std::map<std::string, std::string> properties;
  };
  std::string& text() { return recording_.frames.back().text; }

  AcmiRecording recording_;
  std::map<std::uint64_t, Object> objects_;
  std::uint64_t next_object_ = 1;
};

}  // namespace skein
