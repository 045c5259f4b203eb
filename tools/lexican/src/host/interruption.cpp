// SPDX-License-Identifier: Apache-2.0
#include "host/interruption.hpp"

namespace lexican {
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
  sigprocmask(SIG_SETMASK, &before_, nullptr);
  handle(SIGINT, happened() ? SIG_IGN : SIG_DFL);
  handle(SIGTERM, happened() ? SIG_IGN : SIG_DFL);
}

bool Interruption::happened() {
  sigset_t pending;
  sigpending(&pending);  // a wait that does not have to wait does not deliver them
  interrupted = interrupted != 0 || sigismember(&pending, SIGINT) == 1 || sigismember(&pending, SIGTERM) == 1 ? 1 : 0;
  return interrupted != 0;
}

}  // namespace lexican
