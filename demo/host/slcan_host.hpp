// SPDX-License-Identifier: Apache-2.0
/// \file slcan_host.hpp
/// Host for one node, a master or a device, in real time. Its bus is an slcan connection: a USB adapter, the socket of
/// an emulator, or a pseudo-terminal.
#pragma once

#include <array>
#include <string>

#include "co_slcan.h"
#include "host/linux_host.hpp"

namespace lexican::demo {

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
  bool bus_lost() override { return !fault_.empty(); }
  bool interrupted() override { return LinuxHost::interrupted() || bus_lost(); }

 private:
  static const CO_IF_CAN_DRV_EX driver;
  static SlcanHost& at(void* host) { return *static_cast<SlcanHost*>(host); }

  std::vector<pollfd> poll_descriptors() override;
  void start_controller();
  bool has_other_end() const;
  void receive();
  void send();
  void close_with_fault(const std::string& why);

  std::string path_;
  std::string fault_;  // reason why the adapter is lost; empty: it is not
  int fd_ = -1;
  bool is_pseudo_terminal_ = false;
  std::array<CO_IF_FRM, 256> frames_{};
  CO_SLCAN can_{};
};

}  // namespace lexican::demo
