// SPDX-License-Identifier: Apache-2.0
#include "service/nmt/error_behaviour.hpp"

#include "dictionary/parameter.hpp"

namespace co::error_behaviour {
namespace {

constexpr uint8_t communication_error = 1;

// Returns the value of a sub-index of 1029h; without the entry the default.
uint8_t behaviour_for(CO_NODE& node, uint8_t sub) {
  return static_cast<uint8_t>(dict::read_number(node, CO_DEV(0x1029, sub), sizeof(uint8_t), CO_ERROR_BEHAVIOUR_PREOP));
}

}  // namespace

bool react(CO_NODE& node, uint8_t sub) {
  if (!event::is_allowed(node, CO_NMT_ALLOWED) || node.Nmt.Next == CO_INIT) {
    return false;
  }
  const uint8_t behaviour = behaviour_for(node, sub);
  if (behaviour == CO_ERROR_BEHAVIOUR_STOP) {
    event::request_mode(node, CO_STOP);
  } else if (behaviour != CO_ERROR_BEHAVIOUR_NONE && node.Nmt.Mode == CO_OPERATIONAL) {
    event::request_mode(node, CO_PREOP);
  }
  return true;
}

void lose_communication(CO_NODE& node) { (void)react(node, communication_error); }

// The bit rate is switched by LSS. Unlike in lose_communication(), the node leaves Operational in any case.
CO_MODE mode_for_switch(CO_NODE& node) {
  if (node.Nmt.Mode != CO_OPERATIONAL) {
    return node.Nmt.Mode;
  }
  return behaviour_for(node, communication_error) == CO_ERROR_BEHAVIOUR_STOP ? CO_STOP : CO_PREOP;
}

}  // namespace co::error_behaviour

extern "C" {

const CO_OBJ_TYPE COTErrorBehaviour =
    co::parameter<1, co::rules::error_behaviour, co::at_most<CO_ERROR_BEHAVIOUR_STOP>>;

CO_ERR COErrorBehaviour(CO_NODE* node, uint8_t sub) {
  if (node == nullptr || sub == 0 || sub > co::rules::error_behaviour.last_sub) {
    return CO_ERR_BAD_ARG;
  }
  const bool done = co::error_behaviour::react(*node, sub);
  co::event::run_deferred(*node);
  return done ? CO_ERR_NONE : CO_ERR_NMT_MODE;
}

}  // extern "C"
