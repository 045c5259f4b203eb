// SPDX-License-Identifier: Apache-2.0
// driver_check_socketcan INTERFACE peer|feed: runs the driver check for SocketCAN on an otherwise unused interface,
// with a second socket or the script feed as peer. Status 0: every check was run, and none has failed.
#include <unistd.h>

#include <cstdio>
#include <cstring>

#include "co_driver_check.h"
#include "socketcan.hpp"

namespace {

constexpr std::uint16_t all_checks = 16;
constexpr useconds_t turn = 1000;  // us

void print(void* /*user*/, const char* line) { std::puts(line); }
void idle(void* /*user*/) { ::usleep(turn); }

// Opens the interface to check that it exists, and closes it: the driver check opens it by Enable.
bool prepare(co::SocketCan& can, const char* interface) {
  const bool opened = can.open(interface);
  can.close();
  return opened;
}

}  // namespace

int main(int argc, char** argv) {
  co::SocketCan own;
  co::SocketCan other;
  if (argc != 3 || !prepare(own, argv[1]) || !prepare(other, argv[1])) {
    std::fprintf(stderr, "driver_check_socketcan INTERFACE peer|feed %s\n", own.error().c_str());
    return 2;
  }
  CO_NODE_EXT ext = {};
  ext.Can = &co::SocketCanDriver;
  ext.CanCtx = &own;
  CO_NODE_EXT peer = ext;
  peer.CanCtx = &other;
  CO_DRIVER_CHECK check = {};
  check.Ext = &ext;
  check.Print = print;
  check.Idle = idle;
  check.Bus = std::strcmp(argv[2], "feed") == 0 ? CO_CHECK_FEED : CO_CHECK_PEER;
  check.Peer = &peer;
  check.Frames = CO_CHECK_29_BIT | CO_CHECK_REMOTE;
  check.Burst = 8;
  check.Patience = 10000;
  check.Quiet = 500;
  CODriverCheckCan(&check);
  return check.Failed == 0 && check.Passed == all_checks ? 0 : 1;
}
