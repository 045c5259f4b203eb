// SPDX-License-Identifier: Apache-2.0
#include "od/transfer.hpp"

#if USE_OD

#include "core/access.hpp"

namespace co::od {
namespace {

constexpr unsigned application = OD_TRANSFER_N - 1;

// Of the places for SDO. A transfer that was never told its end (its entry has moved, its node was initialised, its
// extension is another) leaves one behind: whatever is begun after it finds a place before that.
unsigned first_of(const OD_t& od, const CO_OBJ& obj) {
  unsigned n = 0;
  while (n < application && od.Transfer[n].Entry != &obj) {
    ++n;
  }
  return n;
}

bool is_free(const CO_NODE& node, const OD_TRANSFER& place) {
  return place.Entry == nullptr || (!has(place, inside) && !access::is_taken(node, *place.Entry, nullptr));
}

}  // namespace

void restart(OD_TRANSFER& transfer, OD_size_t length) {
  transfer.Offset = 0;
  transfer.Length = length;
  transfer.Passed = 0;
  clear(transfer, exhausted);
  clear(transfer, holds);
}

bool is_served(const OD_t& od, const CO_NODE& node, const CO_OBJ& obj) {
  if (node.Served != &obj) {
    return false;
  }
  const unsigned n = first_of(od, obj);
  return n == application || !has(od.Transfer[n], inside);
}

OD_TRANSFER* first_transfer(OD_t& od, const CO_OBJ& obj) {
  const unsigned n = first_of(od, obj);
  return n == application ? nullptr : &od.Transfer[n];
}

OD_TRANSFER* find_transfer(OD_t& od, const CO_NODE& node, const CO_OBJ& obj) {
  OD_TRANSFER* const place = first_transfer(od, obj);
  const bool lost = place != nullptr && has(*place, by_server) && !access::is_taken(node, obj, nullptr);
  return lost ? nullptr : place;
}

OD_TRANSFER* find_access(OD_t& od, const CO_NODE& node, const CO_OBJ& obj) {
  if (is_served(od, node, obj)) {
    return find_transfer(od, node, obj);
  }
  OD_TRANSFER& own = od.Transfer[application];
  return own.Entry == &obj ? &own : nullptr;
}

OD_TRANSFER* begin_transfer(OD_t& od, const CO_NODE& node, const CO_OBJ& obj, uint32_t total) {
  unsigned n = 0;
  while (n < application && !is_free(node, od.Transfer[n])) {
    ++n;
  }
  if (n == application) {
    return nullptr;
  }
  od.Transfer[n] = {&obj, 0, 0, 0, total, 0, 0};
  return &od.Transfer[n];
}

void bind(OD_TRANSFER& transfer, const CO_NODE& node) {
  if (access::is_taken(node, *transfer.Entry, nullptr)) {
    set(transfer, by_server);
  }
}

void end_transfer(OD_TRANSFER& transfer) { transfer = {}; }

OD_TRANSFER& begin_access(OD_t& od, const CO_OBJ& obj) {
  OD_TRANSFER& own = od.Transfer[application];
  own = {&obj, 0, 0, 0, CO_OBJ_SIZE_UNKNOWN, 0, 0};
  return own;
}

}  // namespace co::od

#endif
