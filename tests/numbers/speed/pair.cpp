// SPDX-License-Identifier: Apache-2.0
#include "pair.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "frame_bits.hpp"

namespace speed {
namespace {

constexpr std::uint8_t client_id = 1;
constexpr std::uint32_t answer_ms = 1000;
constexpr Time patience = std::chrono::minutes{1};

CO_OBJ entry(std::uint16_t index, std::uint8_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data) {
  return {CO_KEY(index, sub, flags), type, data};
}

std::vector<CO_OBJ> with_mandatory(const std::vector<CO_OBJ>& others) {
  std::vector<CO_OBJ> all = {
      entry(0x1000, 0, CO_OBJ_D___R_, CO_TUNSIGNED32, 0), entry(0x1001, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 0),
      entry(0x1018, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 1), entry(0x1018, 1, CO_OBJ_D___R_, CO_TUNSIGNED32, 0)};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

std::vector<CO_OBJ> client_dictionary() {
  return with_mandatory({entry(0x1280, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 3),
                         entry(0x1280, 1, CO_OBJ_D___R_, CO_TSDO_ID, 0x600 + server_id),
                         entry(0x1280, 2, CO_OBJ_D___R_, CO_TSDO_ID, 0x580 + server_id),
                         entry(0x1280, 3, CO_OBJ_D___R_, CO_TUNSIGNED8, server_id)});
}

class Pair {
 public:
  Pair(const Hardware& hardware, const Transfers& transfers);
  Result run();

 private:
  static void on_end(CO_CSDO* csdo, std::uint16_t index, std::uint8_t sub, std::uint32_t code);
  std::vector<CO_OBJ> server_dictionary();
  void request();
  void end(std::uint32_t abort);
  void run_until_rest();
  bool is_at_rest();
  Time next_event() const;
  void run_stations();

  const Hardware hardware_;
  const Transfers& transfers_;
  co::VirtualClock clock_;
  co::VirtualBus bus_;
  Bytes buffer_;  // client's data
  Bytes object_;  // server's object
  CO_OBJ_DOM domain_{};
  std::array<std::uint8_t, CO_SSDO_N * CO_SDO_BUF_BYTE> sdo_memory_{};
  std::optional<Station> client_;
  std::optional<Station> server_;
  Time next_round_[2];  // next iteration of the main loop of client and server
  std::size_t done_ = 0;
  std::string failure_ = "does not end";
  Time last_end_{0};
  std::uint64_t bits_ = 0;
};

Pair::Pair(const Hardware& hardware, const Transfers& transfers)
    : hardware_(hardware),
      transfers_(transfers),
      object_(transfers.data.front().size()),
      domain_{0, static_cast<std::uint32_t>(object_.size()), object_.data()},
      next_round_{Time{0}, hardware.loop / 2} {  // the loops of two devices are not synchronous
  bus_.set_time([this] { return clock_.time(); });
  bus_.set_trace([this](const co::VirtualBus::Traffic& traffic) {
    last_end_ = traffic.time;
    bits_ += co::frame_bits(traffic.frame) + co::intermission_bits;
  });
  bus_.pace(hardware.bit_rate);
  std::uint8_t* const block_memory = (transfers.way == Way::block) ? sdo_memory_.data() : nullptr;
  client_.emplace(bus_, clock_, hardware.transmit, client_id, client_dictionary(), nullptr, this);
  server_.emplace(bus_, clock_, hardware.transmit, server_id, server_dictionary(), block_memory, nullptr);
  run_until_rest();  // transmits the boot-up messages
}

std::vector<CO_OBJ> Pair::server_dictionary() {
  return with_mandatory({entry(0x1200, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2),
                         entry(0x1200, 1, CO_OBJ_DN__R_, CO_TSDO_ID, CO_COBID_SDO_REQUEST()),
                         entry(0x1200, 2, CO_OBJ_DN__R_, CO_TSDO_ID, CO_COBID_SDO_RESPONSE()),
                         entry(object_index, object_sub, CO_OBJ_____RW, CO_TDOMAIN, &domain_)});
}

void Pair::on_end(CO_CSDO* csdo, std::uint16_t, std::uint8_t, std::uint32_t code) {
  static_cast<Pair*>(CONodeGetUser(csdo->Node))->end(code);
}

void Pair::end(std::uint32_t abort) {
  const Bytes& data = transfers_.data[done_];
  if (abort != 0 || buffer_ != data || object_ != data) {
    failure_ = (abort != 0) ? "aborted, code " + std::to_string(abort) : "other data have arrived than were sent";
    return;
  }
  ++done_;
  if (done_ < transfers_.data.size()) {
    request();
  }
}

void Pair::request() {
  const Bytes& data = transfers_.data[done_];
  Bytes& source = transfers_.upload ? object_ : buffer_;
  Bytes& sink = transfers_.upload ? buffer_ : object_;
  std::copy(data.begin(), data.end(), source.begin());
  std::fill(sink.begin(), sink.end(), std::uint8_t{0});
  const auto start = transfers_.upload ? COCSdoRequestUpload : COCSdoRequestDownload;
  const auto size = static_cast<std::uint32_t>(data.size());
  CO_CSDO* const csdo = COCSdoFind(&client_->node, 0);
  if (start(csdo, CO_DEV(object_index, object_sub), buffer_.data(), size, on_end, answer_ms) != CO_ERR_NONE) {
    failure_ = "a request was refused";
  }
}

Result Pair::run() {
  buffer_.resize(object_.size());
  bits_ = 0;
  const Time begin = clock_.time();
  request();
  run_until_rest();
  if (done_ != transfers_.data.size()) {
    throw std::runtime_error("transfer " + std::to_string(done_ + 1) + ": " + failure_);
  }
  return {last_end_ - begin, bits_};
}

void Pair::run_until_rest() {
  while (!is_at_rest()) {
    if (clock_.time() > patience) {
      throw std::runtime_error("the nodes do not come to rest");
    }
    clock_.advance(clock_.ticks(next_event() - clock_.time()));
    bus_.poll();
    run_stations();
  }
}

bool Pair::is_at_rest() {
  return bus_.next_due() == co::VirtualBus::never && client_->is_at_rest() && server_->is_at_rest();
}

Time Pair::next_event() const {
  if (hardware_.loop != Time{0}) {
    return std::min({bus_.next_due(), next_round_[0], next_round_[1]});
  }
  const Time alarm = clock_.time() + Time{clock_.next_alarm()};  // a tick is a microsecond
  return std::min(bus_.next_due(), alarm);
}

void Pair::run_stations() {
  Station* const stations[] = {&*client_, &*server_};
  for (unsigned n = 0; n < 2; ++n) {
    if (hardware_.loop == Time{0}) {
      stations[n]->work_off();
    } else if (next_round_[n] <= clock_.time()) {
      stations[n]->go_round();
      next_round_[n] += hardware_.loop;
    }
  }
}

}  // namespace

Result measure(const Hardware& hardware, const Transfers& transfers) { return Pair(hardware, transfers).run(); }

}  // namespace speed
