// SPDX-License-Identifier: Apache-2.0
#include "host/loop.hpp"

#include <algorithm>
#include <utility>

namespace lexican {

Loop::Loop(Host& host, std::vector<Node*> nodes) : host_(host), nodes_(std::move(nodes)) {}

/// Processes all nodes. Returns false if no frame was transferred: then all nodes are idle until the next timer or
/// frame.
bool Loop::process() {
  bool busy = false;
  for (Node* const node : nodes_) {
    busy = node->process() || busy;
  }
  return busy;
}

Micros Loop::due_in() {
  Micros due = for_ever;
  for (Node* const node : nodes_) {
    due = std::min(due, node->due_in());
  }
  return due;
}

bool Loop::run_until(const std::function<bool()>& done, Micros timeout) {
  const Micros begin = host_.now();
  for (;;) {
    const bool busy = process();
    if (done()) {
      return true;
    }
    const Micros passed = host_.now() - begin;
    if (passed >= timeout || host_.interrupted()) {
      return false;
    }
    if (!busy) {
      host_.wait(std::min(timeout - passed, due_in()));
    }
  }
}

void Loop::run_for(Micros time) {
  run_until([] { return false; }, time);
}

void Loop::flush(Micros timeout) {
  const Micros begin = host_.now();
  const auto is_idle = [](Node* node) { return node->is_idle(); };
  for (;;) {
    process();
    if (std::all_of(nodes_.begin(), nodes_.end(), is_idle) || host_.now() - begin >= timeout) {
      return;
    }
    host_.wait(millisecond);
  }
}

}  // namespace lexican
