// SPDX-License-Identifier: Apache-2.0
#include "linux_node/linux_host.hpp"

namespace demo {
namespace {

volatile sig_atomic_t interrupted = 0;

void note_signal(int) { interrupted = 1; }

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  interrupted = 0;
  sigprocmask(SIG_BLOCK, &signals, &before_);
  handle(SIGINT, note_signal);
  handle(SIGTERM, note_signal);
}

Interruption::~Interruption() {
  handle(SIGINT, SIG_DFL);
  handle(SIGTERM, SIG_DFL);
  sigprocmask(SIG_SETMASK, &before_, nullptr);
}

bool Interruption::happened() { return interrupted != 0; }

void LinuxHost::wait(Micros time) {
  std::vector<pollfd> ends = wake_ups();
  timespec timeout{};
  timeout.tv_sec = static_cast<time_t>(time / second);
  timeout.tv_nsec = static_cast<long>(time % second * 1000);
  ppoll(ends.data(), ends.size(), &timeout, &interruption_.while_waiting());
}

std::string SocketCanHost::open(const std::string& interface, bool with_master) {
  if (!device_.open(interface)) {
    return device_.error();
  }
  if (!device_.up()) {
    return "CAN interface '" + interface + "' is down; as root: ip link set " + interface + " up";
  }
  return (with_master && !master_.open(interface)) ? master_.error() : std::string();
}

std::vector<pollfd> SocketCanHost::wake_ups() {
  return {{device_.fd(), POLLIN, 0}, {master_.fd(), POLLIN, 0}};  // poll() passes over -1
}

}  // namespace demo
