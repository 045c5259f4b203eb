// SPDX-License-Identifier: Apache-2.0
/// \file slcan_host.hpp
/// Real time, and a bus over slcan: by a USB adapter, the socket of an emulator, or a pseudo-terminal. The program has
/// one end, a master or a device.
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

  /// Opens an adapter. \a path: a serial device, or a Unix socket. \a bit_rate: bit/s; 0: keeps that of the adapter.
  /// Returns why it cannot be used; empty: success.
  std::string open(const std::string& path, std::uint32_t bit_rate);

  /// Creates a pseudo-terminal at path(), which another program can open as its adapter. Text sent while it is not open
  /// is discarded. Returns why it fails; empty: success.
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
  std::string gone_;  // reason why the adapter is lost; empty: it is not
  int fd_ = -1;
  bool is_pseudo_terminal_ = false;
  std::array<CO_IF_FRM, 256> frames_{};
  CO_SLCAN can_{};
};

}  // namespace demo
