// SPDX-License-Identifier: Apache-2.0
#include "src/replay/telemetry_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "src/replay/password_hash.h"
#include "tests/error_message.h"
#include "tests/src/replay/acmi_reader.h"

namespace skein {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr const char* kProtocols = "XtraLib.Stream.0\nTacview.RealTimeTelemetry.0\n";

/// A client as Tacview is one.
class TestClient {
 public:
  explicit TestClient(int port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{20, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ~TestClient() { close(socket_); }

  void Send(const std::string& text) {
    EXPECT_EQ(send(socket_, text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }
  void Greet(const std::string& hash = "0") {
    Send(std::string(kProtocols) + "tester\n" + hash + '\0');
  }
  std::string ReadUntil(char end) {
    std::string text;
    for (char c = 0; recv(socket_, &c, 1, 0) == 1;) {
      if (c == end) break;
      text += c;
    }
    return text;
  }
  /// Everything up to where the server closes.
  std::string ReadToEnd() {
    std::string text;
    char bytes[4096];
    for (ssize_t n = 0; (n = recv(socket_, bytes, sizeof bytes, 0)) > 0;) {
      text.append(bytes, static_cast<std::size_t>(n));
    }
    return text;
  }

 private:
  int socket_;
};

class TelemetryServerTest : public ::testing::Test {
 protected:
  TelemetryServerTest() {
    AcmiWriter writer(std::vector<AcmiProperty>{{"Title", "test"}});
    for (int i = 0; i <= 10; ++i) {
      writer.BeginFrame(kLength_s * i / 10);
      writer.Set(1, {{"Mach", AcmiNumber(i, 0)}});
    }
    recording_ = writer.Finish();
  }
  ~TelemetryServerTest() override { Stop(); }

  void Serve(const std::string& password = "") {
    TelemetryOptions options;
    options.password = password;
    server_ = std::make_unique<TelemetryServer>(
        options, [this] { return stopped_.load(); },
        [this](const std::string& line) {
          const std::lock_guard<std::mutex> lock(mutex_);
          said_.push_back(line);
        });
    thread_ = std::thread([this] { server_->Serve(recording_); });
  }
  void Stop() {
    stopped_ = true;
    if (thread_.joinable()) thread_.join();
  }
  std::string Whole() const {
    std::string text = recording_.header;
    for (const AcmiFrame& frame : recording_.frames) text += frame.text;
    return text;
  }

  static constexpr double kLength_s = 0.3;
  AcmiRecording recording_;
  std::unique_ptr<TelemetryServer> server_;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::vector<std::string> said_;
  std::thread thread_;
};

TEST_F(TelemetryServerTest, ShakesHandsAndStreamsAtThePaceOfTheFlight) {
  Serve();
  TestClient client(server_->port());
  EXPECT_EQ(client.ReadUntil('\0'), std::string(kProtocols) + "Skein\n");
  // The server's clock starts as soon as it has read the greeting.
  const auto start = std::chrono::steady_clock::now();
  client.Greet();
  const std::string text = client.ReadToEnd();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(text, Whole());
  EXPECT_GE(taken.count(), kLength_s * 0.99);
  EXPECT_EQ(ReadAcmi(text).objects.at(1).samples.size(), 11u);
  Stop();
  EXPECT_THAT(said_, Contains("tester has seen all"));
}

TEST_F(TelemetryServerTest, ServesClientsOneAfterAnotherWhateverTheFirstDoes) {
  Serve();
  { TestClient leaves_at_once(server_->port()); }
  {
    TestClient leaves_early(server_->port());
    leaves_early.Greet();
    leaves_early.ReadUntil('#');
  }
  {
    TestClient speaks_otherwise(server_->port());
    speaks_otherwise.Send(std::string("GET / HTTP/1.1\r\n\r\n") + '\0');
    speaks_otherwise.ReadUntil('\0');
    EXPECT_EQ(speaks_otherwise.ReadToEnd(), "");
  }
  {
    TestClient never_ends(server_->port());
    never_ends.Send(std::string(5000, 'x'));
    never_ends.ReadUntil('\0');
    EXPECT_EQ(never_ends.ReadToEnd(), "");
  }
  TestClient last(server_->port());
  last.ReadUntil('\0');
  last.Greet();
  EXPECT_EQ(last.ReadToEnd(), Whole());
}

TEST_F(TelemetryServerTest, LetsInWhoKnowsThePassword) {
  Serve("secret");
  {
    TestClient stranger(server_->port());
    stranger.ReadUntil('\0');
    stranger.Greet("0");
    EXPECT_EQ(stranger.ReadToEnd(), "");
  }
  for (const std::string& hash : TelemetryPasswordHashes("secret")) {
    TestClient friendly(server_->port());
    friendly.ReadUntil('\0');
    friendly.Greet(hash);
    EXPECT_EQ(friendly.ReadToEnd(), Whole());
  }
  Stop();
  EXPECT_THAT(said_, Contains("turned tester away: another password"));
}

TEST_F(TelemetryServerTest, WhatAClientCallsItselfCannotSteerATerminal) {
  Serve();
  {
    TestClient client(server_->port());
    client.Send(std::string(kProtocols) + "\x1b[2Jme\n0" + '\0');
    client.ReadUntil('#');
  }
  TestClient next(server_->port());
  next.ReadUntil('\0');
  Stop();
  EXPECT_THAT(said_, Contains("?[2Jme is watching"));
}

TEST_F(TelemetryServerTest, StopsWhileAClientWatches) {
  recording_.frames.back().time_s = 1000;
  Serve();
  TestClient client(server_->port());
  client.Greet();
  client.ReadUntil('#');
  Stop();
  EXPECT_FALSE(thread_.joinable());
}

TEST_F(TelemetryServerTest, APortThatIsTakenIsAnError) {
  Serve();
  TelemetryOptions options;
  options.port = server_->port();
  const auto make = [&] { TelemetryServer(options, {}, {}); };
  EXPECT_THAT(MessageOf(make), HasSubstr("cannot listen on 127.0.0.1:"));
  options.host = "no.such.host.invalid";
  EXPECT_THAT(MessageOf(make), HasSubstr("cannot listen on no.such.host.invalid:"));
}

TEST(PasswordHash, IsTheChecksumOfUtf16) {
  // Of the bytes 31 00 32 00 33 00, by the parameters of the CRC catalogue.
  EXPECT_EQ(TelemetryPasswordHashes(""), (std::vector<std::string>{"0", "0", "0"}));
  EXPECT_EQ(TelemetryPasswordHashes("123"),
            (std::vector<std::string>{"348a6c25d491b81d", "486143081f059497", "d0ad20b1"}));
  EXPECT_EQ(TelemetryPasswordHashes("\xC3\xA9\xF0\x9F\x99\x82"),
            (std::vector<std::string>{"5e9557e3601b5e21", "227e78ceab8f72ab", "a2767d49"}));
  EXPECT_THAT(MessageOf([] { TelemetryPasswordHashes("\xFF"); }), HasSubstr("UTF-8"));
  EXPECT_THAT(MessageOf([] { TelemetryPasswordHashes("\xC3"); }), HasSubstr("UTF-8"));
}

}  // namespace
}  // namespace skein
