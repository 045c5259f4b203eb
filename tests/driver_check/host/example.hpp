// SPDX-License-Identifier: Apache-2.0
// The registers of the imaginary microcontroller (example/example_board.h), moved by a simulated board.
#pragma once

#include "board.hpp"

namespace check {

// Puts the controller on the board's port, and the timer on its clock. handle: what the interrupts do.
void connect_example(Board& board, std::function<void()> can_interrupt, std::function<void()> timer_interrupt);

// Answers of a node that sleeps in its loop, and of one whose loop does not ask before it sleeps: number of requests at
// different moments that were answered, of num.
unsigned answered_by_loop(unsigned num, bool careful);

}  // namespace check
