// SPDX-License-Identifier: Apache-2.0
/// \file process.hpp
/// Runs a program with pipes to its standard output and standard error output.
#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace test {

struct Ran {
  int status = -1;  ///< exit status, 128 and the number of the signal, or -1
  std::string out;
  std::string err;
};

/// A child that ends with the test. Waits at most a minute for each output. \a input, \a error: descriptors of its
/// standard input and standard error output; -1: none, and a pipe.
class Process {
 public:
  using Environment = std::map<std::string, std::string>;  // an empty text removes the variable

  Process(const std::vector<std::string>& words, const Environment& environment, int input = -1, int error = -1) {
    std::array<int, 2> out{};
    std::array<int, 2> err{};
    std::array<int, 2> start{};  // closed when the program starts, which resets the handlers of signals
    REQUIRE(pipe2(start.data(), O_CLOEXEC) == 0);
    REQUIRE(pipe2(out.data(), O_CLOEXEC) == 0);
    REQUIRE(pipe2(err.data(), O_CLOEXEC) == 0);
    pid_ = fork();
    REQUIRE(pid_ >= 0);
    if (pid_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      run(words, environment, input, out[1], error >= 0 ? error : err[1]);
    }
    close(out[1]);
    close(err[1]);
    close(start[1]);
    char none = 0;
    CHECK(read(start[0], &none, 1) == 0);
    close(start[0]);
    pipes_ = {out[0], err[0]};
  }
  ~Process() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    for (const int pipe : pipes_) {
      if (pipe >= 0) {
        close(pipe);
      }
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits for a text on the standard output.
  void wait_for(const std::string& text) {
    while (texts_[0].find(text) == std::string::npos) {
      const bool is_open = read_some();
      REQUIRE_MESSAGE(is_open, "the program ended without '" << text << "': " << texts_[0] << texts_[1]);
    }
  }
  /// Returns the standard output so far.
  const std::string& out() const { return texts_[0]; }
  void send(int signal) const { kill(pid_, signal); }
  /// Waits for the end of the program.
  Ran finish() {
    while (read_some()) {
    }
    int status = 0;
    waitpid(std::exchange(pid_, -1), &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : WIFSIGNALED(status) ? 128 + WTERMSIG(status) : -1;
    return {code, texts_[0], texts_[1]};
  }

 private:
  [[noreturn]] static void run(const std::vector<std::string>& words, const Environment& environment, int input,
                               int out, int err) {
    const int null = open("/dev/null", O_RDWR);
    dup2(input >= 0 ? input : null, 0);
    dup2(out, 1);
    dup2(err, 2);
    for (const auto& [name, value] : environment) {
      value.empty() ? unsetenv(name.c_str()) : setenv(name.c_str(), value.c_str(), 1);
    }
    std::vector<char*> arguments;
    for (const std::string& word : words) {
      arguments.push_back(const_cast<char*>(word.c_str()));
    }
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }

  /// Reads from both pipes.
  /// \retval false  both have ended
  bool read_some() {
    std::array<pollfd, 2> wanted{{{pipes_[0], POLLIN, 0}, {pipes_[1], POLLIN, 0}}};
    if (pipes_[0] < 0 && pipes_[1] < 0) {
      return false;
    }
    constexpr int minute = 60'000;
    const int ready = poll(wanted.data(), wanted.size(), minute);
    REQUIRE_MESSAGE(ready > 0, "no output for a minute: " << texts_[0] << texts_[1]);
    for (std::size_t n = 0; n < wanted.size(); ++n) {
      std::array<char, 65536> buffer;
      const ssize_t size = wanted[n].revents != 0 ? read(pipes_[n], buffer.data(), buffer.size()) : -1;
      if (size > 0) {
        texts_[n].append(buffer.data(), static_cast<std::size_t>(size));
      } else if (wanted[n].revents != 0) {
        close(std::exchange(pipes_[n], -1));
      }
    }
    return true;
  }

  pid_t pid_ = -1;
  std::array<int, 2> pipes_{-1, -1};
  std::array<std::string, 2> texts_;
};

}  // namespace test
