// SPDX-License-Identifier: Apache-2.0
#include "extra/od/transfer.hpp"

#if USE_OD

#include "co_assert.h"
#include "dictionary/access.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/stream.hpp"
#include "extra/od/properties.hpp"
#include "hal/port.hpp"

namespace co::od {
namespace {

// Index of the access of the application in OD_t.Transfer; the elements before it are SDO transfers.
constexpr unsigned application = OD_TRANSFER_N - 1;

// Returns the position of the first SDO transfer of an object; application if there is none. A transfer whose end was
// never reported (its entry was moved, its node was initialised again, or its extension was replaced) stays in the
// array; a later transfer of the object replaces it or gets a position before it.
unsigned first_of(const OD_t& od, const CO_OBJ& obj) {
  unsigned n = 0;
  while (n < application && od.Transfer[n].Entry != &obj) {
    ++n;
  }
  return n;
}

// Returns whether obj is an extensible entry of the object with this index. obj is accessed only if it points into the
// table.
bool is_extensible_of(const OD_t& od, uint16_t index, const CO_OBJ* obj) {
  const auto offset = reinterpret_cast<uintptr_t>(obj) - reinterpret_cast<uintptr_t>(od.Table);
  return offset < od.TableLen * sizeof(CO_OBJ) && CO_GET_IDX(obj->Key) == index && extensible(*obj) != nullptr;
}

// Returns whether an OD_TRANSFER can be used for another SDO transfer.
bool is_free(const CO_NODE& node, const OD_TRANSFER& transfer) {
  return transfer.Entry == nullptr || (!has(transfer, in_application) && !access::is_open(node, *transfer.Entry));
}

// Returns the SDO transfer of an object at index that is being processed, or null. The node, which may not be
// initialised yet, is accessed only if there is a transfer.
OD_TRANSFER* find_running(OD_t& od, uint16_t index) {
  for (unsigned n = 0; n < application; ++n) {
    OD_TRANSFER& transfer = od.Transfer[n];
    if (is_extensible_of(od, index, transfer.Entry) && access::requested_object(*od.Node) == transfer.Entry) {
      return &transfer;
    }
  }
  return nullptr;
}

}  // namespace

void restart(OD_TRANSFER& transfer, OD_size_t length) {
  transfer.Offset = 0;
  transfer.Length = length;
  transfer.Passed = 0;
  clear(transfer, all_passed);
  clear(transfer, has_kept_byte);
  clear(transfer, rereads);
}

bool is_called_by_transfer(const OD_t& od, const CO_NODE& node, const CO_OBJ& obj) {
  if (access::requested_object(node) != &obj) {
    return false;
  }
  const unsigned n = first_of(od, obj);
  return n == application || !has(od.Transfer[n], in_application);
}

OD_TRANSFER* first_transfer(OD_t& od, const CO_OBJ& obj) {
  const unsigned n = first_of(od, obj);
  return n == application ? nullptr : &od.Transfer[n];
}

OD_TRANSFER* find_transfer(OD_t& od, const CO_NODE& node, const CO_OBJ& obj) {
  OD_TRANSFER* const transfer = first_transfer(od, obj);
  const bool is_closed = transfer != nullptr && has(*transfer, by_server) && !access::is_open(node, obj);
  return is_closed ? nullptr : transfer;
}

OD_TRANSFER* find_access(OD_t& od, const CO_NODE& node, const CO_OBJ& obj) {
  if (is_called_by_transfer(od, node, obj)) {
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

void mark_if_of_server(OD_TRANSFER& transfer, const CO_NODE& node) {
  CO_ASSERT(transfer.Entry != nullptr);
  if (access::is_open(node, *transfer.Entry)) {
    set(transfer, by_server);
  }
}

void end_transfer(OD_TRANSFER& transfer) {
  CO_ASSERT(transfer.Entry != nullptr);
  transfer = {};
}

void end_accesses(OD_t& od, uint16_t index) {
  CO_NODE& node = *od.Node;
  OD_TRANSFER* const running = find_running(od, index);
  if (running != nullptr) {
    set(*running, extension_changed);
  }
  ++od.Changes;
  OD_TRANSFER& own = od.Transfer[application];
  if (is_extensible_of(od, index, own.Entry)) {
    own = {};
  }
  access::end_transfers(node, [&](const CO_OBJ* obj) {
    return (running == nullptr || obj != running->Entry) && is_extensible_of(od, index, obj);
  });
}

bool is_extension_changed(const CO_NODE& node, const CO_OBJ& obj) {
  OD_t* const od = port::od_of(node);
  if (od == nullptr || !is_called_by_transfer(*od, node, obj)) {
    return false;
  }
  const OD_TRANSFER* const transfer = first_transfer(*od, obj);
  return transfer != nullptr && has(*transfer, extension_changed);
}

OD_TRANSFER& begin_access(OD_t& od, const CO_OBJ& obj) {
  OD_TRANSFER& own = od.Transfer[application];
  own = {&obj, 0, 0, 0, CO_OBJ_SIZE_UNKNOWN, 0, 0};
  return own;
}

// All extended streams share one OD_TRANSFER for the application. It is not restored if an object has got another
// extension meanwhile, because that may have ended the application's access (OD_extension_init()).
CO_ERR pass_stream(CO_OBJ* source, CO_NODE* node, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes) {
  OD_t* const od = port::od_of(*node);
  if (od == nullptr) {
    return obj::pass_stream(source, node, function, data, bytes);
  }
  const uint16_t changes = od->Changes;
  const OD_TRANSFER before = od->Transfer[application];
  const CO_ERR err = obj::pass_stream(source, node, function, data, bytes);
  if (od->Changes == changes) {
    od->Transfer[application] = before;
  }
  return err;
}

}  // namespace co::od

#endif
