// SPDX-License-Identifier: Apache-2.0
#include "timers.hpp"

namespace test {

Runs& runs() {
  static Runs all;
  return all;
}

void note(void* para) {
  const OutsideStack outside;
  runs().push_back(reinterpret_cast<std::uintptr_t>(para));
}

Timers::Timers(const Setup& setup) : Fixture(setup) { runs().clear(); }

std::int16_t Timers::create(std::uint32_t start, std::uint32_t cycle, std::uintptr_t n) {
  std::int16_t id = -1;
  call([&] { id = COTmrCreate(&node.Tmr, start, cycle, note, number(n)); });
  return id;
}

std::int16_t Timers::remove(std::int16_t id) {
  std::int16_t result = -2;
  call([&] { result = COTmrDelete(&node.Tmr, id); });
  return result;
}

}  // namespace test
