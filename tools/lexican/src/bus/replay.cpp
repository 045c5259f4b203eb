// SPDX-License-Identifier: Apache-2.0
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>

#include "bus/open.hpp"

namespace lexican::host_bus {
namespace {

class ReplayBus : public Bus {
 public:
  ~ReplayBus() override { end(""); }
  ReplayBus() = default;
  ReplayBus(const ReplayBus&) = delete;
  ReplayBus& operator=(const ReplayBus&) = delete;

  bool open(const std::string& name, std::string& why) {
    if (name != "-") {
      file_.open(name, std::ios::binary);
    }
    if (!file_) {
      why = name + ": " + std::strerror(errno);
      return false;
    }
    reader_ = read_log(name == "-" ? std::cin : file_, why);
    if (reader_ == nullptr) {
      why = (name == "-" ? "standard input" : name) + ": " + why;
      return false;
    }
    always_readable_ = eventfd(1, EFD_CLOEXEC);
    if (always_readable_ < 0) {
      why = name + ": " + std::strerror(errno);
    }
    return always_readable_ >= 0;
  }

  pollfd wanted() override { return {always_readable_, POLLIN, 0}; }

  std::optional<Entry> receive() override {
    std::optional<Entry> entry = always_readable_ < 0 ? std::nullopt : reader_->next();
    if (!entry && always_readable_ >= 0) {
      end(reader_->fault().empty() ? "the log has ended" : reader_->fault());
    }
    return entry;
  }

  bool send(const CO_IF_FRM& /*frame*/) override { return false; }
  bool restore() override { return false; }
  const std::string& fault() const override { return fault_; }
  std::uint64_t lost() const override { return reader_->lost(); }
  bool is_physical() const override { return false; }
  std::uint32_t bit_rate() const override { return 0; }
  const LogReader* log() const override { return reader_.get(); }

 private:
  void end(const std::string& why) {
    if (always_readable_ >= 0) {
      close(always_readable_);
    }
    always_readable_ = -1;
    fault_ = why;
  }

  std::ifstream file_;
  std::unique_ptr<LogReader> reader_;
  int always_readable_ = -1;  // until the log has ended
  std::string fault_;
};

}  // namespace

std::unique_ptr<Bus> open_replay(const std::string& file, const BusOptions& /*options*/, std::string& why) {
  auto bus = std::make_unique<ReplayBus>();
  return bus->open(file, why) ? std::move(bus) : nullptr;
}

}  // namespace lexican::host_bus
