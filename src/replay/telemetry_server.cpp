// SPDX-License-Identifier: Apache-2.0
#include "src/replay/telemetry_server.h"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "src/replay/password_hash.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr const char* kStreamProtocol = "XtraLib.Stream.0";
constexpr const char* kTelemetryProtocol = "Tacview.RealTimeTelemetry.0";
constexpr milliseconds kGreetingTime(10'000), kSendTime(30'000);
constexpr milliseconds kSlice(100);  ///< between two looks at whether to stop
constexpr std::size_t kLongestGreeting = 4096;
constexpr int kWaitingClients = 8;

/// Closes what it opened unless it is released.
class Socket {
 public:
  explicit Socket(int value) : value_(value) {}
  Socket(Socket&& other) noexcept : value_(other.Release()) {}
  ~Socket() {
    if (value_ >= 0) close(value_);
  }
  Socket& operator=(Socket&&) = delete;

  int value() const { return value_; }
  int Release() { return std::exchange(value_, -1); }

 private:
  int value_;
};

/// Throws Error with the reason of the system.
int Listen(const addrinfo& address) {
  Socket socket(::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int yes = 1;
  const bool listens =
      socket.value() >= 0 &&
      setsockopt(socket.value(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 &&
      bind(socket.value(), address.ai_addr, address.ai_addrlen) == 0 &&
      listen(socket.value(), kWaitingClients) == 0;
  if (!listens) throw Error(SystemReason());
  return socket.Release();
}

int Listen(const TelemetryOptions& options) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const std::string service = std::to_string(options.port);
  const int failure = getaddrinfo(options.host.c_str(), service.c_str(), &hints, &found);
  const std::string where = fmt::format("cannot listen on {}:{}: ", options.host, options.port);
  if (failure != 0) throw Error(where + gai_strerror(failure));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, freeaddrinfo);
  try {
    return Listen(*addresses);
  } catch (const Error& error) {
    throw Error(where + error.what());
  }
}

int PortOf(int listener) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    throw Error("cannot ask for the port that was chosen: " + SystemReason());
  }
  return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6&>(address).sin6_port
                                             : reinterpret_cast<sockaddr_in&>(address).sin_port);
}

/// What a stranger sent, fit for a terminal.
std::string Printable(std::string text) {
  constexpr std::size_t kLongest = 60;
  text.resize(std::min(text.size(), kLongest));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else if (c != '\r') {
      lines.back() += c;
    }
  }
  return lines;
}

}  // namespace

/// One who connected.
class TelemetryServer::Client {
 public:
  Client(int descriptor, const std::function<bool()>& stopped)
      : socket_(descriptor), stopped_(stopped) {}

  /// All of `text`; false if the client has left, reads too slowly or the server is stopped.
  bool Send(const std::string& text) {
    std::size_t sent = 0;
    const Clock::time_point deadline = Clock::now() + kSendTime;
    while (sent < text.size()) {
      const ssize_t count = send(socket_.value(), text.data() + sent, text.size() - sent,
                                 MSG_DONTWAIT | MSG_NOSIGNAL);
      if (count > 0) {
        sent += static_cast<std::size_t>(count);
        continue;
      }
      const bool is_gone = errno != EAGAIN && errno != EINTR;
      if (is_gone || !Wait(POLLOUT, deadline)) return false;
    }
    return true;
  }

  /// What it sends up to a zero byte; nothing if none comes in time.
  std::optional<std::string> ReceiveGreeting() {
    const Clock::time_point deadline = Clock::now() + kGreetingTime;
    std::string text;
    while (text.size() <= kLongestGreeting && Wait(POLLIN, deadline)) {
      char bytes[512];
      const ssize_t count = recv(socket_.value(), bytes, sizeof bytes, MSG_DONTWAIT);
      if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) break;
      text.append(bytes, static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
      if (const auto end = text.find('\0'); end != std::string::npos) return text.substr(0, end);
    }
    return std::nullopt;
  }

  /// False if it leaves before that.
  bool StayUntil(Clock::time_point time) {
    while (Wait(POLLIN, time)) {
      char ignored[512];
      const ssize_t count = recv(socket_.value(), ignored, sizeof ignored, MSG_DONTWAIT);
      if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) return false;
    }
    return !stopped_();
  }

 private:
  /// Whether the socket is ready before the deadline and before the server is stopped.
  bool Wait(short events, Clock::time_point deadline) const {
    while (!stopped_()) {
      const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
      if (left.count() <= 0) return false;
      pollfd polled{socket_.value(), events, 0};
      const int ready = poll(&polled, 1, static_cast<int>(std::min(left, kSlice).count()));
      if (ready > 0) return true;
      if (ready < 0 && errno != EINTR) return false;
    }
    return false;
  }

  Socket socket_;
  const std::function<bool()>& stopped_;
};

TelemetryServer::TelemetryServer(const TelemetryOptions& options, std::function<bool()> stopped,
                                 std::function<void(const std::string&)> say)
    : stopped_(std::move(stopped)), say_(std::move(say)) {
  if (!options.password.empty()) hashes_ = TelemetryPasswordHashes(options.password);
  listener_ = Listen(options);
  port_ = PortOf(listener_);
}

TelemetryServer::~TelemetryServer() { close(listener_); }

void TelemetryServer::Serve(const AcmiRecording& recording) {
  while (!stopped_()) {
    pollfd polled{listener_, POLLIN, 0};
    if (poll(&polled, 1, static_cast<int>(kSlice.count())) <= 0) continue;
    const int descriptor = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (descriptor < 0) continue;  // it has left already
    Client client(descriptor, stopped_);
    Attend(client, recording);
  }
}

bool TelemetryServer::Admits(const std::vector<std::string>& greeting) const {
  if (hashes_.empty()) return true;
  std::string hash = greeting.size() > 3 ? greeting[3] : "";
  std::transform(hash.begin(), hash.end(), hash.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  });
  return std::find(hashes_.begin(), hashes_.end(), hash) != hashes_.end();
}

void TelemetryServer::Attend(Client& client, const AcmiRecording& recording) {
  const std::string greeting = fmt::format("{}\n{}\nSkein\n", kStreamProtocol, kTelemetryProtocol);
  if (!client.Send(greeting + '\0')) return;
  const std::optional<std::string> answer = client.ReceiveGreeting();
  const std::vector<std::string> lines = LinesOf(answer.value_or(""));
  if (lines.size() < 3 || lines[0] != kStreamProtocol || lines[1] != kTelemetryProtocol) {
    if (!stopped_()) say_("turned a client away that does not speak the protocol");
    return;
  }
  const std::string name = lines[2].empty() ? "a client" : Printable(lines[2]);
  if (!Admits(lines)) {
    say_(fmt::format("turned {} away: another password", name));
    return;
  }
  say_(fmt::format("{} is watching", name));
  const Clock::time_point start = Clock::now();
  bool stays = client.Send(recording.header);
  for (const AcmiFrame& frame : recording.frames) {
    const auto time = std::chrono::duration<double>(frame.time_s);
    stays = stays && client.StayUntil(start + std::chrono::duration_cast<Clock::duration>(time)) &&
            client.Send(frame.text);
    if (!stays) break;
  }
  if (!stopped_()) say_(fmt::format("{} {}", name, stays ? "has seen all" : "has left"));
}

}  // namespace skein
