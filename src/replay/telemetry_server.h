// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/replay/acmi_writer.h"

namespace skein {

/// Where a TelemetryServer listens, and whom it lets in.
struct TelemetryOptions {
  std::string host = "127.0.0.1";
  int port = 0;          ///< 0: one that is free
  std::string password;  ///< empty: whoever comes
};

/// Streams a recording by Tacview's real-time telemetry protocol
/// (https://www.tacview.net/documentation/realtime/): to one client after another, each from the
/// beginning and at the pace of the flights.
class TelemetryServer {
 public:
  /// `stopped` is asked several times a second. `say` is given a line for people about every
  /// client. Listens at once; throws Error if it cannot.
  TelemetryServer(const TelemetryOptions& options, std::function<bool()> stopped,
                  std::function<void(const std::string&)> say);
  ~TelemetryServer();
  TelemetryServer(const TelemetryServer&) = delete;
  TelemetryServer& operator=(const TelemetryServer&) = delete;

  int port() const { return port_; }
  /// Until it is stopped. A client that leaves, or does not speak the protocol, is no error.
  void Serve(const AcmiRecording& recording);

 private:
  class Client;

  void Attend(Client& client, const AcmiRecording& recording);
  bool Admits(const std::vector<std::string>& greeting) const;

  std::function<bool()> stopped_;
  std::function<void(const std::string&)> say_;
  std::vector<std::string> hashes_;  ///< that let a client in; none: every client
  int listener_ = -1;
  int port_ = 0;
};

}  // namespace skein
