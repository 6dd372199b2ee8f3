// SPDX-License-Identifier: Apache-2.0
#include "src/report/report_server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

constexpr int kWaitMs = 200;
constexpr int kPatience_s = 2;  // with a client that says nothing, or takes nothing
constexpr std::size_t kLongestHead = 16384;

std::string Response(const char* status, const char* type, const std::string& body) {
  return fmt::format(
             "HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n"
             "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
             "X-Frame-Options: DENY\r\nCross-Origin-Resource-Policy: same-origin\r\n"
             "Referrer-Policy: no-referrer\r\n\r\n",
             status, type, body.size()) +
         body;
}

std::string Refusal(const char* status) {
  return Response(status, "text/plain; charset=utf-8", std::string(status) + "\n");
}

/// The value of the header `name` (in lower case); empty if there is none.
std::string HeaderOf(const std::string& head, const std::string& name) {
  std::istringstream lines(head);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    if (colon != name.size()) continue;
    std::string key = line.substr(0, colon);
    std::transform(key.begin(), key.end(), key.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (key != name) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    const std::size_t end = line.find_last_not_of(" \t\r");
    return begin == std::string::npos ? "" : line.substr(begin, end - begin + 1);
  }
  return "";
}

/// The request's first line and headers, or what of them came.
std::string ReadHead(int connection) {
  std::string head;
  std::array<char, 2048> bytes{};
  while (head.find("\r\n\r\n") == std::string::npos && head.size() < kLongestHead) {
    const ssize_t count = recv(connection, bytes.data(), bytes.size(), 0);
    if (count <= 0) break;
    head.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return head;
}

/// A client that goes away meanwhile is no error.
void Send(int connection, const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = send(connection, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}

}  // namespace

ReportServer::ReportServer(std::string page, std::function<std::string()> data)
    : page_(std::move(page)),
      data_(std::move(data)),
      socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(place);
  auto* const address = reinterpret_cast<sockaddr*>(&place);
  constexpr int kBacklog = 16;
  if (socket_ < 0 || bind(socket_, address, size) != 0 || listen(socket_, kBacklog) != 0 ||
      getsockname(socket_, address, &size) != 0) {
    const std::string reason = SystemReason();
    if (socket_ >= 0) close(socket_);
    throw Error("127.0.0.1: no port to serve the report on: " + reason);
  }
  port_ = ntohs(place.sin_port);
}

ReportServer::~ReportServer() { close(socket_); }

std::string ReportServer::address() const { return fmt::format("http://127.0.0.1:{}/", port_); }

void ReportServer::Serve(const std::function<bool()>& is_stopping) {
  while (!is_stopping()) {
    pollfd waiting{socket_, POLLIN, 0};
    if (poll(&waiting, 1, kWaitMs) > 0) AnswerNext();
  }
}

void ReportServer::AnswerNext() const {
  const int connection = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
  if (connection < 0) return;
  const timeval patience{kPatience_s, 0};
  setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  setsockopt(connection, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof(patience));
  if (const std::string head = ReadHead(connection); !head.empty()) Send(connection, Answer(head));
  close(connection);
}

std::string ReportServer::Answer(const std::string& head) const {
  std::string method, path;
  std::istringstream(head) >> method >> path;
  const std::string host = HeaderOf(head, "host");
  if (host != fmt::format("127.0.0.1:{}", port_) && host != fmt::format("localhost:{}", port_)) {
    return Refusal("421 Misdirected Request");
  }
  if (method != "GET") return Refusal("405 Method Not Allowed");
  if (path == "/") return Response("200 OK", "text/html; charset=utf-8", page_);
  if (path != "/data") return Refusal("404 Not Found");
  try {
    return Response("200 OK", "application/octet-stream", data_());
  } catch (const std::exception& error) {
    return Response("503 Service Unavailable", "text/plain; charset=utf-8", error.what());
  }
}

}  // namespace skein
