// SPDX-License-Identifier: Apache-2.0
#include "train/mpi/mpi_ranks.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>

#include "base/error.h"
#include "train/mpi/mpi_watch.h"

namespace skein {
namespace {

/// OpenMPI asks before it sends more than 64 kB over TCP, and waits for the answer: a message takes
/// three latencies. Up to so many bytes it does not.
constexpr const char* kEagerLimit = "OMPI_MCA_btl_tcp_eager_limit";
constexpr const char* kEagerBytes = "1048576";
constexpr int kDataTag = 1, kWaitingTag = 2, kNoticeTag = 3;
/// A waiting rank asks without pause at first, then leaves its processor to others; beside a thread
/// that computes, at once.
constexpr std::chrono::microseconds kEager{200}, kPause{20};
/// Between two looks at the end for the last to come.
constexpr std::chrono::milliseconds kPauseAtEnd{1};
/// A rank that waits so long tells the others, and from then on so many times until it gives up.
constexpr std::chrono::seconds kFirstTelling{1};
constexpr int kTellings = 10;
/// Who has told in so many of these intervals waits still; one may be late.
constexpr int kFresh = 3;
/// The first of the ranks that wait says who hangs; the others only if it does not.
constexpr std::chrono::seconds kGrace{5};
constexpr std::chrono::duration<double> kForever{std::numeric_limits<double>::infinity()};

}  // namespace

MpiRanks::MpiRanks(double timeout_s, std::size_t most_bytes)
    : timeout_(timeout_s), telling_interval_(timeout_s / kTellings), most_bytes_(most_bytes) {
  setenv(kEagerLimit, kEagerBytes, /*overwrite=*/0);  // ahead of the watch's thread
  const MpiWatch watch("start", timeout_);
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  if (provided < MPI_THREAD_SERIALIZED) {
    MPI_Finalize();
    throw Error("this MPI serves one thread of a process alone (thread level " +
                std::to_string(provided) +
                "), but gradients are exchanged while others are computed: install one that has "
                "MPI_THREAD_SERIALIZED");
  }
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  std::vector<char> names(static_cast<std::size_t>(count_) * MPI_MAX_PROCESSOR_NAME, '\0');
  char own[MPI_MAX_PROCESSOR_NAME] = {};
  int length = 0;
  MPI_Get_processor_name(own, &length);
  MPI_Allgather(own, MPI_MAX_PROCESSOR_NAME, MPI_CHAR, names.data(), MPI_MAX_PROCESSOR_NAME,
                MPI_CHAR, MPI_COMM_WORLD);
  heard_.resize(static_cast<std::size_t>(count_));
  for (int rank = 0; rank < count_; ++rank) {
    hosts_.emplace_back(names.data() + static_cast<std::size_t>(rank) * MPI_MAX_PROCESSOR_NAME);
  }
  name_ = Describe(rank_);
}

MpiRanks::~MpiRanks() {
  const MpiWatch watch("end", kForever);  // what rank 0 writes alone may take its time
  for (Sent& sent : sent_) MPI_Wait(&sent.request, MPI_STATUS_IGNORE);
  EndsWithin(kForever.count());  // MPI_Finalize would use a whole processor until the last has come
  MPI_Finalize();
}

std::string MpiRanks::Describe(int rank) const {
  return "rank " + std::to_string(rank) + " (" + hosts_[static_cast<std::size_t>(rank)] + ")";
}

void MpiRanks::ExchangeAll(int partner, const std::vector<Transfer>& transfers) {
  std::vector<MPI_Request> requests;
  requests.reserve(2 * transfers.size());
  for (const Transfer& transfer : transfers) {
    for (std::size_t begin = 0; begin < transfer.receive_bytes; begin += most_bytes_) {
      const auto bytes = static_cast<int>(std::min(most_bytes_, transfer.receive_bytes - begin));
      MPI_Irecv(static_cast<char*>(transfer.receive) + begin, bytes, MPI_BYTE, partner, kDataTag,
                MPI_COMM_WORLD, &requests.emplace_back());
    }
  }
  for (const Transfer& transfer : transfers) {
    for (std::size_t begin = 0; begin < transfer.send_bytes; begin += most_bytes_) {
      const auto bytes = static_cast<int>(std::min(most_bytes_, transfer.send_bytes - begin));
      MPI_Isend(static_cast<const char*>(transfer.send) + begin, bytes, MPI_BYTE, partner, kDataTag,
                MPI_COMM_WORLD, &requests.emplace_back());
    }
  }
  Wait(requests);
}

void MpiRanks::Notify(int rank, std::int64_t word) {
  sent_.remove_if([](Sent& sent) {
    int done = 0;
    MPI_Test(&sent.request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  });
  Sent& sent = sent_.emplace_back(Sent{word, MPI_REQUEST_NULL});
  MPI_Isend(&sent.word, 1, MPI_INT64_T, rank, kNoticeTag, MPI_COMM_WORLD, &sent.request);
}

std::optional<Notice> MpiRanks::TakeNotice() {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, kNoticeTag, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return std::nullopt;
  Notice notice{status.MPI_SOURCE, 0};
  MPI_Recv(&notice.word, 1, MPI_INT64_T, notice.sender, kNoticeTag, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return notice;
}

void MpiRanks::Wait(std::vector<MPI_Request>& requests) {
  Clock::time_point start = Clock::now(), looked = start;
  const bool computes = std::this_thread::get_id() == computing_;
  const Clock::duration eager = computes ? kEager : Clock::duration::zero();
  bool is_patient = false;
  const std::chrono::duration<double> first_telling =
      std::min<std::chrono::duration<double>>(kFirstTelling, telling_interval_);
  std::chrono::duration<double> next_telling = first_telling;
  for (;;) {
    int done = 0;
    MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
    if (done != 0) return;
    const Clock::time_point now = Clock::now();
    if (now - looked > kStandstill) {
      start = now;
      next_telling = first_telling;
    }
    looked = now;
    const Clock::duration waited = now - start;
    if (waited < eager) continue;
    if (!is_patient) {
      HearOthers();  // so that what is told does not heap up
      is_patient = true;
    }
    std::this_thread::sleep_for(kPause);
    if (waited > next_telling) {
      TellOthers();
      HearOthers();
      next_telling = waited + telling_interval_;
    }
    if (waited > timeout_) GiveUp(waited);
  }
}

void MpiRanks::TellOthers() {
  for (int rank = 0; rank < count_; ++rank) {
    if (rank == rank_) continue;
    MPI_Request request;
    // An empty message is sent at once, whether or not it is ever received.
    MPI_Isend(nullptr, 0, MPI_BYTE, rank, kWaitingTag, MPI_COMM_WORLD, &request);
    MPI_Request_free(&request);
  }
}

void MpiRanks::HearOthers() {
  for (;;) {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kWaitingTag, MPI_COMM_WORLD, &there, &status);
    if (there == 0) return;
    MPI_Recv(nullptr, 0, MPI_BYTE, status.MPI_SOURCE, kWaitingTag, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    heard_[static_cast<std::size_t>(status.MPI_SOURCE)] = Clock::now();
  }
}

bool MpiRanks::Waits(int rank) const {
  return rank == rank_ ||
         Clock::now() - heard_[static_cast<std::size_t>(rank)] < kFresh * telling_interval_;
}

void MpiRanks::GiveUp(std::chrono::duration<double> waited) {
  HearOthers();
  std::string hanging;
  for (int rank = 0; rank < count_; ++rank) {
    if (Waits(rank)) {
      if (rank < rank_ && waited < timeout_ + kGrace) return;
      continue;
    }
    hanging += (hanging.empty() ? "" : " or ") + Describe(rank);
  }
  char limit[32];
  std::snprintf(limit, sizeof limit, "%g", timeout_.count());
  const std::string reason =
      (hanging.empty() ? "some rank" : hanging) + " has not answered for " + limit +
      " s (--rank-timeout); all ranks end, and --resume goes on from the last checkpoint";
  Abort(reason.c_str());
}

bool MpiRanks::EndsWithin(double seconds) {
  const Clock::time_point start = Clock::now();
  if (!all_end_) MPI_Ibarrier(MPI_COMM_WORLD, &all_end_.emplace());
  for (;;) {
    int done = 0;
    MPI_Test(&*all_end_, &done, MPI_STATUS_IGNORE);
    if (done != 0) return true;
    if (Clock::now() - start > std::chrono::duration<double>(seconds)) return false;
    std::this_thread::sleep_for(kPauseAtEnd);
  }
}

void MpiRanks::Abort(const char* reason) {
  std::fflush(stdout);
  std::fprintf(stderr, "skein: error: %s: %s\n", name_.c_str(), reason);
  std::fflush(stderr);
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();  // not reached: MPI_Abort is only not declared so
}

}  // namespace skein
