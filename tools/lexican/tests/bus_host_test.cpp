// SPDX-License-Identifier: Apache-2.0
// A bus as the host of a node.
#include "host/bus_host.hpp"

#include <doctest/doctest.h>
#include <poll.h>
#include <unistd.h>

#include <csignal>

namespace {

using namespace lexican;

/// A bus with frames that poll() does not report, because they were read from the socket together with earlier ones.
class BufferedBus : public host_bus::Bus {
 public:
  explicit BufferedBus(unsigned frames) : frames_(frames) { REQUIRE(pipe(silent_) == 0); }
  ~BufferedBus() override {
    close(silent_[0]);
    close(silent_[1]);
  }
  BufferedBus(const BufferedBus&) = delete;
  BufferedBus& operator=(const BufferedBus&) = delete;

  pollfd wanted() override { return {silent_[0], POLLIN, 0}; }
  std::optional<host_bus::Entry> receive() override {
    if (frames_ == 0) {
      return std::nullopt;
    }
    --frames_;
    return host_bus::Entry{};
  }
  bool send(const CO_IF_FRM& /*frame*/) override { return false; }
  bool restore() override { return true; }
  const std::string& fault() const override { return fault_; }
  std::uint64_t lost() const override { return 0; }
  bool is_physical() const override { return false; }
  std::uint32_t bit_rate() const override { return 0; }

 private:
  int silent_[2]{};
  unsigned frames_;
  std::string fault_;
};

}  // namespace

TEST_CASE("bus host: it does not wait while the bus may have frames that were not read") {
  BufferedBus bus(3);
  const Interruption interruption;
  BusHost host(bus, interruption);
  const Can can = host.master_can();
  CO_IF_FRM frame{};
  const Micros begin = host.now();
  for (unsigned n = 0; n < 3; ++n) {
    CHECK(can.driver->Read(can.context, &frame) > 0);
    host.wait(second);
  }
  CHECK(host.now() - begin < second);
  CHECK(can.driver->Read(can.context, &frame) == 0);
  const Micros idle = host.now();
  host.wait(20 * millisecond);
  CHECK(host.now() - idle >= 20 * millisecond);
}

TEST_CASE("interruption: a second signal does not kill a program that ends because of the first") {
  for (const int signal : {SIGINT, SIGTERM}) {
    {
      const Interruption interruption;
      CHECK(!Interruption::happened());
      raise(signal);
      CHECK(Interruption::happened());  // also of a program that never has to wait
      ppoll(nullptr, 0, nullptr, &interruption.while_waiting());
      CHECK(Interruption::happened());
      raise(signal);
    }
    raise(signal);
  }
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
}
