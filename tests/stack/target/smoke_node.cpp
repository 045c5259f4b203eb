// SPDX-License-Identifier: Apache-2.0
#include "smoke_node.hpp"

namespace smoke {
namespace {

struct Objects {
  std::uint8_t error_register;
  std::uint16_t heartbeat;
  std::uint32_t u32;
  std::uint8_t u8;
  std::uint16_t u16;
  std::uint8_t memory[10];
};

Objects objects;

CO_OBJ_STR name{0, reinterpret_cast<const std::uint8_t*>("Lexican smoke test")};
CO_OBJ_DOM domain{0, sizeof objects.memory, objects.memory};
CO_HBCONS consumer;
std::uint32_t emcy_id = 0x80;
CO_EMCY_TBL errors[] = {{0, 0x1000}, {1, 0x2000}};

CO_OBJ dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(0x000F0191)},
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, CO_DATA(&objects.error_register)},
    {CO_KEY(0x1005, 0, CO_OBJ_D___R_), CO_TSYNC_ID, CO_DATA(0x80)},
    {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, CO_DATA(&name)},
    {CO_KEY(0x1014, 0, CO_OBJ__N__R_), CO_TEMCY_ID, CO_DATA(&emcy_id)},
    {CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(1)},
    {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, CO_DATA(&consumer)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, CO_DATA(&objects.heartbeat)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(4)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(1)},
    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(2)},
    {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(3)},
    {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(4)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, CO_DATA(0x200)},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(255)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(CO_LINK(0x2000, 0, 32))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, CO_DATA(0x40000180)},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(255)},
    {CO_KEY(0x1801, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(2)},
    {CO_KEY(0x1801, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, CO_DATA(0x40000280)},
    {CO_KEY(0x1801, 2, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(1)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x1A01, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(2)},
    {CO_KEY(0x1A01, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(CO_LINK(0x2002, 0, 16))},
    {CO_KEY(0x1A01, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(CO_LINK(0x2000, 0, 32))},
    {CO_KEY(0x2000, 0, CO_OBJ____PRW), CO_TUNSIGNED32, CO_DATA(&objects.u32)},
    {CO_KEY(0x2001, 0, CO_OBJ___APRW), CO_TUNSIGNED8, CO_DATA(&objects.u8)},
    {CO_KEY(0x2002, 0, CO_OBJ____PRW), CO_TUNSIGNED16, CO_DATA(&objects.u16)},
    {CO_KEY(0x2100, 0, CO_OBJ_____RW), CO_TDOMAIN, CO_DATA(&domain)},
    CO_OBJ_DICT_ENDMARK,
};

void set_objects() {
  objects = Objects{};
  consumer = CO_HBCONS{};
  consumer.NodeId = 2;
  consumer.Time = 1000;
  for (std::size_t i = 0; i < sizeof objects.memory; ++i) {
    objects.memory[i] = static_cast<std::uint8_t>(i + 1);
  }
}

}  // namespace

struct Node::Drivers {
  static Node& of(void* ctx) { return *static_cast<Node*>(ctx); }

  static void nothing(void*) {}
  static void enable(void*, std::uint32_t) {}
  static std::int16_t read(void* ctx, CO_IF_FRM* frm) {
    Node& self = of(ctx);
    if (!self.has_received_) {
      return 0;
    }
    *frm = self.received_;
    self.has_received_ = false;
    return sizeof *frm;
  }
  static std::int16_t send(void* ctx, const CO_IF_FRM* frm) {
    Node& self = of(ctx);
    self.sent_[self.sent_num_++ % places] = *frm;
    return sizeof *frm;
  }
  static std::uint32_t now(void* ctx) { return of(ctx).now_; }

  static constexpr CO_IF_CAN_DRV_EX can{nothing, enable, read, send, nothing, nothing, nullptr, nullptr};
  static constexpr CO_IF_TIMER_DRV_EX timer{enable, now, nullptr};
};

void Node::start() {
  set_objects();
  has_received_ = false;
  sent_num_ = taken_num_ = 0;
  now_ = 0;
  ext_ = CO_NODE_EXT{};
  ext_.Size = sizeof ext_;
  ext_.Can = &Drivers::can;
  ext_.Timer = &Drivers::timer;
  ext_.CanCtx = ext_.TimerCtx = this;
  ext_.EmcyNum = sizeof errors / sizeof errors[0];
  CO_NODE_SPEC spec{};
  spec.NodeId = 1;
  spec.Baudrate = 250000;
  spec.Dict = dictionary;
  spec.DictLen = sizeof dictionary / sizeof dictionary[0];
  spec.EmcyCode = errors;
  spec.TmrFreq = 1000;
  spec.SdoBuf = sdo_buffer_;
  CONodeInitEx(&node_, &spec, &ext_);
  CONodeStart(&node_);
}

void Node::receive(const CO_IF_FRM& frm) {
  received_ = frm;
  has_received_ = true;
  process();
}

void Node::pass(std::uint32_t ms) {
  for (const std::uint32_t end = now_ + ms; now_ != end;) {
    ++now_;
    process();
  }
}

bool Node::take(CO_IF_FRM& frm) {
  if (taken_num_ == sent_num_) {
    return false;
  }
  frm = sent_[taken_num_++ % places];
  return true;
}

void Node::set_error(std::uint8_t error) {
  COEmcySet(&node_.Emcy, error, nullptr);
  process();
}

void Node::clear_error(std::uint8_t error) {
  COEmcyClr(&node_.Emcy, error);
  process();
}

// Processes the node, and frames that one call leaves to the next, like those of a block transfer.
void Node::process() {
  for (std::size_t calls = 0; calls < places; ++calls) {
    COTmrService(&node_.Tmr);
    COTmrProcess(&node_.Tmr);
    CONodeProcess(&node_);
  }
}

}  // namespace smoke
