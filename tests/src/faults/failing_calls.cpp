// SPDX-License-Identifier: Apache-2.0
// Loaded before the C library (LD_PRELOAD): counts what a program does to the files below a folder,
// or the objects that it allocates, and lets one of these calls fail. The product needs no seam for
// it, and what libraries write is counted, too. faulted_program.h sets the variables.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

enum class Fault : char {
  kNone = 'n',      // everything is counted, and goes well
  kFails = 'f',     // one call does nothing, and says so
  kFull = 'u',      // from that call on there is no space left; of a write's bytes half get there
  kShort = 's',     // one read or write stops half way, which is no error
  kKilled = 'k',    // the process dies in that call; of a write's bytes half got there
  kMemory = 'm',    // one allocation fails
  kNoMemory = 'o',  // and all after it
};

struct Plan {
  const char* below = nullptr;
  long at = 0;
  Fault fault = Fault::kNone;
  int record = -1;
  std::atomic<long> calls{0};
  std::atomic<bool> in_main{false};
};

Plan plan;

template <typename Function>
Function Next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

const char* Variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Programs that the program starts (compilers) work undisturbed.
__attribute__((constructor)) void Begin() {
  plan.at = std::atol(Variable("SKEIN_FAULT_AT"));
  plan.fault = static_cast<Fault>(*Variable("SKEIN_FAULT"));
  plan.record = static_cast<int>(syscall(SYS_open, Variable("SKEIN_FAULT_RECORD"),
                                         O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  plan.below = std::getenv("SKEIN_FAULT_BELOW");
  unsetenv("LD_PRELOAD");
}

bool IsWatched(const char* path) {
  return plan.below != nullptr && path != nullptr &&
         std::strncmp(path, plan.below, std::strlen(plan.below)) == 0;
}

struct OpenPath {
  char text[PATH_MAX] = "";
  explicit OpenPath(int file) {
    char link[64];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t length = readlink(link, text, sizeof text - 1);
    text[length < 0 ? 0 : length] = '\0';
  }
};

void Record(const char* call, const char* path) {
  char line[PATH_MAX + 32];
  const int length = std::snprintf(line, sizeof line, "%s %s\n", call, path);
  syscall(SYS_write, plan.record, line, static_cast<std::size_t>(length));
}

enum class Verdict { kGoesOn, kFails, kHalf, kDies };

// What happens in a call that `takes_space` or does not.
Verdict Judge(const char* call, const char* path, bool takes_space) {
  if (!IsWatched(path) || plan.fault == Fault::kMemory || plan.fault == Fault::kNoMemory) {
    return Verdict::kGoesOn;
  }
  const long number = ++plan.calls;
  Record(call, path);
  if (plan.at == 0 || number < plan.at) return Verdict::kGoesOn;
  if (plan.fault == Fault::kFull) {
    if (!takes_space) return Verdict::kGoesOn;
    return number == plan.at ? Verdict::kHalf : Verdict::kFails;
  }
  if (number > plan.at) return Verdict::kGoesOn;
  switch (plan.fault) {
    case Fault::kFails:
      return Verdict::kFails;
    case Fault::kShort:
      return Verdict::kHalf;
    case Fault::kKilled:
      return Verdict::kDies;
    default:
      return Verdict::kGoesOn;
  }
}

void Die() { kill(getpid(), SIGKILL); }

// Whether a call that cannot be half done is to fail, with errno set.
bool Denied(const char* call, const char* path, bool takes_space, int reason) {
  const Verdict verdict = Judge(call, path, takes_space);
  if (verdict == Verdict::kDies) Die();
  if (verdict == Verdict::kHalf && plan.fault == Fault::kShort) return false;
  if (verdict == Verdict::kGoesOn) return false;
  errno = plan.fault == Fault::kFull ? ENOSPC : reason;
  return true;
}

bool OpenDenied(const char* path, int flags) {
  return Denied("open", path, (flags & O_CREAT) != 0, EACCES);
}

bool StreamDenied(const char* path, const char* mode) {
  return Denied("open", path, *mode != 'r', EACCES);
}

template <typename Transfer>
ssize_t Transferred(const char* call, int file, std::size_t size, int reason,
                    const Transfer& transfer) {
  switch (Judge(call, OpenPath(file).text, std::strcmp(call, "write") == 0)) {
    case Verdict::kGoesOn:
      break;
    case Verdict::kFails:
      errno = reason;
      return -1;
    case Verdict::kHalf:
      return transfer(size > 1 ? size / 2 : size);
    case Verdict::kDies:
      if (reason == ENOSPC) transfer(size / 2);
      Die();
  }
  return transfer(size);
}

bool MemoryDenied() {
  if (plan.fault != Fault::kMemory && plan.fault != Fault::kNoMemory) return false;
  if (!plan.in_main.load(std::memory_order_relaxed)) return false;
  const long number = ++plan.calls;
  if (plan.at == 0 || number < plan.at) return false;
  return plan.fault == Fault::kNoMemory || number == plan.at;
}

using Main = int (*)(int, char**, char**);
Main program_main;

// Allocations of initialisers before and destructors behind it are not counted: nothing catches.
int WatchedMain(int argc, char** argv, char** environment) {
  plan.in_main = true;
  const int code = program_main(argc, argv, environment);
  plan.in_main = false;
  if (plan.fault == Fault::kMemory) {
    char number[32];
    std::snprintf(number, sizeof number, "%ld", plan.calls.load());
    Record("allocations", number);
  }
  return code;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  static const auto next = Next<int (*)(const char*, int, ...)>("open");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  return OpenDenied(path, flags) ? -1 : next(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  static const auto next = Next<int (*)(const char*, int, ...)>("open64");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  return OpenDenied(path, flags) ? -1 : next(path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  static const auto next = Next<int (*)(int, const char*, int, ...)>("openat");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  return OpenDenied(path, flags) ? -1 : next(folder, path, flags, mode);
}

std::FILE* fopen(const char* path, const char* mode) {
  static const auto next = Next<std::FILE* (*)(const char*, const char*)>("fopen");
  return StreamDenied(path, mode) ? nullptr : next(path, mode);
}

std::FILE* fopen64(const char* path, const char* mode) {
  static const auto next = Next<std::FILE* (*)(const char*, const char*)>("fopen64");
  return StreamDenied(path, mode) ? nullptr : next(path, mode);
}

DIR* opendir(const char* path) {
  static const auto next = Next<DIR* (*)(const char*)>("opendir");
  return Denied("opendir", path, false, EACCES) ? nullptr : next(path);
}

ssize_t read(int file, void* bytes, std::size_t size) {
  static const auto next = Next<ssize_t (*)(int, void*, std::size_t)>("read");
  return Transferred("read", file, size, EIO,
                     [=](std::size_t part) { return next(file, bytes, part); });
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  static const auto next = Next<ssize_t (*)(int, const void*, std::size_t)>("write");
  return Transferred("write", file, size, ENOSPC,
                     [=](std::size_t part) { return next(file, bytes, part); });
}

int fsync(int file) {
  static const auto next = Next<int (*)(int)>("fsync");
  return Denied("fsync", OpenPath(file).text, true, EIO) ? -1 : next(file);
}

int close(int file) {
  static const auto next = Next<int (*)(int)>("close");
  const bool denied = Denied("close", OpenPath(file).text, false, EIO);
  const int reason = errno;
  const int code = next(file);
  if (denied) errno = reason;
  return denied ? -1 : code;
}

int flock(int file, int operation) noexcept {
  static const auto next = Next<int (*)(int, int)>("flock");
  return Denied("flock", OpenPath(file).text, false, ENOLCK) ? -1 : next(file, operation);
}

int rename(const char* from, const char* to) noexcept {
  static const auto next = Next<int (*)(const char*, const char*)>("rename");
  return Denied("rename", to, false, EACCES) ? -1 : next(from, to);
}

int mkdir(const char* path, mode_t mode) noexcept {
  static const auto next = Next<int (*)(const char*, mode_t)>("mkdir");
  return Denied("mkdir", path, true, EACCES) ? -1 : next(path, mode);
}

char* mkdtemp(char* path) noexcept {
  static const auto next = Next<char* (*)(char*)>("mkdtemp");
  return Denied("mkdtemp", path, true, EACCES) ? nullptr : next(path);
}

int unlink(const char* path) noexcept {
  static const auto next = Next<int (*)(const char*)>("unlink");
  return Denied("unlink", path, false, EACCES) ? -1 : next(path);
}

int remove(const char* path) noexcept {
  static const auto next = Next<int (*)(const char*)>("remove");
  return Denied("remove", path, false, EACCES) ? -1 : next(path);
}

int __libc_start_main(Main main, int argc, char** argv, void (*begin)(), void (*end)(),
                      void (*unload)(), void* stack) {
  static const auto next =
      Next<int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*)>(
          "__libc_start_main");
  program_main = main;
  return next(WatchedMain, argc, argv, begin, end, unload, stack);
}

}  // extern "C"

// The other forms of new without an alignment call this one.
void* operator new(std::size_t size) {
  void* const memory = MemoryDenied() ? nullptr : std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto bytes = static_cast<std::size_t>(alignment);
  void* const memory =
      MemoryDenied() ? nullptr : std::aligned_alloc(bytes, (size + bytes - 1) / bytes * bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
