// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdint>
#include <string>

namespace skein {

/// A client of a ReportServer, as a browser is one.
class ReportClient {
 public:
  /// Connects to `address`, "http://127.0.0.1:PORT/", and says nothing yet.
  explicit ReportClient(const std::string& address)
      : host_(address.substr(7, address.size() - 8)), socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port =
        htons(static_cast<std::uint16_t>(std::stoi(host_.substr(host_.find(':') + 1))));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{kPatience_s, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
  }
  ~ReportClient() { close(socket_); }
  ReportClient(const ReportClient&) = delete;
  ReportClient& operator=(const ReportClient&) = delete;

  /// The whole answer, up to where the server closes; what came of it if none comes for
  /// kPatience_s.
  std::string Get(const std::string& path) {
    const std::string request = "GET " + path + " HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n";
    EXPECT_EQ(send(socket_, request.data(), request.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(request.size()));
    std::string answer;
    char bytes[4096];
    ssize_t count = 0;
    while ((count = recv(socket_, bytes, sizeof bytes, 0)) > 0) {
      answer.append(bytes, static_cast<std::size_t>(count));
    }
    EXPECT_EQ(count, 0) << "the server has not closed the connection";
    return answer;
  }

 private:
  static constexpr int kPatience_s = 5;
  std::string host_;
  int socket_;
};

}  // namespace skein
