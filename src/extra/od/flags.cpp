// SPDX-License-Identifier: Apache-2.0
// PDO flags of an object: which PDOs have been transmitted or received with it.
#include "base/error.hpp"
#include "base/events.hpp"
#include "extra/od/index.hpp"
#include "service/pdo/configuration.hpp"
#include "service/pdo/multiplex.hpp"
#include "service/pdo/pdo.hpp"

#if USE_OD

namespace co::od {
namespace {

constexpr unsigned most_tpdos = 8 * sizeof(OD_flagsPDO_t) - 1;
constexpr OD_flagsPDO_t received = 1;
constexpr OD_flagsPDO_t sent = ~received;

// Returns the entry of a sub-index; null if there is none, or if the node uses another table now: PDOs map entries of
// the table in use only.
CO_OBJ* find_entry_in_use(const OD_entry_t* entry, uint8_t sub) {
  if (entry == nullptr || !is_of_table(*entry)) {
    return nullptr;
  }
  const OD_t& od = owner_of(*entry);
  return od.Node->Dict.Root == od.Table ? find_in_table(*entry, sub) : nullptr;
}

// Bit in which a PDO records that it was transmitted or received with an object.
struct Note {
  uint8_t* byte;  // null: the PDO does not contain the object
  uint8_t bit;

  [[nodiscard]] bool is_set() const { return byte != nullptr && (*byte & bit) != 0; }
  void put(bool value) const {
    if (byte != nullptr) {
      *byte = static_cast<uint8_t>(value ? *byte | bit : *byte & ~bit);
    }
  }
  void clear() const { put(false); }
};

// Returns the bit of an object with a position in a list of num objects; without byte if position is not in the list.
Note note_of(uint8_t* bytes, unsigned position, unsigned num) {
  return {position < num ? &bytes[position / 8U] : nullptr, static_cast<uint8_t>(1U << (position % 8U))};
}

// Returns the bit of an object in the mapping of a PDO. number: as in flags_of()
Note note_in(CO_PDO_MAP& map, uint16_t number) {
  return note_of(map.Transferred, pdo::find(map, number), CO_PDO_MAP_N);
}

// An MPDO in source address mode records the objects of the scanner list.
Note note_in(CO_NODE& node, CO_TPDO& pdo, uint16_t number) {
  if (!mpdo::is_sam(pdo.Map)) {
    return note_in(pdo.Map, number);
  }
  const mpdo::Transferred list = mpdo::transferred(node, number);
  return note_of(list.bytes, list.position, list.num);
}

// Returns the flags of an object. Bit 0: an RPDO was received with it; bit n + 1: TPDO n was transmitted with it.
// number: position of its entry in the dictionary
OD_flagsPDO_t flags_of(CO_NODE& node, uint16_t number) {
  OD_flagsPDO_t flags = 0;
  for (CO_RPDO& pdo : pdo::rpdos(node)) {
    flags |= note_in(pdo.Map, number).is_set() ? received : 0U;
  }
  unsigned n = 0;
  for (CO_TPDO& pdo : pdo::tpdos(node)) {
    flags |= n < most_tpdos && note_in(node, pdo, number).is_set() ? OD_flagsPDO_t{2} << n : 0U;
    ++n;
  }
  return flags;
}

void clear_received(CO_NODE& node, uint16_t number) {
  for (CO_RPDO& pdo : pdo::rpdos(node)) {
    note_in(pdo.Map, number).clear();
  }
}

void clear_sent(CO_NODE& node, uint16_t number) {
  for (CO_TPDO& pdo : pdo::tpdos(node)) {
    note_in(node, pdo, number).clear();
  }
}

// Returns whether any TPDO has been transmitted with the object; also checks TPDOs that have no flag.
bool was_sent(CO_NODE& node, uint16_t number) {
  for (CO_TPDO& pdo : pdo::tpdos(node)) {
    if (note_in(node, pdo, number).is_set()) {
      return true;
    }
  }
  return false;
}

// Clears the flag of a TPDO that contains the object, and requests its transmission.
void request(CO_NODE& node, uint16_t number, unsigned tpdo) {
  const pdo::Pdos tpdos = pdo::tpdos(node);
  const Note note = tpdo < tpdos.num ? note_in(node, tpdos.first[tpdo], number) : Note{nullptr, 0};
  if (note.byte == nullptr) {
    return;
  }
  note.clear();
  if (mpdo::is_sam(tpdos.first[tpdo].Map)) {
    mpdo::mark(node, number);
  }
  error::report(node, pdo::request(node, static_cast<uint16_t>(tpdo)), pdo::key_of_tpdo(tpdo));
}

// Copies the flag "transmitted" of a sub-index to its bit in OD_extension_t.flagsPDO, for applications that read the
// flag there.
void mirror([[maybe_unused]] const OD_entry_t& entry, [[maybe_unused]] uint8_t sub, [[maybe_unused]] bool is_sent) {
#if OD_FLAGS_PDO_SIZE > 0
  if (entry.extension != nullptr) {
    note_of(entry.extension->flagsPDO, sub, 8 * OD_FLAGS_PDO_SIZE).put(is_sent);
  }
#endif
}

}  // namespace
}  // namespace co::od

extern "C" {

void OD_requestTPDO(OD_entry_t* entry, uint8_t subIndex) {
  CO_OBJ* const obj = co::od::find_entry_in_use(entry, subIndex);
  if (obj == nullptr) {
    return;
  }
  CO_NODE& node = *co::od::owner_of(*entry).Node;
  const co::event::Call call(node);
  co::od::mirror(*entry, subIndex, false);
  co::od::clear_sent(node, co::pdo::number_of(node, *obj));
  const uint32_t key = obj->Key;  // a copy: a callback may replace the table
  co::error::report(node, co::pdo::request_object(node, *obj), key);
}

bool_t OD_TPDOtransmitted(OD_entry_t* entry, uint8_t subIndex) {
  const CO_OBJ* const obj = co::od::find_entry_in_use(entry, subIndex);
  if (obj == nullptr) {
    return false;
  }
  CO_NODE& node = *co::od::owner_of(*entry).Node;
  const bool is_sent = co::od::was_sent(node, co::pdo::number_of(node, *obj));
  if (is_sent) {
    co::od::mirror(*entry, subIndex, true);
  }
  return is_sent;
}

OD_flagsPDO_t OD_getFlagsPDO(const OD_entry_t* entry, uint8_t subIndex) {
  const CO_OBJ* const obj = co::od::find_entry_in_use(entry, subIndex);
  if (obj == nullptr) {
    return 0;
  }
  CO_NODE& node = *co::od::owner_of(*entry).Node;
  return co::od::flags_of(node, co::pdo::number_of(node, *obj));
}

// Does not use entry after the first request, which may call functions of the application: they may change the index.
void OD_clearFlagsPDO(const OD_entry_t* entry, uint8_t subIndex, OD_flagsPDO_t flags) {
  const CO_OBJ* const obj = co::od::find_entry_in_use(entry, subIndex);
  if (obj == nullptr) {
    return;
  }
  CO_NODE& node = *co::od::owner_of(*entry).Node;
  const uint16_t number = co::pdo::number_of(node, *obj);
  if ((flags & co::od::received) != 0) {
    co::od::clear_received(node, number);
  }
  const co::event::Call call(node);
  OD_flagsPDO_t left = (flags & co::od::sent) >> 1;
  if (left != 0) {
    co::od::mirror(*entry, subIndex, false);
  }
  for (unsigned tpdo = 0; left != 0; ++tpdo, left >>= 1) {
    if ((left & 1U) != 0) {
      co::od::request(node, number, tpdo);
    }
  }
}

}  // extern "C"

#endif
