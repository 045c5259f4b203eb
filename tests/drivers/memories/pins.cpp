// SPDX-License-Identifier: Apache-2.0
#include "pins.hpp"

#include "demo/memory/pins.h"

namespace test {

I2cLines* i2c = nullptr;
SpiLines* spi = nullptr;

}  // namespace test

void BoardWaitMicroseconds(uint32_t microseconds) {
  if (test::i2c != nullptr) {
    test::i2c->memory.now += microseconds;
  }
  if (test::spi != nullptr) {
    test::spi->memory.now += microseconds;
  }
}

void BoardSetScl(bool high) { test::i2c->set_scl(high); }
void BoardSetSda(bool high) { test::i2c->set_sda(high); }
bool BoardGetScl(void) { return test::i2c->scl(); }
bool BoardGetSda(void) { return test::i2c->sda(); }

void BoardSetCs(bool high) { test::spi->set_cs(high); }
void BoardSetSck(bool high) { test::spi->set_sck(high); }
void BoardSetMosi(bool high) { test::spi->mosi = high; }
bool BoardGetMiso(void) { return test::spi->miso(); }
