// SPDX-License-Identifier: Apache-2.0
/// \file slcan_host.hpp
/// Real time, and a bus of slcan lines: behind a USB adapter, the socket of an emulator, or a pseudo-terminal. The
/// program has one end, a master or a device; the other nodes are elsewhere.
#pragma once

#include <array>
#include <string>

#include "co_slcan.h"
#include "host/linux_host.hpp"

namespace demo {

class SlcanHost : public LinuxHost {
 public:
  using LinuxHost::LinuxHost;
  ~SlcanHost() override;

  /// \a path: a serial device, or a Unix socket. \a bit_rate: of the bus, bit/s; 0: what the adapter has. Returns why
  /// it cannot be used, in words; empty: it can.
  std::string open(const std::string& path, std::uint32_t bit_rate);

  /// Makes a pseudo-terminal, which path() names, for another program to open as its adapter. What is sent while none
  /// has opened it is dropped. Returns why that fails, in words; empty: it does not.
  std::string open_pseudo_terminal();
  const std::string& path() const { return path_; }

  Can device_can() override { return {&driver, this}; }
  Can master_can() override { return {&driver, this}; }
  void wait(Micros time) override;
  std::string bus_fault() override;
  bool bus_lost() override { return !gone_.empty(); }
  bool interrupted() override { return LinuxHost::interrupted() || bus_lost(); }

 private:
  static const CO_IF_CAN_DRV_EX driver;
  static SlcanHost& at(void* host) { return *static_cast<SlcanHost*>(host); }

  std::vector<pollfd> wake_ups() override;
  void begin();
  bool has_other_end() const;
  void receive();
  void send();
  void lose(const std::string& why);

  std::string path_;
  std::string gone_;  // why the adapter cannot be used any more; empty: it can
  int fd_ = -1;
  bool is_pseudo_terminal_ = false;
  std::array<CO_IF_FRM, 256> frames_{};
  CO_SLCAN can_{};
};

}  // namespace demo
