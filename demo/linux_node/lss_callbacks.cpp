// SPDX-License-Identifier: Apache-2.0
// The program keeps what LSS configures; a program that only uses the clock decides for itself.
#include "host/node.hpp"

#if USE_LSS

CO_ERR COLssLoad(std::uint32_t* baud, std::uint8_t* nodeId) { return demo::Node::load_lss(baud, nodeId); }
CO_ERR COLssStore(std::uint32_t baud, std::uint8_t nodeId) { return demo::Node::store_lss(baud, nodeId); }

#endif
