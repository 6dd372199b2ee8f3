// SPDX-License-Identifier: Apache-2.0
#include "tests/src/run_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "src/files/output_file.h"
#include "src/program.h"

namespace skein {
namespace {

constexpr const char* kOutput = "output";
constexpr const char* kError = "error";

void Redirect(int descriptor, const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY);
  if (file < 0 || dup2(file, descriptor) < 0) _exit(125);
}

ProgramWords SkeinWith(const std::vector<std::string>& arguments) {
  ProgramWords program{{SKEIN_PROGRAM}};
  program.words.insert(program.words.end(), arguments.begin(), arguments.end());
  return program;
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& arguments,
                               const std::function<void()>& before)
    : RunningProgram(SkeinWith(arguments), before) {}

RunningProgram::RunningProgram(const ProgramWords& program, const std::function<void()>& before) {
  std::vector<std::string> words = program.words;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  // There from the start, however soon the program is killed.
  for (const char* const stream : {kOutput, kError}) std::ofstream file(scratch_ / stream);
  process_ = fork();
  if (process_ == 0) {
    Redirect(STDOUT_FILENO, scratch_ / kOutput);
    Redirect(STDERR_FILENO, scratch_ / kError);
    if (before) before();
    execvp(argv[0], argv.data());
    _exit(126);
  }
}

RunningProgram::~RunningProgram() {
  if (!ended_) {
    Signal(SIGKILL);
    Reap(true);
  }
}

void RunningProgram::Signal(int signal) const {
  if (!ended_) kill(process_, signal);
}

bool RunningProgram::Reap(bool block) {
  if (!ended_) ended_ = waitpid(process_, &status_, block ? 0 : WNOHANG) == process_;
  return ended_;
}

bool RunningProgram::WaitUntil(const std::function<bool()>& condition) {
  while (!Reap(false)) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

std::string RunningProgram::output() const { return ReadFile(scratch_ / kOutput); }

ProgramResult RunningProgram::Wait() {
  Reap(true);
  ProgramResult result;
  if (WIFEXITED(status_)) result.exit_code = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) result.signal = WTERMSIG(status_);
  result.output = ReadFile(scratch_ / kOutput);
  result.error = ReadFile(scratch_ / kError);
  return result;
}

ProgramResult RunSkein(const std::vector<std::string>& arguments,
                       const std::function<void()>& before) {
  return RunningProgram(arguments, before).Wait();
}

ProgramResult RunWords(const std::vector<std::string>& words) {
  return RunningProgram(ProgramWords{words}).Wait();
}

ProgramResult CallSkein(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"skein"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ProgramResult result;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  result.exit_code = RunProgram(static_cast<int>(words.size()), argv.data());
  result.output = ::testing::internal::GetCapturedStdout();
  result.error = ::testing::internal::GetCapturedStderr();
  return result;
}

}  // namespace skein
