// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "mutants.hpp"

namespace check {
namespace {

using Port = co::VirtualBus::Port;
constexpr std::int16_t done = sizeof(CO_IF_FRM);

// Functions of a driver, each of which a mutant may replace; by default they use the virtual bus.
struct Can {
  explicit Can(Port& p) : port(p) {}
  Port& port;
  std::function<void()> init = [this] { port.close(); };
  std::function<void(std::uint32_t)> enable = [this](std::uint32_t baud) { port.enable(baud); };
  std::function<std::int16_t(CO_IF_FRM&)> read = [this](CO_IF_FRM& frame) {
    return co::VirtualBusDriver.Read(&port, &frame);
  };
  std::function<std::int16_t(const CO_IF_FRM&)> send = [this](const CO_IF_FRM& frame) { return port.send(frame); };
  std::function<void()> reset = [this] { port.reset(); };
  std::function<void()> close = [this] { port.close(); };
  std::function<void(const std::uint32_t*, std::uint16_t)> filter =
      [this](const std::uint32_t* ids, std::uint16_t num) { port.filter(ids, num); };
};

Can& can(void* ctx) { return *static_cast<Can*>(ctx); }

const CO_IF_CAN_DRV_EX spoilt_driver = {
    [](void* ctx) { can(ctx).init(); },
    [](void* ctx, std::uint32_t baud) { can(ctx).enable(baud); },
    [](void* ctx, CO_IF_FRM* frm) { return can(ctx).read(*frm); },
    [](void* ctx, const CO_IF_FRM* frm) { return can(ctx).send(*frm); },
    [](void* ctx) { can(ctx).reset(); },
    [](void* ctx) { can(ctx).close(); },
    [](void* ctx, const std::uint32_t* ids, std::uint16_t num) { can(ctx).filter(ids, num); },
    nullptr,
};

std::function<void(Setting&)> with(const std::function<void(Can&)>& spoil) {
  return [spoil](Setting& s) {
    static std::vector<std::unique_ptr<Can>> cans;  // not released before the program ends, like real drivers
    cans.push_back(std::make_unique<Can>(s.board.port));
    spoil(*cans.back());
    s.ext.Can = &spoilt_driver;
    s.ext.CanCtx = cans.back().get();
  };
}

std::function<void(Setting&)> received(const std::function<void(CO_IF_FRM&)>& change) {
  return with([change](Can& c) {
    c.read = [&c, change](CO_IF_FRM& frame) {
      const std::int16_t result = co::VirtualBusDriver.Read(&c.port, &frame);
      if (result > 0) {
        change(frame);
      }
      return result;
    };
  });
}

std::function<void(Setting&)> sent(const std::function<void(CO_IF_FRM&)>& change) {
  return with([change](Can& c) {
    c.send = [&c, change](const CO_IF_FRM& frame) {
      CO_IF_FRM changed = frame;
      change(changed);
      return c.port.send(changed);
    };
  });
}

// Sends the frame with the highest priority of three mailboxes first.
void send_by_priority(Can& c) {
  auto boxes = std::make_shared<std::vector<CO_IF_FRM>>();
  const auto pump = [&c, boxes] {
    const auto first = std::min_element(boxes->begin(), boxes->end(),
                                        [](const auto& a, const auto& b) { return a.Identifier < b.Identifier; });
    if (first != boxes->end() && c.port.send(*first) > 0) {
      boxes->erase(first);
    }
  };
  c.send = [boxes, pump](const CO_IF_FRM& frame) {
    if (boxes->size() == 3) {
      pump();
      return static_cast<std::int16_t>(0);
    }
    boxes->push_back(frame);
    return done;
  };
  c.read = [&c, pump](CO_IF_FRM& frame) {
    pump();
    return co::VirtualBusDriver.Read(&c.port, &frame);
  };
}

// Returns the newest of the received frames first.
void read_newest_first(Can& c) {
  auto kept = std::make_shared<std::vector<CO_IF_FRM>>();
  c.read = [&c, kept](CO_IF_FRM& frame) {
    CO_IF_FRM next = {};
    while (co::VirtualBusDriver.Read(&c.port, &next) > 0) {
      kept->push_back(next);
    }
    if (kept->empty()) {
      return static_cast<std::int16_t>(0);
    }
    frame = kept->back();
    kept->pop_back();
    return done;
  };
}

std::vector<Mutant> bus_mutants() {
  return {
      {"a frame is there before Enable", "can.init", with([](Can& c) {
         c.init = [&c] {
           c.port.enable();
           c.port.report({0x181, {}, 0});
         };
       })},
      {"Init goes on the bus", "can.off", with([](Can& c) { c.init = [&c] { c.port.enable(); }; })},
      {"Send takes frames off the bus", "can.off", with([](Can& c) {
         c.send = [&c](const CO_IF_FRM& frame) { return c.port.enabled() ? c.port.send(frame) : done; };
       })},
      {"Read tells an error where there is no frame", "can.empty", with([](Can& c) {
         c.read = [&c](CO_IF_FRM& frame) {
           const std::int16_t result = co::VirtualBusDriver.Read(&c.port, &frame);
           return static_cast<std::int16_t>(result == 0 ? -1 : result);
         };
       })},
      {"Read tells an old frame again and again", "can.empty", with([](Can& c) {
         c.read = [&c](CO_IF_FRM& frame) {
           co::VirtualBusDriver.Read(&c.port, &frame);
           return static_cast<std::int16_t>(c.port.enabled() ? done : 0);
         };
       })},
      {"Reset leaves what was received", "can.reset", with([](Can& c) { c.reset = [] {}; })},
      {"Reset goes off the bus", "can.reset", with([](Can& c) { c.reset = [&c] { c.port.close(); }; })},
      {"Init works once", "can.again", with([](Can& c) {
         c.enable = [&c, used = false](std::uint32_t baud) mutable {
           if (!used) {
             c.port.enable(baud);
           }
           used = true;
         };
       })},
      {"Close stays on the bus", "can.close", with([](Can& c) { c.close = [] {}; })},
      {"Read and Send return 1", "can.result", with([](Can& c) {
         c.read = [&c](CO_IF_FRM& frame) {
           return static_cast<std::int16_t>(co::VirtualBusDriver.Read(&c.port, &frame) > 0 ? 1 : 0);
         };
       })},
  };
}

std::vector<Mutant> frame_mutants() {
  return {
      {"8 bytes become 7", "can.dlc", sent([](CO_IF_FRM& f) { f.DLC = f.DLC == 8 ? 7 : f.DLC; })},
      {"lengths 2 and 3 are swapped", "can.dlc",
       received([](CO_IF_FRM& f) { f.DLC = static_cast<std::uint8_t>(f.DLC == 2 || f.DLC == 3 ? 5 - f.DLC : f.DLC); })},
      {"a frame without data is lost", "can.dlc",
       with([](Can& c) { c.send = [&c](const CO_IF_FRM& f) { return f.DLC == 0 ? done : c.port.send(f); }; })},
      {"the words of the data are big-endian", "can.data",
       received([](CO_IF_FRM& f) { std::reverse(f.Data, f.Data + 4); })},
      {"the last byte is not copied", "can.data", sent([](CO_IF_FRM& f) { f.Data[7] = 0; })},
      {"the identifier has 10 bits", "can.id11",
       sent([](CO_IF_FRM& f) { f.Identifier &= ((f.Identifier & CO_IF_FRM_EXT) != 0) ? ~0U : 0xFFFFFBFF; })},
      {"29-bit identifiers are read as 11-bit ones", "can.id29",
       received([](CO_IF_FRM& f) { f.Identifier &= ~CO_IF_FRM_EXT; })},
      {"29-bit identifiers are sent without their low bits", "can.id29",
       sent([](CO_IF_FRM& f) { f.Identifier &= ((f.Identifier & CO_IF_FRM_EXT) != 0) ? 0xFFFC0000 : ~0U; })},
      {"remote frames are read as data frames", "can.remote",
       received([](CO_IF_FRM& f) { f.Identifier &= ~CO_IF_FRM_RTR; })},
      {"remote frames are sent as data frames", "can.remote",
       sent([](CO_IF_FRM& f) { f.Identifier &= ~CO_IF_FRM_RTR; })},
  };
}

std::vector<Mutant> stream_mutants() {
  return {
      {"mailboxes go by priority", "can.order", with(send_by_priority)},
      {"the newest frame is read first", "can.order", with(read_newest_first)},
      {"taken while full, and lost", "can.busy", with([](Can& c) {
         c.send = [&c](const CO_IF_FRM& f) { return c.port.enabled() && c.port.send(f) == 0 ? done : done; };
       })},
      {"each 50th frame is lost", "can.busy", with([](Can& c) {
         c.send = [&c, n = 0](const CO_IF_FRM& f) mutable { return ++n % 50 == 0 ? done : c.port.send(f); };
       })},
      {"refused, and sent all the same", "can.busy", with([](Can& c) {
         c.send = [&c, n = 0](const CO_IF_FRM& f) mutable {
           const std::int16_t result = c.port.send(f);
           return static_cast<std::int16_t>(++n % 50 == 0 ? 0 : result);
         };
       })},
      {"never ready to send again", "can.busy", with([](Can& c) {
         c.send = [&c, full = false](const CO_IF_FRM& f) mutable {
           full = full || c.port.send(f) == 0;
           return static_cast<std::int16_t>(full ? 0 : done);
         };
       })},
      {"four frames can wait to be read", "can.burst",
       [](Setting& s) {
         static std::vector<std::unique_ptr<co::VirtualBus>> buses;
         Port& small = s.board.bus.attach({"small", 4, 3});
         s.ext.Can = &co::VirtualBusDriver;
         s.ext.CanCtx = &small;
       }},
      {"the last filter is missing", "can.filter", with([](Can& c) {
         c.filter = [&c](const std::uint32_t* ids, std::uint16_t num) {
           c.port.filter(ids, static_cast<std::uint16_t>(num == 0 ? 0 : num - 1));
         };
       })},
      {"28 filters, and what is beyond is refused", "can.filter", with([](Can& c) {
         c.filter = [&c](const std::uint32_t* ids, std::uint16_t num) {
           c.port.filter(ids, std::min<std::uint16_t>(num, 28));
         };
       })},
      {"filters can be set once", "can.filter", with([](Can& c) {
         c.filter = [&c, set = false](const std::uint32_t* ids, std::uint16_t num) mutable {
           if (!set && num != 0) {
             c.port.filter(ids, num);
             set = true;
           }
         };
       })},
      {"Reset closes the filters", "can.filter", with([](Can& c) {
         c.reset = [&c] {
           c.port.reset();
           if (c.port.filtered()) {
             c.port.filter(nullptr, 0);
           }
         };
       })},
  };
}

}  // namespace

std::vector<Mutant> can_mutants() {
  std::vector<Mutant> all = bus_mutants();
  for (const auto& more : {frame_mutants(), stream_mutants()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace check
