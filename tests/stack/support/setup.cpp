// SPDX-License-Identifier: Apache-2.0
// Settings and object dictionary of a fixture.
#include <algorithm>
#include <iterator>

#include "fixture.hpp"

namespace test {

Setup& Setup::node_id(std::uint8_t id) { return node_id_ = id, *this; }
Setup& Setup::rate(std::uint32_t ticks_per_second) { return rate_ = ticks_per_second, *this; }
Setup& Setup::clock(std::uint32_t start_tick) { return clock_ = start_tick, *this; }
Setup& Setup::heartbeat(std::uint16_t ms) { return heartbeat_ = ms, *this; }
Setup& Setup::wake(Wake how) { return wake_ = how, *this; }
Setup& Setup::timers(std::uint16_t number) { return timers_ = number, *this; }
Setup& Setup::tx_queue(std::uint16_t frames) { return tx_queue_ = frames, *this; }
Setup& Setup::stay_in_init() { return start_ = false, *this; }
Setup& Setup::emergencies(std::vector<CO_EMCY_TBL> table) { return emergencies_ = std::move(table), *this; }
Setup& Setup::nmt_master() { return nmt_master_ = true, *this; }
Setup& Setup::with(CO_OBJ entry) { return with_[CO_GET_DEV(entry.Key)] = entry, *this; }
Setup& Setup::without(std::uint16_t index, std::uint8_t sub) { return without_.push_back(CO_DEV(index, sub)), *this; }
Setup& Setup::only_small() { return large_domains_ = false, *this; }
Setup& Setup::with_70000() { return long_ = true, *this; }
Setup& Setup::with_mebibyte() { return mebibyte_ = true, *this; }
Setup& Setup::ends_with(CO_OBJ end_mark) { return end_mark_ = end_mark, *this; }
Setup& Setup::without_sdo_buffer() { return sdo_buffer_ = false, *this; }
Setup& Setup::writable(std::function<bool(const void*, std::uint32_t)> may_write) {
  return may_write_ = std::move(may_write), *this;
}
Setup& Setup::nvm(const CO_IF_NVM_DRV_EX& driver, void* context) {
  nvm_ = &driver;
  nvm_context_ = context;
  return *this;
}
#if USE_REAL_TIME
Setup& Setup::turns() { return turns_ = true, *this; }
Setup& Setup::mainline(CO_RING& of) { return mainline_ = &of, *this; }
Setup& Setup::foreign() { return foreign_ = true, *this; }
#endif
Setup& Setup::no_nvm() { return nvm_ = nullptr, *this; }
Setup& Setup::callbacks(const CO_CALLBACKS& table) { return callbacks_ = &table, *this; }
Setup& Setup::may_change(std::uint16_t index, std::uint8_t sub) {
  may_change_.emplace_back(index, sub);
  return *this;
}
Setup& Setup::before_init(std::function<void(Objects&)> change) { return before_init_ = std::move(change), *this; }

namespace {

using Table = std::vector<CO_OBJ>;

CO_OBJ entry(std::uint16_t index, std::uint8_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data) {
  return CO_OBJ{CO_KEY(index, sub, flags), type, data};
}

void add_communication(Table& table, Objects& o) {
  const Table part = {
      entry(0x1000, 0, CO_OBJ_D___R_, CO_TUNSIGNED32, 0x000F0191),
      entry(0x1001, 0, CO_OBJ____PR_, CO_TUNSIGNED8, &o.error_register),
      entry(0x1008, 0, CO_OBJ_____R_, CO_TSTRING, &o.device_name),
      entry(0x100A, 0, CO_OBJ_____R_, CO_TSTRING, &o.version),
      entry(0x1014, 0, CO_OBJ_DN__R_, CO_TUNSIGNED32, 0x80),
      entry(0x1017, 0, CO_OBJ_____RW, CO_THB_PROD, &o.heartbeat),
      entry(0x1018, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 3),  // without serial number, so that the node has no LSS address
      entry(0x1018, 1, CO_OBJ_D___R_, CO_TUNSIGNED32, 0x11111111),
      entry(0x1018, 2, CO_OBJ_D___R_, CO_TUNSIGNED32, 0x22222222),
      entry(0x1018, 3, CO_OBJ_D___R_, CO_TUNSIGNED32, 0x33333333),
      entry(0x1200, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2),
      entry(0x1200, 1, CO_OBJ_DN__R_, CO_TSDO_ID, CO_COBID_SDO_REQUEST()),
      entry(0x1200, 2, CO_OBJ_DN__R_, CO_TSDO_ID, CO_COBID_SDO_RESPONSE()),
  };
  table.insert(table.end(), part.begin(), part.end());
}

void add_servers([[maybe_unused]] Table& table, [[maybe_unused]] Objects& o) {
#if CO_SSDO_N >= 2
  table.push_back(entry(0x1201, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2));
  table.push_back(entry(0x1201, 1, CO_OBJ_____RW, CO_TSDO_ID, &o.sdo2_rx));
  table.push_back(entry(0x1201, 2, CO_OBJ_____RW, CO_TSDO_ID, &o.sdo2_tx));
#endif
#if CO_SSDO_N >= 3
  table.push_back(entry(0x1202, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2));
  table.push_back(entry(0x1202, 1, CO_OBJ_____RW, CO_TSDO_ID, &o.sdo3_rx));
  table.push_back(entry(0x1202, 2, CO_OBJ_____RW, CO_TSDO_ID, &o.sdo3_tx));
#endif
}

void add_numbers(Table& table, Objects& o) {
  const Table part = {
      entry(0x2001, 0, CO_OBJ____PRW, CO_TUNSIGNED8, &o.u8),
      entry(0x2002, 0, CO_OBJ____PRW, CO_TUNSIGNED16, &o.u16),
      entry(0x2003, 0, CO_OBJ_____RW, CO_TUNSIGNED24, &o.u24),
      entry(0x2004, 0, CO_OBJ____PRW, CO_TUNSIGNED32, &o.u32),
      entry(0x2005, 0, CO_OBJ_____RW, CO_TUNSIGNED40, &o.u40),
      entry(0x2006, 0, CO_OBJ_____RW, CO_TUNSIGNED48, &o.u48),
      entry(0x2007, 0, CO_OBJ_____RW, CO_TUNSIGNED56, &o.u56),
      entry(0x2008, 0, CO_OBJ_____RW, CO_TUNSIGNED64, &o.u64),
      entry(0x2020, 0, CO_OBJ_____RW, CO_TBOOLEAN, &o.boolean),
      entry(0x2024, 0, CO_OBJ_____RW, CO_TREAL32, &o.real32),
      entry(0x2026, 0, CO_OBJ_____RW, CO_TTIME_OF_DAY, &o.time_of_day),
      entry(0x2028, 0, CO_OBJ_____RW, CO_TREAL64, &o.real64),
      entry(0x2030, 0, CO_OBJ______W, CO_TUNSIGNED32, &o.write_only),
      entry(0x2031, 0, CO_OBJ_____R_, CO_TUNSIGNED32, &o.read_only),
      entry(0x2032, 0, CO_OBJ_______, CO_TUNSIGNED32, &o.no_access),
      entry(0x2033, 1, CO_OBJ_____RW, CO_TUNSIGNED32, &o.record),
      entry(0x2034, 0, CO_OBJ_DN__RW, CO_TUNSIGNED32, 0x180),
  };
  table.insert(table.end(), part.begin(), part.end());
}

CO_OBJ_DOM* make_domain(Objects& o, std::uint32_t size) {
  Bytes& memory = o.memory[size];
  memory.resize(size > 0 ? size : 1);
  for (std::size_t i = 0; i < memory.size(); ++i) {
    memory[i] = static_cast<std::uint8_t>(i + 1);
  }
  o.domain[size] = CO_OBJ_DOM{0, size, memory.data()};
  return &o.domain[size];
}

void add_large_domains(Table& table, Objects& o) {
  table.push_back(entry(0x2101, 0, CO_OBJ_____RW, CO_TDOMAIN, make_domain(o, 889)));
  table.push_back(entry(0x2103, 0, CO_OBJ_____RW, CO_TDOMAIN, make_domain(o, 888)));
  table.push_back(entry(0x2104, 0, CO_OBJ_____RW, CO_TDOMAIN, make_domain(o, 890)));
}

void add_streams(Table& table, Objects& o) {
  static constexpr std::uint8_t sizes[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 14, 15};
  for (const std::uint8_t size : sizes) {
    table.push_back(entry(0x2100, size, CO_OBJ_____RW, CO_TDOMAIN, make_domain(o, size)));
  }
  table.push_back(entry(0x2110, 0, CO_OBJ_____RW, CO_TVISIBLE_STRING, &o.text));
  table.push_back(entry(0x2111, 0, CO_OBJ_____RW, CO_TOCTET_STRING, &o.octets));
  table.push_back(entry(0x2112, 0, CO_OBJ_____RW, CO_TUNICODE_STRING, &o.unicode));
}

}  // namespace

std::vector<CO_OBJ> Setup::dictionary(Objects& objects) const {
  objects.heartbeat = heartbeat_;
  Table table;
  add_communication(table, objects);
  add_servers(table, objects);
  add_numbers(table, objects);
  add_streams(table, objects);
  if (large_domains_) {
    add_large_domains(table, objects);
  }
  if (long_) {
    table.push_back(entry(0x2102, 0, CO_OBJ_____RW, CO_TDOMAIN, make_domain(objects, 70000)));
  }
  if (mebibyte_) {
    table.push_back(entry(0x2105, 0, CO_OBJ_____RW, CO_TDOMAIN, make_domain(objects, mebibyte)));
  }
  std::map<std::uint32_t, CO_OBJ> sorted;
  for (const CO_OBJ& obj : table) {
    sorted[CO_GET_DEV(obj.Key)] = obj;
  }
  for (const auto& [dev, obj] : with_) {
    sorted[dev] = obj;
  }
  for (const std::uint32_t dev : without_) {
    sorted.erase(dev);
  }
  table.clear();
  std::transform(sorted.begin(), sorted.end(), std::back_inserter(table), [](const auto& pair) { return pair.second; });
  table.push_back(end_mark_);
  return table;
}

}  // namespace test
