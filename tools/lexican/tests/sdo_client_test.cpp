// SPDX-License-Identifier: Apache-2.0
// The SDO client of the tool, on a simulated bus with a virtual clock.
#include "client/sdo_client.hpp"

#include <doctest/doctest.h>

#include <optional>

#include "frame_bits.hpp"
#include "virtual_network.hpp"

namespace {

using namespace lexican;

/// Share of the time that frames occupy on the wire, from the first to the last one.
class WireShare {
 public:
  explicit WireShare(co::VirtualBus& bus) : bus_(bus) {
    bus_.set_trace([this](const co::VirtualBus::Traffic& traffic) {
      const auto end = static_cast<Micros>(traffic.time.count());
      const unsigned bits = co::frame_bits(traffic.frame) + co::intermission_bits;
      begin_ = begin_ ? begin_ : end - time_of(bits);
      end_ = end;
      bits_ += bits;
    });
  }
  ~WireShare() { bus_.set_trace({}); }
  WireShare(const WireShare&) = delete;
  WireShare& operator=(const WireShare&) = delete;

  Micros elapsed() const { return end_ - begin_.value_or(0); }
  double per_cent() const { return 100.0 * static_cast<double>(time_of(bits_)) / static_cast<double>(elapsed()); }

 private:
  static Micros time_of(Micros bits) { return bits * second / VirtualNetwork::bit_rate; }

  co::VirtualBus& bus_;
  std::optional<Micros> begin_;  // of the first frame
  Micros end_ = 0;
  Micros bits_ = 0;
};

}  // namespace

TEST_CASE("sdo client: block transfers of 1 MB use at least 97 % of a wire of 500 kbit/s") {
  constexpr std::uint32_t size = 1'000'000;
  constexpr std::uint8_t id = 5;
  VirtualNetwork network;
  network.add(id, 1, size);
  Bytes& memory = network.domain(0);
  for (std::size_t n = 0; n < size; ++n) {
    memory[n] = static_cast<std::uint8_t>(n * 7 + n / 256);
  }
  const Bytes expected = memory;
  ClientDictionary dictionary(id);
  Node master({1, network.master_can(), network.master_timer(), dictionary.table()});
  CONodeStart(&master.stack());
  Loop loop(network, {&master});
  loop.flush(second);
  SdoClient client(master, loop, {size});
  WireShare share(network.bus());
  SUBCASE("upload") {
    const Transfer transfer = client.upload(0x2009, 0);
    CHECK(transfer.outcome() == "done");
    CHECK((transfer.data == expected));
  }
  SUBCASE("download") {
    memory.assign(size, 0);
    CHECK(client.download(0x2009, 0, expected).outcome() == "done");
    CHECK((memory == expected));
  }
  MESSAGE("1 MB in " << share.elapsed() / millisecond << " ms, " << share.per_cent() << " % of the wire");
  CHECK(share.per_cent() >= 97.0);
}
