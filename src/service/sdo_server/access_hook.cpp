// SPDX-License-Identifier: Apache-2.0
// The access hook of SDO transfers.
#include "base/access_hook.hpp"

#include "service/sdo_server/transfer.hpp"

#if USE_ACCESS_HOOK

namespace co::sdo_server {
namespace {

// Returns whether an initiate request is a block download; the command is one of the four initiate requests.
constexpr bool is_block_download(uint8_t command) { return command >= 0xC0; }
static_assert(wire::request_of(0xC0) == wire::Request::initiate_block_download);
static_assert(wire::request_of(0xA4) == wire::Request::initiate_block_upload);

void describe_download(CO_ACCESS_SDO& access, const CO_IF_FRM& request) {
  const uint8_t command = request.Data[0];
  const bool by_block = is_block_download(command);
  if (by_block ? wire::is_block_sized(command) : wire::is_size_indicated(command)) {
    access.Size = wire::get_high(request);
  }
  if (!by_block && wire::is_expedited(command)) {
    access.Size = wire::is_size_indicated(command) ? wire::expedited_length(command) : 0;
    access.Data = request.Data + 4;
  }
}

}  // namespace

Abort ask_application(CO_SDO& channel, const CO_IF_FRM& request) {
  CO_NODE& node = *channel.Node;
  CO_ACCESS_SDO access = {};
  access.Index = static_cast<uint16_t>(CO_GET_IDX(channel.Key));
  access.Sub = static_cast<uint8_t>(CO_GET_SUB(channel.Key));
  access.Channel = static_cast<uint8_t>(&channel - node.Sdo);
  if (has(channel, download)) {
    access.Direction = CO_OBJ_DOWNLOAD;
    describe_download(access, request);
  }
  return Abort{gate::ask<uint32_t, const CO_ACCESS_SDO>(node, &CO_CALLBACKS::AccessSdo, access)};
}

}  // namespace co::sdo_server

#endif
