// SPDX-License-Identifier: Apache-2.0
// Parameter groups: the objects 1010h and 1011h and what is behind them. [301:7.5.2.13, 7.5.2.14]
#pragma once

#include "co_core.h"

namespace co::para {

// Gives the groups of a reset the values that were stored, or their defaults. Comes before anything reads them. Returns
// what went wrong last, which is the node's error, too.
CO_ERR load(CO_NODE& node, CO_NMT_RESET type);

// Loads the objects of the communication profile in groups of reset node (CO_PARA.ComSize).
void load_communication(CO_NODE& node);

// Stores the autonomous groups that have changed, within the budget.
void save_changes(CO_NODE& node);

void init(CO_NODE& node);
void on_mode(CO_NODE& node);

// The network has written an object: if it is part of a group, the configuration is no longer the one of 1020h.
void on_write(CO_NODE& node, const CO_OBJ& obj);

[[nodiscard]] CO_ERR save(CO_NODE& node, const CO_PARA& group);
[[nodiscard]] CO_ERR restore(CO_NODE& node, const CO_PARA& group);

}  // namespace co::para
