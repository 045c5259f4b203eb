// SPDX-License-Identifier: Apache-2.0
#include "node_operations.hpp"

#include <algorithm>

namespace bench {
namespace {

bool is_ours(std::uint32_t identifier) {
  bool ours = identifier == 0 || identifier == 0x80 || identifier == 0x600 + node_id || identifier == 0x700 + node_id ||
              identifier == CO_LSS_RX_ID;
  for (const std::uint8_t other : heard_nodes) {
    ours = ours || identifier == 0x700u + other;
  }
  for (std::uint16_t number = 0; number < CO_RPDO_N && !ours; ++number) {
    ours = identifier == rpdo_id(number);
  }
  return ours;
}

std::uint8_t type_of(bool synchronous) { return synchronous ? 1 : 255; }

void put(std::uint8_t* memory, const Layout& layout, Random& random) {
  for (unsigned n = 0; n < layout.number; ++n) {
    change(memory + n * layout.stride, random);
  }
}

}  // namespace

std::uint32_t ForeignFrame::identifier() {
  std::uint32_t id = 0;
  do {
    id = random_.below(0x800);
  } while (is_ours(id));
  return id;
}

void change(std::uint8_t* memory, Random& random) {
  const std::uint8_t before = *memory;
  while (*memory == before) {
    *memory = random.byte();
  }
}

CO_IF_FRM random_rpdo(std::uint16_t number, const Layout& layout, Random& random) {
  CO_IF_FRM frame = {rpdo_id(number), {}, layout.length()};
  std::generate(frame.Data, frame.Data + frame.DLC, [&] { return random.byte(); });
  return frame;
}

void ReceivedPdo::arrange(unsigned) {
  number_ = static_cast<std::uint16_t>(random_.below(CO_RPDO_N));
  frame_ = random_rpdo(number_, layout_, random_);
  receive(frame_);
}

void TriggeredPdo::arrange(unsigned) {
  number_ = static_cast<std::uint16_t>(random_.below(CO_TPDO_N));
  put(tpdo_memory(number_), layout_, random_);
  forget_sent();
}

bool TriggeredPdo::is_done(unsigned) {
  return sent() == 1 && sent(0).Identifier == tpdo_id(number_) && holds(sent(0), layout_, tpdo_memory(number_));
}

void WrittenObject::arrange(unsigned) {
  number_ = static_cast<std::uint16_t>(random_.below(CO_TPDO_N));
  sub_ = static_cast<std::uint8_t>(1 + random_.below(bytes.number));
  key_ = CO_DEV(tpdo_objects(number_), sub_);
  value_ = tpdo_memory(number_)[sub_ - 1];
  change(&value_, random_);
  forget_sent();
}

bool WrittenObject::is_done(unsigned) {
  const std::uint8_t* const memory = tpdo_memory(number_);
  return sent() == 1 && sent(0).Identifier == tpdo_id(number_) && memory[sub_ - 1] == value_ &&
         holds(sent(0), bytes, memory);
}

void Sync::receive_all() {
  for (std::uint16_t number = 0; number < rpdos_; ++number) {
    received_[number] = random_rpdo(number, layout_, random_);
    receive(received_[number]);
  }
  for (std::uint16_t number = 0; number < tpdos_; ++number) {
    put(tpdo_memory(number), layout_, random_);
  }
  forget_sent();
  receive(frame(0x80, {}));
}

bool Sync::is_done(unsigned) {
  bool done = sent() == tpdos_;
  for (std::uint16_t number = 0; number < rpdos_; ++number) {
    done = done && holds(received_[number], layout_, rpdo_memory(number));
  }
  for (std::uint16_t number = 0; number < tpdos_ && done; ++number) {
    done = sent(number).Identifier == tpdo_id(number) && holds(sent(number), layout_, tpdo_memory(number));
  }
  return done;
}

void set_up_event_driven(const Layout& layout) { set_up_synchronous(layout, 0, 0); }

void set_up_synchronous(const Layout& layout, unsigned rpdos, unsigned tpdos) {
  clear_dictionary();
  add_usual_objects();
  for (std::uint16_t number = 0; number < CO_RPDO_N; ++number) {
    add_rpdo(number, type_of(number < rpdos), layout);
  }
  for (std::uint16_t number = 0; number < CO_TPDO_N; ++number) {
    add_tpdo(number, type_of(number < tpdos), layout);
  }
  start(CO_OPERATIONAL);
}

}  // namespace bench
