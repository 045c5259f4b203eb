// SPDX-License-Identifier: Apache-2.0
// Initialisation of a node.
#include "base/error.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "hal/port.hpp"
#include "node/node.hpp"
#include "node/parts.hpp"
#include "wire/cob_id.hpp"
#include "wire/nmt.hpp"

namespace co::node {
namespace {

// Reports mandatory objects that the dictionary lacks as the node's error; the node runs without them. [301:7.5.1]
void check_mandatory_objects(CO_NODE& node) {
  if (USE_DICT_CHECK == 0) {
    return;
  }
  constexpr uint32_t error_register = CO_DEV(0x1001, 0);
  constexpr uint32_t vendor_id = CO_DEV(0x1018, 1);
  if (dict::find(node, error_register) == nullptr) {
    error::report(node, CO_ERR_CFG_1001_0, error_register);
  }
  if (dict::find(node, vendor_id) == nullptr) {
    error::report(node, CO_ERR_CFG_1018, vendor_id);
  }
}

// Returns the error because of which no driver may be called, or CO_ERR_NONE.
CO_ERR check_drivers(const CO_NODE& node, const CO_NODE_SPEC& spec) {
  if (node.Ext != nullptr && node.Ext->Size < sizeof(CO_NODE_EXT)) {
    return CO_ERR_NODE_EXT;
  }
  if (node.If.Can == nullptr) {
    return CO_ERR_NODE_CAN;
  }
  if (node.If.Timer == nullptr) {
    return CO_ERR_NODE_TIMER;
  }
  return spec.TmrFreq == 0 ? CO_ERR_NODE_TMR_FREQ : CO_ERR_NONE;
}

// Returns whether the application has given a length of the SDO servers' buffer that is too short.
bool is_sdo_buffer_short(const CO_NODE& node) {
  constexpr uint32_t needed = USE_SDO_BLOCK != 0 ? CO_SSDO_N * CO_SDO_BUF_BYTE : 0;
  const uint32_t length = needed != 0 && node.SdoBuf != nullptr ? node.Ext->SdoBufLen : 0;
  return length != 0 && length < needed;
}

// Returns the error because of which the node cannot run with drivers that may be called, or CO_ERR_NONE.
CO_ERR check_spec(const CO_NODE& node, const CO_NODE_SPEC& spec) {
  const bool is_unconfigured = USE_LSS != 0 && spec.NodeId == wire::no_node_id;
  if (!wire::is_node_id(spec.NodeId) && !is_unconfigured) {
    return CO_ERR_NODE_ID;
  }
  if (spec.Dict == nullptr || spec.DictLen == 0) {
    return CO_ERR_NODE_DICT;
  }
  return is_sdo_buffer_short(node) ? CO_ERR_NODE_SDO_BUF : CO_ERR_NONE;
}

// Copies the drivers that the extension names.
void take_drivers(CO_IF& cif, const CO_NODE_EXT& ext) {
  cif.Can = ext.Can;
  cif.CanCtx = ext.CanCtx;
  cif.Timer = ext.Timer;
  cif.TimerCtx = ext.TimerCtx;
  cif.Nvm = ext.Nvm;
  cif.NvmCtx = ext.NvmCtx;
}

// Initialises the drivers, the timers and the transmit queue. Where no driver may be called, the node has none.
CO_ERR begin(CO_NODE& node, const CO_NODE_SPEC& spec) {
  const CO_ERR err = check_drivers(node, spec);
  if (err == CO_ERR_NONE) {
    node.Tmr.Freq = spec.TmrFreq;
    port::init(node);
    transmit::init(node);
  } else {
    node.Ext = nullptr;
    node.If.Nvm = nullptr;
  }
  COTmrInit(&node.Tmr, &node, spec.TmrMem, spec.TmrNum, spec.TmrFreq);
  return err != CO_ERR_NONE ? err : check_spec(node, spec);
}

// Clears the node and copies its specification.
void take_over(CO_NODE& node, const CO_NODE_SPEC& spec, const CO_NODE_EXT* ext) {
  node = {};
  node.Ext = ext;
  node.NodeId = spec.NodeId;
  node.Baudrate = spec.Baudrate;
  node.SdoBuf = spec.SdoBuf;
  node.If.Node = &node;
  if (ext != nullptr && ext->Size >= sizeof *ext) {
    take_drivers(node.If, *ext);
  }
  node.Nmt.Node = &node;
  parts::run<&Part::of_take_over>(node, spec);
}

}  // namespace

// Runs the part of the initialisation that every NMT reset repeats, in CO_INIT. The caller keeps the node working, so
// that requests of type functions and callbacks are deferred. Returns false if one of them requests another state.
bool initialise(CO_NODE& node, CO_NMT_RESET type) {
  routes::clear(node);
  dict::set_power_on_values(node, type);
  parts::run<&Part::of_load>(node, type);
  const dict::Initialised initialised = dict::init_objects(node.Dict, node);
  if (initialised.err != CO_ERR_NONE) {
    error::report(node, CO_ERR_OBJ_INIT, initialised.key);
  }
  parts::run<&Part::of_init>(node);
  routes::publish(node);
  return node.Nmt.Next == CO_INIT;
}

void init(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext, AddDrivers add_drivers) {
  ASSERT_PTR_FATAL(node);
  ASSERT_PTR_FATAL(spec);
  take_over(*node, *spec, ext);
  if (add_drivers != nullptr) {
    add_drivers(node->If, spec->Drv);
  }
  node->Error = begin(*node, *spec);
  if (node->Error != CO_ERR_NONE) {
    return;
  }
  parts::run<&Part::of_begin>(*node);
  if (dict::set_table(node->Dict, *node, spec->Dict, spec->DictLen) != CO_ERR_NONE) {
    error::report(*node, CO_ERR_DICT_INIT, dict::fault_key_of(node->Dict));
    return;
  }
  bool is_entered = false;
  bool initialised = false;
  {
    const event::Working working(*node);
    node->Nmt.Next = CO_INIT;
    event::defer(*node, event::mode);
    event::enter_requested_mode(*node);
    is_entered = node->Nmt.Mode == CO_INIT;
    initialised = is_entered && initialise(*node, CO_RESET_NODE);
    event::forget_resets(*node);
  }
  if (dict::stops_node(node->Dict)) {
    event::request_mode(*node, CO_INVALID);
  }
  event::run_deferred(*node);
  if (dict::stops_node(node->Dict)) {
    error::report(*node, CO_ERR_DICT_INIT, dict::fault_key_of(node->Dict));
    return;
  }
  if (!is_entered) {  // CONmtModeChange() has stopped the node
    port::can_close(*node);
  }
  if (!initialised) {
    return;
  }
  check_mandatory_objects(*node);
  port::can_enable(*node, node->Baudrate);
}

}  // namespace co::node

extern "C" {

void CONodeInitCtx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext) {
  co::node::init(node, spec, ext, nullptr);
}

// The symbol contains this library's configuration (lexican/detail/configuration.h); programs that declare the function
// without co_core.h link this alias.
#ifdef CO_CONFIGURED_SYMBOL
void node_init_ctx_plain(CO_NODE*, const CO_NODE_SPEC*, const CO_NODE_EXT*) __asm__("CONodeInitCtx")
    __attribute__((alias(CO_CONFIGURED_SYMBOL("CONodeInitCtx"))));
#endif

}  // extern "C"
