// SPDX-License-Identifier: Apache-2.0
// LSS callbacks of the program: they store node-ID and bit rate. A program that only uses the class Clock defines its
// own.
#include "host/node.hpp"

#if USE_LSS

CO_ERR COLssLoad(std::uint32_t* baud, std::uint8_t* nodeId) { return lexican::Node::load_lss(baud, nodeId); }
CO_ERR COLssStore(std::uint32_t baud, std::uint8_t nodeId) { return lexican::Node::store_lss(baud, nodeId); }

#endif
