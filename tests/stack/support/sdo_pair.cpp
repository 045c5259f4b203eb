// SPDX-License-Identifier: Apache-2.0
#include "sdo_pair.hpp"

#if USE_CSDO

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

namespace test {
namespace {

constexpr std::size_t guard = 16;
constexpr std::uint8_t guard_byte = 0xA5;
constexpr std::uint8_t blank = 0xEE;
constexpr std::uint32_t value_key = CO_DEV(0x2001, 0);
constexpr std::uint32_t first_domain = 0x2010;

bool is_guard(std::uint8_t byte) { return byte == guard_byte; }

// Returns true for success or an abort code of CiA 301. Other codes are data that were read as a code. [301:7.2.4.3.17]
bool is_result(std::uint32_t code) {
  static const std::set<std::uint32_t> groups = {0x0503, 0x0504, 0x0601, 0x0602, 0x0604,
                                                 0x0606, 0x0607, 0x0609, 0x060A, 0x0800};
  return code == 0 || (groups.count(code >> 16) != 0 && (code & 0xFFFF) <= 0x47);
}

CO_OBJ entry(std::uint32_t index, std::uint8_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data) {
  return {CO_KEY(index, sub, flags), type, data};
}

std::size_t domain_of(std::uint32_t key) { return CO_GET_IDX(key) - first_domain; }

constexpr std::uint32_t request_base[] = {0x600, 0x240};  // request COB-IDs of 1200h and 1201h, without node-ID
constexpr std::uint32_t response_base[] = {0x580, 0x1C0};

}  // namespace

Bytes noise(std::uint32_t size, std::uint32_t seed) {
  Bytes bytes(size);
  std::uint32_t state = seed * 2654435761u + 1;
  for (std::uint8_t& byte : bytes) {
    state = state * 1664525u + 1013904223u;
    byte = static_cast<std::uint8_t>(state >> 24);
  }
  return bytes;
}

// A client -----------------------------------------------------------------------------------------------------------

CO_CSDO* DeviceClient::open(std::uint32_t key, const Bytes& data) {
  REQUIRE(is_over());
  memory_.assign(data.size() + 2 * guard, guard_byte);
  std::copy(data.begin(), data.end(), memory_.begin() + guard);
  key_ = key;
  callbacks = 0;
  return COCSdoFind(device_.node(), static_cast<std::uint8_t>(number_));
}

CO_ERR DeviceClient::upload(std::uint32_t key, std::uint32_t size, Milliseconds time_out) {
  CO_CSDO* const csdo = open(key, Bytes(size, blank));
  sent_.clear();
  return COCSdoRequestUpload(csdo, key, memory_.data() + guard, size, note,
                             static_cast<std::uint32_t>(time_out.count()));
}

CO_ERR DeviceClient::download(std::uint32_t key, const Bytes& data, Milliseconds time_out) {
  CO_CSDO* const csdo = open(key, data);
  sent_ = data;
  return COCSdoRequestDownload(csdo, key, memory_.data() + guard, static_cast<std::uint32_t>(data.size()), note,
                               static_cast<std::uint32_t>(time_out.count()));
}

Bytes DeviceClient::data() const {
  const auto first = memory_.begin() + guard;
  return {first, first + static_cast<std::ptrdiff_t>(std::min<std::size_t>(num, memory_.size() - 2 * guard))};
}

void DeviceClient::note(CO_CSDO* csdo, std::uint16_t index, std::uint8_t sub, std::uint32_t code) {
  auto* const device = static_cast<SdoDevice*>(CONodeGetUser(csdo->Node));
  const auto number = static_cast<std::size_t>(csdo - csdo->Node->CSdo);
  CHECK(csdo->State == CO_CSDO_STATE_IDLE);
  device->device_clients[number].end(CO_DEV(index, sub), code);
}

void DeviceClient::end(std::uint32_t key, std::uint32_t abort_code) {
  ++callbacks;
  code = abort_code;
  num = COCSdoGetNum(&device_->CSdo[number_]);
  tick = device_.world().clock.elapsed();
  CHECK(callbacks == 1);
  CHECK(is_result(code));
  CHECK(key == key_);
  CHECK(num <= memory_.size() - 2 * guard);
  CHECK(std::all_of(memory_.begin(), memory_.begin() + guard, is_guard));
  CHECK(std::all_of(memory_.end() - guard, memory_.end(), is_guard));
  CHECK(std::equal(sent_.begin(), sent_.end(), memory_.begin() + guard));
  if (const auto hook = on_end) {  // a copy: the function may replace on_end
    hook();
  }
}

// A device -----------------------------------------------------------------------------------------------------------

SdoDevice::SdoDevice(World& world, Line& line, const SdoDeviceOptions& options)
    : world_(world),
      options_(options),
      heartbeat_(options.heartbeat_ms),
      queue_(options.tx_queue),
      device_(make_device(line)) {
  for (unsigned n = 0; n < CO_CSDO_N; ++n) {
    device_clients.emplace_back(*this, n);
  }
  ext_ = *device_.node.Ext;
  ext_.TxQueue = queue_.empty() ? nullptr : queue_.data();
  ext_.TxQueueLen = options.tx_queue;
  CONodeStop(&device_.node);
  power_up();
}

// Stops the node, so that no callback is called after the clients are destroyed.
SdoDevice::~SdoDevice() { CONodeStop(node()); }

Device& SdoDevice::make_device(Line& line) {
  add_communication();
  add_application();
  table_.push_back(CO_OBJ_DICT_ENDMARK);
  DeviceOptions parts{options_.node_id};
  parts.start = false;
  parts.table = table_.data();
  parts.user = this;
  return world_.add_device(line, parts);
}

void SdoDevice::add_communication() {
  table_ = {
      entry(0x1000, 0, CO_OBJ_D___R_, CO_TUNSIGNED32, 0),
      entry(0x1001, 0, CO_OBJ_____R_, CO_TUNSIGNED8, &error_register_),
      entry(0x1017, 0, CO_OBJ_____RW, CO_THB_PROD, &heartbeat_),
      entry(0x1018, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 1),
      entry(0x1018, 1, CO_OBJ_D___R_, CO_TUNSIGNED32, 0),
      entry(0x1200, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2),
      entry(0x1200, 1, CO_OBJ_DN__R_, CO_TSDO_ID, request_base[0]),
      entry(0x1200, 2, CO_OBJ_DN__R_, CO_TSDO_ID, response_base[0]),
  };
#if CO_SSDO_N >= 2
  table_.push_back(entry(0x1201, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2));
  table_.push_back(entry(0x1201, 1, CO_OBJ_____RW, CO_TSDO_ID, &second_server_.request));
  table_.push_back(entry(0x1201, 2, CO_OBJ_____RW, CO_TSDO_ID, &second_server_.response));
#endif
  for (std::uint32_t n = 0; n < connections_.size(); ++n) {
    table_.push_back(entry(0x1280 + n, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 3));
    table_.push_back(entry(0x1280 + n, 1, CO_OBJ_____RW, CO_TSDO_ID, &connections_[n].request));
    table_.push_back(entry(0x1280 + n, 2, CO_OBJ_____RW, CO_TSDO_ID, &connections_[n].response));
    table_.push_back(entry(0x1280 + n, 3, CO_OBJ_____RW, CO_TUNSIGNED8, &connections_[n].server));
  }
}

void SdoDevice::add_application() {
  table_.push_back(entry(0x2001, 0, CO_OBJ_____RW, CO_TUNSIGNED64, &value_));
  for (std::uint32_t n = 0; n < domains_.size(); ++n) {
    resize(CO_DEV(first_domain + n, 0), options_.bytes[n]);
    table_.push_back(entry(first_domain + n, 0, CO_OBJ_____RW, CO_TDOMAIN, &domains_[n]));
  }
}

void SdoDevice::connect(unsigned client, std::uint8_t server, unsigned channel) {
  connections_[client] = {request_base[channel] + server, response_base[channel] + server, server};
}

void SdoDevice::open_second_channel() {
  const std::uint32_t id = options_.node_id;
  CHECK(CODictWrLong(&device_.node.Dict, CO_DEV(0x1201, 1), request_base[1] + id) == CO_ERR_NONE);
  CHECK(CODictWrLong(&device_.node.Dict, CO_DEV(0x1201, 2), response_base[1] + id) == CO_ERR_NONE);
}

void SdoDevice::close_second_channel() {
  CHECK(CODictWrLong(&device_.node.Dict, CO_DEV(0x1201, 1), CO_SDO_ID_OFF) == CO_ERR_NONE);
  CHECK(CODictWrLong(&device_.node.Dict, CO_DEV(0x1201, 2), CO_SDO_ID_OFF) == CO_ERR_NONE);
}

void SdoDevice::power_up() {
  CO_NODE& node = device_.node;
  CO_NODE_SPEC spec{};
  spec.NodeId = options_.node_id;
  spec.Baudrate = node.Baudrate;
  spec.Dict = table_.data();
  spec.DictLen = static_cast<std::uint16_t>(table_.size() - 1);
  spec.TmrFreq = node.Tmr.Freq;
  spec.SdoBuf = options_.block ? node.SdoBuf : nullptr;
  CONodeInitEx(&node, &spec, &ext_);
  REQUIRE(CONodeGetErr(&node) == CO_ERR_NONE);
  CONodeStart(&node);
}

Bytes SdoDevice::read(std::uint32_t key) const {
  if (key != value_key) {
    return memory_[domain_of(key)];
  }
  Bytes bytes;
  for (unsigned shift = 0; shift < 64; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(value_ >> shift));
  }
  return bytes;
}

void SdoDevice::fill(std::uint32_t key, const Bytes& data) {
  if (key != value_key) {
    std::copy(data.begin(), data.end(), memory_[domain_of(key)].begin());
    return;
  }
  value_ = 0;
  for (unsigned n = 0; n < sizeof value_; ++n) {
    value_ |= std::uint64_t{data[n]} << (8 * n);
  }
}

void SdoDevice::resize(std::uint32_t key, std::uint32_t bytes) {
  const std::size_t n = domain_of(key);
  memory_[n].assign(bytes, 0);
  domains_[n] = {0, bytes, memory_[n].data()};
}

// Transfers ----------------------------------------------------------------------------------------------------------

void Exchange::start(Direction direction, std::uint32_t key, Milliseconds time_out) {
  key_ = key;
  const auto size = static_cast<std::uint32_t>(server_.read(key).size());
  data_ = noise(size, ++seed_);
  if (direction == Direction::upload) {
    server_.fill(key, data_);
    CHECK(device_client().upload(key, size, time_out) == CO_ERR_NONE);
    return;
  }
  Bytes others = data_;
  std::for_each(others.begin(), others.end(), [](std::uint8_t& byte) { byte ^= 0xFFU; });
  server_.fill(key, others);
  CHECK(device_client().download(key, data_, time_out) == CO_ERR_NONE);
}

std::string Exchange::wrong() const {
  if (device_client().code != 0) {
    return "";
  }
  const std::string what = device_client().num != data_.size() ? "number of bytes" : "";
  return what + (device_client().data() != data_ ? " data of the client" : "") +
         (server_.read(key_) != data_ ? " data of the server" : "");
}

// A client and a server ----------------------------------------------------------------------------------------------

namespace {

constexpr std::uint32_t short_bytes = 36;

SdoDeviceOptions options_of(std::uint8_t node_id, const SdoPairOptions& pair) {
  return {node_id, {pair.bytes, short_bytes, short_bytes}, pair.block, pair.heartbeat_ms, pair.tx_queue};
}

}  // namespace

SdoPair::SdoPair(const SdoPairOptions& options)
    : world(options.ticks_per_second),
      line(world.add_line("pair")),
      server(world, line, options_of(server_id, options)),
      client(world, line, options_of(client_id, options)) {
  line.stop_recording();
  client.connect(0, server_id, options.second_channel ? 1 : 0);
  if (options.second_channel) {
    server.open_second_channel();
  }
  world.settle();
}

void SdoPair::start(Direction direction, std::uint32_t key, Milliseconds time_out) {
  began_ = world.clock.elapsed();
  exchange_.start(direction, key, time_out);
}

std::uint32_t SdoPair::finish(Milliseconds limit) {
  constexpr Milliseconds step{50};
  const std::uint64_t end = began_ + world.clock.ticks(limit);
  world.settle();
  while (!device_client().is_over() && world.clock.elapsed() < end) {
    world.pass(step);
  }
  REQUIRE(device_client().is_over());
  REQUIRE(device_client().tick <= end);
  REQUIRE(wrong() == "");
  return device_client().code;
}

std::uint32_t SdoPair::run(Direction direction, std::uint32_t key, Milliseconds time_out, Milliseconds limit) {
  start(direction, key, time_out);
  return finish(limit);
}

void SdoPair::check_next(Milliseconds limit) {
  for (const Direction direction : {Direction::download, Direction::upload}) {
    REQUIRE(run(direction, short_object, Milliseconds{1000}, limit) == 0);
  }
}

bool SdoPair::becomes_idle(Milliseconds within) {
  world.pass(within);
  return server.is_at_rest() && client.is_at_rest();
}

std::uint32_t SdoPair::count_frames(Direction direction, std::uint32_t key) {
  const std::size_t rule = line.bus.add_rule({co::VirtualBus::Fault::none, {}, 1, co::VirtualBus::always});
  REQUIRE(run(direction, key) == 0);
  const std::uint32_t frames = line.bus.struck(rule);
  line.bus.clear_rules();
  return frames;
}

}  // namespace test

#endif
