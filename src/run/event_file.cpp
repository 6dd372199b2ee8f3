// SPDX-License-Identifier: Apache-2.0
#include "src/run/event_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>

#include "train/files/protobuf.h"

namespace skein {
namespace {

using protobuf::Key;
using protobuf::LittleEndian;
using protobuf::Message;
using protobuf::Varint;
using protobuf::WireType;

// Field numbers of Event, Summary, Summary.Value and SessionLog.
enum EventField { kWallTime = 1, kStep = 2, kFileVersion = 3, kSummary = 5, kSessionLog = 7 };
enum SummaryField { kValue = 1 };
enum ValueField { kTag = 1, kSimpleValue = 2 };
enum SessionLogField { kStatus = 1 };
constexpr std::uint64_t kStatusStart = 1;

constexpr std::array<std::uint32_t, 256> MakeCrcTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0x82F63B78u : 0u);
    table[i] = crc;
  }
  return table;
}

std::string EventHead(double unix_time_s, std::int64_t step) {
  return Key(kWallTime, WireType::kFixed64) + LittleEndian(unix_time_s) +
         Key(kStep, WireType::kVarint) + Varint(static_cast<std::uint64_t>(step));
}

std::uint32_t MaskedCrc(std::string_view bytes) {
  const std::uint32_t crc = Crc32c(bytes);
  return (crc >> 15 | crc << 17) + 0xa282ead8u;
}

}  // namespace

std::uint32_t Crc32c(std::string_view bytes) {
  static constexpr std::array<std::uint32_t, 256> kTable = MakeCrcTable();
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : bytes)
    crc = kTable[(crc ^ static_cast<unsigned char>(c)) & 0xFF] ^ (crc >> 8);
  return ~crc;
}

std::string FrameRecord(std::string_view data) {
  const std::string length = LittleEndian(static_cast<std::uint64_t>(data.size()));
  return length + LittleEndian(MaskedCrc(length)) + std::string(data) +
         LittleEndian(MaskedCrc(data));
}

std::string EncodeScalars(double unix_time_s, std::int64_t step,
                          const std::vector<std::pair<std::string, double>>& scalars) {
  std::string summary;
  for (const auto& [tag, value] : scalars) {
    summary += Message(kValue, Message(kTag, tag) + Key(kSimpleValue, WireType::kFixed32) +
                                   LittleEndian(static_cast<float>(value)));
  }
  return EncodeSummary(unix_time_s, step, summary);
}

std::string EncodeSummary(double unix_time_s, std::int64_t step, std::string_view summary) {
  return EventHead(unix_time_s, step) + Message(kSummary, summary);
}

EventFile::EventFile(const std::string& directory, double unix_time_s, std::int64_t first_step)
    : file_(fmt::format("{}/events.out.tfevents.{:.0f}.{}.skein", directory, unix_time_s, getpid()),
            OpenMode::kAppend) {
  const std::string version = Key(kWallTime, WireType::kFixed64) + LittleEndian(unix_time_s) +
                              Message(kFileVersion, "brain.Event:2");
  // A session that starts at a step makes TensorBoard forget what earlier files say from there on.
  const std::string session =
      EventHead(unix_time_s, first_step) +
      Message(kSessionLog, Key(kStatus, WireType::kVarint) + Varint(kStatusStart));
  file_.Write(FrameRecord(version) + FrameRecord(session));
}

void EventFile::Append(double unix_time_s, std::int64_t step,
                       const std::vector<std::pair<std::string, double>>& scalars) {
  file_.Write(FrameRecord(EncodeScalars(unix_time_s, step, scalars)));
}

void EventFile::AppendSummary(double unix_time_s, std::int64_t step, std::string_view summary) {
  file_.Write(FrameRecord(EncodeSummary(unix_time_s, step, summary)));
}

}  // namespace skein
