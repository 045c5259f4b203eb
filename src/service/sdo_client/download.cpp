// SPDX-License-Identifier: Apache-2.0
// Expedited and segmented download. [301:7.2.4.3.3-4]
#include "service/sdo_client/transfer.hpp"

namespace co::sdo_client {
namespace {

uint32_t next_length(const CO_CSDO& client) {
  const uint32_t left = client.Size - client.Num;
  return left < wire::segment_bytes ? left : wire::segment_bytes;
}

void put_segment(const CO_CSDO& client, CO_IF_FRM& request) {
  const uint32_t n = next_length(client);
  request.Data[0] = wire::segment(client.Toggle, n, client.Num + n == client.Size);
  __builtin_memcpy(request.Data + 1, client.Buf + client.Num, n);
}

}  // namespace

Abort download_accepted(Step& step) {
  CO_CSDO& client = step.client;
  if (is_expedited(client)) {
    client.Num = client.Size;
    step.silent = true;
    step.done = true;
    return Abort::none;
  }
  put_segment(client, step.request);
  set_state(client, State::download);
  return Abort::none;
}

Abort segment_downloaded(Step& step) {
  CO_CSDO& client = step.client;
  if (wire::toggle(step.response) != client.Toggle) {
    return Abort::toggle_bit;
  }
  client.Num += next_length(client);
  client.Toggle ^= wire::toggle_bit;
  if (client.Num == client.Size) {
    step.silent = true;
    step.done = true;
    return Abort::none;
  }
  put_segment(client, step.request);
  return Abort::none;
}

}  // namespace co::sdo_client
