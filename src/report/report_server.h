// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace skein {

/// Serves a report on 127.0.0.1 alone, read-only: GET / is the page, GET /data what `data` returns,
/// or the message of what it throws (status 503).
/// Every other path is not found, every other method not allowed, and a request for another host
/// (of a page elsewhere whose name resolves to 127.0.0.1) is refused.
class ReportServer {
 public:
  /// Listens on a port that the system chooses. Throws Error if it cannot.
  ReportServer(std::string page, std::function<std::string()> data);
  ~ReportServer();
  ReportServer(const ReportServer&) = delete;
  ReportServer& operator=(const ReportServer&) = delete;

  /// "http://127.0.0.1:PORT/".
  std::string address() const;

  /// Answers, one request after another, until `is_stopping` says so, which is asked several times
  /// a second.
  void Serve(const std::function<bool()>& is_stopping);

  /// The whole answer to a request by its first line and headers.
  std::string Answer(const std::string& head) const;

 private:
  void AnswerNext() const;

  std::string page_;
  std::function<std::string()> data_;
  int socket_ = -1;
  int port_ = 0;
};

}  // namespace skein
