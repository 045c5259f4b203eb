// SPDX-License-Identifier: Apache-2.0
// The application's access to the drivers of a node (co_if.h).
#include "base/error.hpp"
#include "base/transmit.hpp"
#include "hal/port.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"

extern "C" {

void COIfInit(CO_IF* cif, CO_NODE* node, uint32_t freq) {
  ASSERT_PTR_FATAL(cif);
  ASSERT_PTR_FATAL(node);
  cif->Node = node;
  node->Tmr.Freq = freq;
  if (co::port::is_initialised(*node)) {
    co::port::init(*node);
  }
}

void COIfCanInit(CO_IF* cif, CO_NODE* node) {
  ASSERT_PTR_FATAL(cif);
  ASSERT_PTR_FATAL(node);
  cif->Node = node;
  if (co::port::is_initialised(*node)) {
    co::port::can_init(*node);
  }
}

void COIfCanEnable(CO_IF* cif, uint32_t baud) {
  ASSERT_PTR_FATAL(cif);
  ASSERT_PTR_FATAL(cif->Node);
  if (baud != 0) {
    cif->Node->Baudrate = baud;
  }
  if (co::port::is_initialised(*cif->Node)) {
    co::port::can_enable(*cif->Node, cif->Node->Baudrate);
  }
}

int16_t COIfCanRead(CO_IF* cif, CO_IF_FRM* frm) {
  ASSERT_PTR_ERR(cif, -1);
  ASSERT_PTR_ERR(cif->Node, -1);
  ASSERT_PTR_ERR(frm, -1);
  if (!co::port::is_initialised(*cif->Node)) {
    return 0;
  }
  int16_t result = co::receive::read(*cif->Node, *frm);
  while (result > 0 && !co::wire::normalise_length(*frm)) {
    co::count(cif->Node->Count.Malformed);
    result = co::receive::read(*cif->Node, *frm);
  }
  return result;
}

int16_t COIfCanSend(CO_IF* cif, CO_IF_FRM* frm) {
  ASSERT_PTR_ERR(cif, -1);
  ASSERT_PTR_ERR(cif->Node, -1);
  ASSERT_PTR_ERR(frm, -1);
  ASSERT_NOT_ERR(cif->Node->Nmt.Mode, CO_INVALID, -1);
  CO_IF_FRM frame = *frm;
  frame.Identifier = co::wire::normalised(frame.Identifier);
  if (!co::wire::normalise_length(frame)) {
    co::count(cif->Node->Count.Malformed);
    return -1;
  }
  return co::transmit::send_for_application(*cif->Node, frame) ? static_cast<int16_t>(sizeof frame)
                                                               : static_cast<int16_t>(0);
}

void COIfCanReset(CO_IF* cif) {
  ASSERT_PTR_FATAL(cif);
  ASSERT_PTR_FATAL(cif->Node);
  if (co::port::is_initialised(*cif->Node)) {
    co::port::can_reset(*cif->Node);
  }
}

void COIfCanClose(CO_IF* cif) {
  ASSERT_PTR_FATAL(cif);
  ASSERT_PTR_FATAL(cif->Node);
  if (co::port::is_initialised(*cif->Node)) {
    co::port::can_close(*cif->Node);
  }
}

uint32_t COIfNvmRead(CO_IF* cif, uint32_t start, uint8_t* buffer, uint32_t size) {
  ASSERT_PTR_ERR(cif, 0);
  ASSERT_PTR_ERR(cif->Node, 0);
  ASSERT_PTR_ERR(buffer, 0);
  return co::port::nvm_read(*cif->Node, start, buffer, size);
}

uint32_t COIfNvmWrite(CO_IF* cif, uint32_t start, uint8_t* buffer, uint32_t size) {
  ASSERT_PTR_ERR(cif, 0);
  ASSERT_PTR_ERR(cif->Node, 0);
  ASSERT_PTR_ERR(buffer, 0);
  return co::port::nvm_write(*cif->Node, start, buffer, size);
}

}  // extern "C"
