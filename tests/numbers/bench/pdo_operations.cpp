// SPDX-License-Identifier: Apache-2.0
// Cost of PDOs, with several layouts of their objects in memory.
#include "measure.hpp"
#include "node_operations.hpp"
#include "operations.hpp"

namespace bench {
namespace {

// A synchronous RPDO, which is stored until the next SYNC.
class KeptPdo : public Operation {
 public:
  void set_up() { set_up_synchronous(bytes, 1, 0); }
  void arrange(unsigned) {
    if (received_.DLC != 0) {
      receive(frame(0x80, {}));  // applies the previous RPDO, so that the list of stored RPDOs is empty
      CONodeProcess(&node);
    }
    received_ = random_rpdo(0, bytes, random_);
    receive(received_);
  }
  void run() { CONodeProcess(&node); }
  bool is_done(unsigned) {
    const bool kept = !holds(received_, bytes, rpdo_memory(0));
    receive(frame(0x80, {}));
    CONodeProcess(&node);
    return kept && holds(received_, bytes, rpdo_memory(0));
  }

 private:
  Random random_;
  CO_IF_FRM received_{};
};

// A remote request for a TPDO, which is sent at once.
class RemoteRequest : public Operation {
 public:
  void set_up() {
    clear_dictionary();
    add_usual_objects();
    add_tpdo(0, 253, bytes, true);
    start(CO_OPERATIONAL);
  }
  void arrange(unsigned) {
    for (unsigned n = 0; n < bytes.number; ++n) {
      change(tpdo_memory(0) + n, random_);
    }
    forget_sent();
    receive({tpdo_id(0) | CO_IF_FRM_RTR, {}, bytes.length()});
  }
  void run() { CONodeProcess(&node); }
  bool is_done(unsigned) {
    return sent() == 1 && sent(0).Identifier == tpdo_id(0) && holds(sent(0), bytes, tpdo_memory(0));
  }

 private:
  Random random_;
};

ReceivedPdo received(const Layout& layout) { return {set_up_event_driven, layout}; }
TriggeredPdo triggered(const Layout& layout) { return {set_up_event_driven, layout}; }
Sync sync(const Layout& layout, unsigned rpdos, unsigned tpdos) { return {set_up_synchronous, layout, rpdos, tpdos}; }

}  // namespace

void measure_rpdos() {
  measure("RPDO, 8 x 8 bits, neighbours", received(bytes));
  measure("RPDO, 8 x 8 bits, scattered", received(scattered_bytes));
  measure("RPDO, 4 x 16 bits, neighbours", received(halves));
  measure("RPDO, 4 x 16 bits, scattered", received(scattered_halves));
  measure("RPDO, 2 x 32 bits, neighbours", received(words));
  measure("RPDO, 2 x 32 bits, scattered", received(scattered_words));
  measure("RPDO, synchronous, kept until the SYNC", KeptPdo());
}

void measure_tpdos() {
  measure("TPDO, 8 x 8 bits, neighbours, trigger to frame", triggered(bytes));
  measure("TPDO, 8 x 8 bits, scattered, trigger to frame", triggered(scattered_bytes));
  measure("TPDO, 4 x 16 bits, neighbours, trigger to frame", triggered(halves));
  measure("TPDO, 4 x 16 bits, scattered, trigger to frame", triggered(scattered_halves));
  measure("TPDO, 2 x 32 bits, neighbours, trigger to frame", triggered(words));
  measure("TPDO, 2 x 32 bits, scattered, trigger to frame", triggered(scattered_words));
  if (USE_PDO_RTR != 0) {
    measure("TPDO, 8 x 8 bits, remote request to frame", RemoteRequest());
  }
  measure("TPDO, 8 x 8 bits, write of an object to frame", WrittenObject(set_up_event_driven));
}

void measure_sync() {
  measure("SYNC, no synchronous PDO", sync(bytes, 0, 0));
  measure("SYNC, 1 RPDO of 8 x 8 bits, neighbours", sync(bytes, 1, 0));
  measure("SYNC, 1 RPDO of 8 x 8 bits, scattered", sync(scattered_bytes, 1, 0));
  measure("SYNC, 1 RPDO of 4 x 16 bits, neighbours", sync(halves, 1, 0));
  measure("SYNC, 1 RPDO of 4 x 16 bits, scattered", sync(scattered_halves, 1, 0));
  measure("SYNC, 1 RPDO of 2 x 32 bits, neighbours", sync(words, 1, 0));
  measure("SYNC, 1 RPDO of 2 x 32 bits, scattered", sync(scattered_words, 1, 0));
  measure("SYNC, 1 TPDO of 8 x 8 bits, neighbours", sync(bytes, 0, 1));
  measure("SYNC, 1 TPDO of 8 x 8 bits, scattered", sync(scattered_bytes, 0, 1));
  measure("SYNC, 1 TPDO of 4 x 16 bits, neighbours", sync(halves, 0, 1));
  measure("SYNC, 1 TPDO of 4 x 16 bits, scattered", sync(scattered_halves, 0, 1));
  measure("SYNC, 1 TPDO of 2 x 32 bits, neighbours", sync(words, 0, 1));
  measure("SYNC, 1 TPDO of 2 x 32 bits, scattered", sync(scattered_words, 0, 1));
  measure("SYNC, 4 RPDOs and 1 TPDO of 8 x 8 bits, neighbours", sync(bytes, 4, 1));
  measure("SYNC, 4 RPDOs and 1 TPDO of 8 x 8 bits, neighbours, reception included",
          SyncWithReception(set_up_synchronous, bytes, 4, 1));
  measure("SYNC, 4 RPDOs and 4 TPDOs of 8 x 8 bits, neighbours", sync(bytes, 4, 4));
}

}  // namespace bench
