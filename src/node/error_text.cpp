// SPDX-License-Identifier: Apache-2.0
// The last error of a node as text, without the formatting functions of the C library.
#include "base/timer.hpp"
#include "co_core.h"
#include "dictionary/dict.hpp"
#include "node/parts.hpp"

namespace co::error {
namespace {

// A text of limited size, which always ends with a NUL. Letters that do not fit are left out.
class Text {
 public:
  Text(char* text, uint32_t size) : next_(text), last_(text + size - 1) { *next_ = '\0'; }

  void add(char letter) {
    if (next_ != last_) {
      *next_++ = letter;
      *next_ = '\0';
    }
  }
  void add(const char* words) {
    for (; *words != '\0'; ++words) {
      add(*words);
    }
  }
  void add_hexadecimal(unsigned number, unsigned digits) {
    while (digits != 0) {
      --digits;
      add("0123456789ABCDEF"[(number >> (4 * digits)) & 0xFU]);
    }
  }

 private:
  char* next_;
  char* last_;
};

// Appends "NAME, object 1A00h:02: meaning". key: 0: no object
void add_line(Text& text, const char* name, uint32_t key, const char* meaning) {
  text.add(name);
  if (key != 0) {
    text.add(", object ");
    text.add_hexadecimal(CO_GET_IDX(key), 4);
    text.add("h:");
    text.add_hexadecimal(CO_GET_SUB(key), 2);
  }
  text.add(": ");
  text.add(meaning);
}

bool has(CO_NODE& node, uint16_t index) { return CODictFind(&node.Dict, CO_DEV(index, 0)) != nullptr; }

// Appends calls and settings that are missing in a node that has no error.
void add_hints(Text& text, CO_NODE& node) {
  if (node.Nmt.Mode == CO_INVALID) {
    text.add("; stopped by CONodeStop() or an earlier error (CO_INVALID)");
    return;
  }
  if (node.Nmt.Mode == CO_INIT) {
    text.add(parts::ask<&Part::of_is_waiting>(false, node) ? "; unconfigured: it waits for a node-ID by LSS"
                                                           : "; CONodeStart() has not been called");
  }
  if (node.Baudrate == 0) {
    text.add("; the bit rate is 0 (CO_NODE_SPEC.Baudrate)");
  }
  const tmr::Missing missing = tmr::missing_call(node);
  if (missing != tmr::Missing::nothing) {
    text.add("; a timer has elapsed, and ");
    text.add(missing == tmr::Missing::service ? "COTmrService()" : "COTmrProcess()");
    text.add(" has not been called since");
  }
  if (!has(node, 0x1017) && !has(node, 0x100C)) {
    text.add("; no heartbeat: the dictionary has no object 1017h");
  }
}

}  // namespace
}  // namespace co::error

extern "C" CO_ERR CONodeGetErrText(CO_NODE* node, char* text, uint32_t size) {
  if (node == nullptr || text == nullptr || size == 0) {
    return CO_ERR_BAD_ARG;
  }
  co::error::Text out(text, size);
  uint32_t key_of_fault = 0;
  const CO_DICT_FAULT fault = CODictGetFault(&node->Dict, &key_of_fault);
  CO_ERR err = CONodeGetErr(node);
  if (err != CO_ERR_NONE) {
    co::error::add_line(out, COErrName(err), CONodeGetErrKey(node), COErrText(err));
    out.add(fault != CO_DICT_OK ? "; dictionary: " : "");
  } else if (USE_DICT_CHECK == 0 && fault != CO_DICT_OK) {  // CODictGetFault() has found it
    err = CO_ERR_DICT_INIT;
  } else {
    out.add(COErrText(CO_ERR_NONE));
    if (node->Ext != nullptr) {
      co::error::add_hints(out, *node);
    } else {
      out.add("; CONodeInit() has not been called");
    }
    return CO_ERR_NONE;
  }
  if (fault != CO_DICT_OK) {
    co::error::add_line(out, CODictFaultName(fault), key_of_fault, CODictFaultText(fault));
  }
  return err;
}
