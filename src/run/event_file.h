// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "train/files/file_descriptor.h"

namespace skein {

/// CRC-32C (Castagnoli polynomial, reflected 0x82F63B78), as in RFC 3720.
std::uint32_t Crc32c(std::string_view bytes);

/// One record of a TFRecord file: little-endian length, masked CRC of it, data, masked CRC of that.
/// The mask is TensorFlow's: rotated right by 15 bits, plus 0xa282ead8.
std::string FrameRecord(std::string_view data);

/// An Event protocol buffer (tensorflow/core/util/event.proto) with a Summary of simple values.
std::string EncodeScalars(double unix_time_s, std::int64_t step,
                          const std::vector<std::pair<std::string, double>>& scalars);

/// The same with an encoded Summary of any values.
std::string EncodeSummary(double unix_time_s, std::int64_t step, std::string_view summary);

/// A TensorBoard event file.
class EventFile {
 public:
  /// Creates `directory`/events.out.tfevents.<time>.<process>.skein. Steps at or above `first_step`
  /// of earlier files in the directory are superseded by this one. Throws Error if it cannot be
  /// written.
  EventFile(const std::string& directory, double unix_time_s, std::int64_t first_step);

  void Append(double unix_time_s, std::int64_t step,
              const std::vector<std::pair<std::string, double>>& scalars);
  void AppendSummary(double unix_time_s, std::int64_t step, std::string_view summary);

 private:
  FileDescriptor file_;
};

}  // namespace skein
