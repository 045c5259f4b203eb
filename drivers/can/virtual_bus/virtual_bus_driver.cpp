// SPDX-License-Identifier: Apache-2.0
#include "virtual_bus.hpp"

namespace co {
namespace {

VirtualBus::Port& port(void* ctx) { return *static_cast<VirtualBus::Port*>(ctx); }

void init(void* ctx) { port(ctx).close(); }
void enable(void* ctx, std::uint32_t baud) { port(ctx).enable(baud); }

std::int16_t read(void* ctx, CO_IF_FRM* frm) {
  const std::optional<CO_IF_FRM> frame = port(ctx).read();
  if (!frame) {
    return 0;
  }
  *frm = *frame;
  return sizeof(CO_IF_FRM);
}

std::int16_t send(void* ctx, const CO_IF_FRM* frm) { return port(ctx).send(*frm); }
void reset(void* ctx) { port(ctx).reset(); }
void close(void* ctx) { port(ctx).close(); }
void filter(void* ctx, const std::uint32_t* ids, std::uint16_t num) { port(ctx).filter(ids, num); }

}  // namespace

}  // namespace co

const CO_IF_CAN_DRV_EX COVirtualBusDriver = {co::init,  co::enable, co::read,   co::send,
                                             co::reset, co::close,  co::filter, CONodeCanReport};
