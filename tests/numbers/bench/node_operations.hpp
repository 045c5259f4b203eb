// SPDX-License-Identifier: Apache-2.0
/// \file node_operations.hpp
/// Operations that are measured on nodes with different numbers of PDOs.
#pragma once

#include "device.hpp"
#include "measure.hpp"
#include "random.hpp"

namespace bench {

/// A frame with an 11-bit identifier that the node does not consume.
class ForeignFrame : public Operation {
 public:
  explicit ForeignFrame(void (*set_up_node)()) : set_up_node_(set_up_node) {}
  void set_up() { set_up_node_(); }
  void arrange(unsigned) {
    CO_IF_FRM foreign = {identifier(), {}, static_cast<std::uint8_t>(random_.below(9))};
    for (std::uint8_t& byte : foreign.Data) {
      byte = random_.byte();
    }
    unclaimed_ = CONodeGetCounters(&node).Unclaimed;
    receive(foreign);
  }
  void run() { CONodeProcess(&node); }
  bool is_done(unsigned) { return CONodeGetCounters(&node).Unclaimed == unclaimed_ + 1 && sent() == 0; }

 private:
  std::uint32_t identifier();

  void (*set_up_node_)();
  Random random_;
  std::uint32_t unclaimed_ = 0;
};

/// An event-driven RPDO, which is applied at once.
class ReceivedPdo : public Operation {
 public:
  ReceivedPdo(void (*set_up_node)(const Layout&), const Layout& layout) : set_up_node_(set_up_node), layout_(layout) {}
  void set_up() { set_up_node_(layout_); }
  void arrange(unsigned);
  void run() { CONodeProcess(&node); }
  bool is_done(unsigned) { return holds(frame_, layout_, rpdo_memory(number_)); }

 private:
  void (*set_up_node_)(const Layout&);
  Layout layout_;
  Random random_;
  std::uint16_t number_ = 0;
  CO_IF_FRM frame_{};
};

/// A TPDO that is triggered by its number.
class TriggeredPdo : public Operation {
 public:
  TriggeredPdo(void (*set_up_node)(const Layout&), const Layout& layout) : set_up_node_(set_up_node), layout_(layout) {}
  void set_up() { set_up_node_(layout_); }
  void arrange(unsigned);
  void run() { COTPdoTrigPdo(node.TPdo, number_); }
  bool is_done(unsigned);

 private:
  void (*set_up_node_)(const Layout&);
  Layout layout_;
  Random random_;
  std::uint16_t number_ = 0;
};

/// An UNSIGNED8 that is written by index and sub-index, which triggers its TPDO of eight such objects.
class WrittenObject : public Operation {
 public:
  explicit WrittenObject(void (*set_up_node)(const Layout&)) : set_up_node_(set_up_node) {}
  void set_up() { set_up_node_(bytes); }
  void arrange(unsigned);
  void run() { CODictWrByte(&node.Dict, key_, value_); }
  bool is_done(unsigned);

 private:
  void (*set_up_node_)(const Layout&);
  Random random_;
  std::uint16_t number_ = 0;
  std::uint32_t key_ = 0;
  std::uint8_t sub_ = 0;
  std::uint8_t value_ = 0;
};

/// Changes a byte to a different random value.
void change(std::uint8_t* memory, Random& random);

/// Returns a frame of RPDO \a number with random bytes.
CO_IF_FRM random_rpdo(std::uint16_t number, const Layout& layout, Random& random);

/// A SYNC that applies synchronous RPDOs and sends synchronous TPDOs. The reception of the RPDOs' frames is not
/// counted.
class Sync : public Operation {
 public:
  /// The first \a rpdos and \a tpdos are synchronous.
  Sync(void (*set_up_node)(const Layout&, unsigned rpdos, unsigned tpdos), const Layout& layout, unsigned rpdos,
       unsigned tpdos)
      : set_up_node_(set_up_node), layout_(layout), rpdos_(rpdos), tpdos_(tpdos) {}
  void set_up() { set_up_node_(layout_, rpdos_, tpdos_); }
  void arrange(unsigned) {
    receive_all();
    process_rpdos();
  }
  void run() { CONodeProcess(&node); }
  bool is_done(unsigned);

 protected:
  /// Receives the frames of the RPDOs and the SYNC.
  void receive_all();
  void process_rpdos() {
    for (unsigned n = 0; n < rpdos_; ++n) {
      CONodeProcess(&node);
    }
  }

 private:
  void (*set_up_node_)(const Layout&, unsigned rpdos, unsigned tpdos);
  Layout layout_;
  unsigned rpdos_;
  unsigned tpdos_;
  Random random_;
  CO_IF_FRM received_[4] = {};
};

/// Like Sync, but the reception of the RPDOs' frames is counted.
class SyncWithReception : public Sync {
 public:
  using Sync::Sync;
  void arrange(unsigned) { receive_all(); }
  void run() {
    process_rpdos();
    Sync::run();
  }
};

/// Start a device whose PDOs are all event-driven, and one whose first PDOs are synchronous.
void set_up_event_driven(const Layout& layout);
void set_up_synchronous(const Layout& layout, unsigned rpdos, unsigned tpdos);

}  // namespace bench
