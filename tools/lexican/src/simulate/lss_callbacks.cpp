// SPDX-License-Identifier: Apache-2.0
// LSS callbacks of simulated devices: they store node-ID and bit rate in the memory of the device.
#include "host/node.hpp"

#if USE_LSS

CO_ERR COLssLoad(std::uint32_t* baud, std::uint8_t* nodeId) { return lexican::Node::load_lss(baud, nodeId); }
CO_ERR COLssStore(std::uint32_t baud, std::uint8_t nodeId) { return lexican::Node::store_lss(baud, nodeId); }

#endif
