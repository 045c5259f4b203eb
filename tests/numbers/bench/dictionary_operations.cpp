// SPDX-License-Identifier: Apache-2.0
// Cost of the lookup of an object by index and sub-index.
#include "device.hpp"
#include "measure.hpp"
#include "operations.hpp"
#include "random.hpp"

namespace bench {
namespace {

constexpr unsigned most_entries = 8192;
constexpr unsigned subs = 4;  // sub-indices of each index

CO_OBJ table[most_entries];
CO_NODE owner;

constexpr std::uint32_t key_of(unsigned place) { return CO_KEY(0x2000 + place / subs, place % subs, 0); }

class LookUp : public Operation {
 public:
  LookUp(unsigned entries, bool in_turn) : entries_(entries), in_turn_(in_turn) {}

  void set_up() {
    for (unsigned n = 0; n < entries_; ++n) {
      table[n] = {key_of(n) | CO_OBJ_D___R_, CO_TUNSIGNED32, (CO_DATA)(0)};
    }
    if (CODictInit(&owner.Dict, &owner, table, static_cast<std::uint16_t>(entries_)) < 0) {
      fail("dictionary", "it is refused");
    }
  }

  void arrange(unsigned n) {
    place_ = in_turn_ ? n % entries_ : random_.below(entries_);
    key_ = key_of(place_);
  }

  void run() { found_ = CODictFind(&owner.Dict, key_); }

  bool is_done(unsigned) { return found_ == &table[place_]; }

 private:
  unsigned entries_;
  bool in_turn_;
  Random random_;
  unsigned place_ = 0;
  std::uint32_t key_ = 0;
  const CO_OBJ* found_ = nullptr;
};

class Miss : public Operation {
 public:
  void set_up() { LookUp(512, false).set_up(); }
  void arrange(unsigned) { key_ = CO_DEV(0x2000 + random_.below(128), subs + random_.below(200)); }
  void run() { found_ = CODictFind(&owner.Dict, key_); }
  bool is_done(unsigned) { return found_ == nullptr; }

 private:
  Random random_;
  std::uint32_t key_ = 0;
  const CO_OBJ* found_ = table;
};

}  // namespace

void measure_dictionary() {
  measure("look-up, hit, 32 entries", LookUp(32, false));
  measure("look-up, hit, 512 entries", LookUp(512, false));
  measure("look-up, hit, 8192 entries", LookUp(8192, false));
  measure("look-up, no such sub-index, 512 entries", Miss());
  measure("look-up of the next sub-index, 512 entries", LookUp(512, true));
}

}  // namespace bench
