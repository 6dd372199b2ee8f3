// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <future>
#include <limits>
#include <new>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/worker_pool.h"
#include "src/config/configuration.h"
#include "src/files/output_file.h"
#include "src/report/data_pack.h"
#include "src/report/live_report.h"
#include "src/report/report_page.h"
#include "src/report/report_server.h"
#include "tests/scratch_directory.h"
#include "tests/src/report/report_client.h"

namespace skein {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(DataPackTest, Base64IsThatOfTheStandard) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(DataPackTest, ReferencesSayWhereArraysLie) {
  DataPack pack;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(pack.AddNumbers({1, 2, 3}).dump(), R"({"f32":[0,3]})");
  const auto quantised = pack.AddQuantised({0, nan, 65000});
  EXPECT_EQ(quantised["i16"].dump(), "[16,3]");
  EXPECT_EQ(quantised["first"], 0.0);
  EXPECT_EQ(quantised["unit"], 1.0);
  EXPECT_EQ(pack.AddQuantised({}).dump(), R"({"i16":[24,0],"first":0.0,"unit":1.0})");
}

TEST(DataPackTest, FewerLevelsAreALargerUnit) {
  DataPack pack;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(pack.AddQuantised({0, 100}, 1000)["unit"], 0.1);
  const auto late = pack.AddQuantised({nan, nan, 300, 365});
  EXPECT_EQ(late["first"], 300.0);
  EXPECT_EQ(late["unit"], 0.001);
}

/// The bytes of a pack's arrays, less than 1 KiB.
std::string ArraysOf(const DataPack& pack) {
  const std::string deflated = pack.Deflated({});
  std::string bytes(1024, '\0');
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                       reinterpret_cast<const Bytef*>(deflated.data()), deflated.size()),
            Z_OK);
  bytes.resize(size);
  // After the length of the document, which is shorter than 256 bytes.
  return bytes.substr(4u + static_cast<unsigned char>(bytes.at(0)));
}

TEST(DataPackTest, CountsThatNoFloatIsStayExact) {
  const std::vector<double> counts = {1, 16777217, 9007199254740991};
  DataPack pack;
  EXPECT_EQ(pack.AddNumbers(counts).dump(), R"({"f64":[0,3]})");
  const std::string bytes = ArraysOf(pack);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    std::uint64_t bits = 0;
    for (std::size_t k = 8; k-- > 0;) {
      bits = bits << 8 | static_cast<unsigned char>(bytes.at(8 * i + k));
    }
    double value = 0;
    std::memcpy(&value, &bits, sizeof(value));
    EXPECT_EQ(value, counts[i]);
  }
}

TEST(DataPackTest, WhatIsMeasuredIsKeptAsFloats) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  DataPack pack;
  EXPECT_EQ(pack.AddNumbers({0.1, 16777216, kNan, kInfinity}).dump(), R"({"f32":[0,4]})");
}

/// The levels of the values, the first that a pack is given.
std::vector<int> LevelsOf(const std::vector<double>& values) {
  DataPack pack;
  pack.AddQuantised(values);
  const std::string bytes = ArraysOf(pack);
  const auto at = [&bytes](std::size_t i) { return static_cast<unsigned char>(bytes.at(i)); };
  std::vector<int> levels;
  int level = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    level = (level + at(2 * i) + 256 * at(2 * i + 1)) % 65536;
    levels.push_back(level);
  }
  return levels;
}

TEST(DataPackTest, WhatIsNoNumberHasALevelOfItsOwn) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr int kMost = DataPack::kMostLevels, kNone = DataPack::kNoLevel;
  EXPECT_THAT(LevelsOf({kNan, 1, kInfinity, 3, 2}), ElementsAre(kNone, 0, kNone, kMost, kMost / 2));
  EXPECT_THAT(LevelsOf({kNan, kNan}), ElementsAre(kNone, kNone));
  EXPECT_THAT(LevelsOf({7, 7}), ElementsAre(0, 0));
}

TEST(DataPackTest, TextThatIsNotUtf8DoesNotStopAReport) {
  EXPECT_FALSE(DataPack().Deflated({{"name", "\xff"}}).empty());
}

TEST(ReportPageTest, DataBringNothingIntoThePageButBase64) {
  const std::string hostile = "</script><script>alert(1)</script>";
  const std::string page = ReportPage("<script>SKEIN-REPORT-DATA</script>", hostile);
  EXPECT_EQ(page, "<script>" + Base64(hostile) + "</script>");
  EXPECT_THAT(page, Not(HasSubstr("alert")));
  EXPECT_THROW(ReportPage("a page of another version", ""), Error);
  EXPECT_THROW(ReportPage("SKEIN-REPORT-DATA SKEIN-REPORT-DATA", ""), Error);
}

/// A run of a shipped policy whose training goes on, reported on by one flight.
class LiveReportTest : public ::testing::Test {
 protected:
  LiveReportTest() {
    std::filesystem::create_directories(run_ + "/checkpoints");
    WriteFile(run_ + "/config.toml", DumpToml(ResolveConfig({"heading", "default", "", {}})));
    WriteFile(run_ + "/metrics.csv", metrics_);
    std::filesystem::copy_file(std::string(SKEIN_SOURCE) + "/policies/heading.skein", policy_);
    request_.runs = {run_};
    request_.episodes = 0;
    request_.flights = 1;
    request_.made = "once";
  }

  /// Whether the data are about as long as `whole`: flights are most of them.
  static bool HasFlights(const std::string& data, const std::string& whole) {
    return data.size() > whole.size() / 2;
  }

  const ScratchDirectory scratch_;
  const std::string run_ = scratch_ / "run", policy_ = run_ + "/checkpoints/policy-best.skein";
  const std::string metrics_ = "iteration,env_steps\n1,100\n";
  ReportRequest request_;
  WorkerPool pool_{1};
};

TEST_F(LiveReportTest, FliesAgainWhenThePolicyIsAnotherAndNotWhenTheMetricsHaveGrown) {
  LiveReport report(request_, pool_);
  const std::string first = report.Data();
  // Who would fly it again would find no policy.
  const auto written = std::filesystem::last_write_time(policy_);
  WriteFile(policy_, std::string(std::filesystem::file_size(policy_), 'x'));
  std::filesystem::last_write_time(policy_, written);
  EXPECT_EQ(report.Data(), first);
  WriteFile(run_ + "/metrics.csv", metrics_ + "2,200\n");
  const std::string second = report.Data();
  EXPECT_NE(second, first);
  EXPECT_TRUE(HasFlights(second, first));
  std::filesystem::last_write_time(policy_, written + std::chrono::seconds(1));
  EXPECT_FALSE(HasFlights(report.Data(), first));
}

TEST_F(LiveReportTest, FliesAgainWhenTheConfigurationOrTheEvaluationIsAnother) {
  const std::string policy = ReadFile(policy_), broken(policy.size(), 'x');
  const std::string evaluation = "{\"seed\": 7}";
  const std::string config = DumpToml(ResolveConfig({"heading", "default", "", {"run.seed=7"}}));
  const auto written = std::filesystem::last_write_time(policy_);
  for (const auto& [file, text] :
       {std::pair{"/config.toml", config}, {"/evaluation.json", evaluation}}) {
    WriteFile(policy_, policy);
    std::filesystem::last_write_time(policy_, written);
    LiveReport report(request_, pool_);
    const std::string first = report.Data();
    // Who flies again finds no policy.
    WriteFile(policy_, broken);
    std::filesystem::last_write_time(policy_, written);
    ASSERT_EQ(report.Data(), first) << file;
    WriteFile(run_ + file, text);
    EXPECT_FALSE(HasFlights(report.Data(), first)) << file;
  }
}

class ReportServerTest : public ::testing::Test {
 protected:
  std::string Host() const {
    const std::string address = server_.address();
    return address.substr(7, address.size() - 8);
  }
  std::string Ask(const std::string& line, const std::string& host) const {
    return server_.Answer(line + " HTTP/1.1\r\nAccept: */*\r\nHOST: " + host + "\r\n\r\n");
  }

  ReportServer server_{"<page>", [] { return "data"; }};
};

TEST_F(ReportServerTest, ServesThePageAndItsData) {
  EXPECT_THAT(server_.address(), StartsWith("http://127.0.0.1:"));
  EXPECT_THAT(Ask("GET /", Host()), StartsWith("HTTP/1.1 200 OK"));
  EXPECT_THAT(Ask("GET /", Host()), HasSubstr("\r\n\r\n<page>"));
  EXPECT_THAT(Ask("GET /data", Host()), HasSubstr("\r\n\r\ndata"));
}

TEST_F(ReportServerTest, ServesOverSocketsBesideAClientThatSaysNothingUntilItIsStopped) {
  constexpr std::chrono::seconds kAtMost{3};
  std::atomic<bool> stopping{false};
  const std::future<void> serving = std::async(
      std::launch::async, [&] { server_.Serve([&stopping] { return stopping.load(); }); });
  // Declared after the future, which waits for Serve: what it has got stuck on goes first.
  const ReportClient silent(server_.address());
  EXPECT_THAT(ReportClient(server_.address()).Get("/data"),
              AllOf(StartsWith("HTTP/1.1 200 OK"), EndsWith("\r\n\r\ndata")));
  EXPECT_THAT(ReportClient(server_.address()).Get("/"), EndsWith("\r\n\r\n<page>"));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // by now it waits for a client
  stopping = true;
  EXPECT_EQ(serving.wait_for(kAtMost), std::future_status::ready);
}

TEST_F(ReportServerTest, RefusesOtherHostsMethodsAndPaths) {
  EXPECT_THAT(Ask("GET /", "example.org"), StartsWith("HTTP/1.1 421"));
  EXPECT_THAT(Ask("GET /", "127.0.0.1:1"), StartsWith("HTTP/1.1 421"));
  EXPECT_THAT(server_.Answer("GET / HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 421"));
  EXPECT_THAT(server_.Answer("nonsense"), StartsWith("HTTP/1.1 421"));
  EXPECT_THAT(Ask("POST /", Host()), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(Ask("GET /../etc/passwd", Host()), StartsWith("HTTP/1.1 404"));
}

TEST_F(ReportServerTest, SaysWhyThereAreNoData) {
  const ReportServer server("", []() -> std::string { throw Error("runs/a: gone"); });
  const std::string address = server.address();
  const std::string answer = server.Answer(
      "GET /data HTTP/1.1\r\nHost: " + address.substr(7, address.size() - 8) + "\r\n\r\n");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 503"));
  EXPECT_THAT(answer, HasSubstr("runs/a: gone"));
}

TEST_F(ReportServerTest, OutlivesWhatTheSystemThrows) {
  const auto answer = [](const std::function<std::string()>& data) {
    const ReportServer server("", data);
    const std::string address = server.address();
    return server.Answer("GET /data HTTP/1.1\r\nHost: " + address.substr(7, address.size() - 8) +
                         "\r\n\r\n");
  };
  EXPECT_THAT(answer([]() -> std::string { throw std::bad_alloc(); }), StartsWith("HTTP/1.1 503"));
  EXPECT_THAT(answer([]() -> std::string {
                throw std::filesystem::filesystem_error("gone", std::error_code());
              }),
              StartsWith("HTTP/1.1 503"));
}

}  // namespace
}  // namespace skein
