// SPDX-License-Identifier: Apache-2.0
// Simulates the registers of the imaginary microcontroller (example/example_board.h) on a simulated board.
#pragma once

#include "board.hpp"

namespace check {

// Connects the CAN controller to the board's port and the timer to its clock. The functions are called in the
// interrupts.
void connect_example(Board& board, std::function<void()> can_interrupt, std::function<void()> timer_interrupt);

// Sends \a num pairs of requests at different moments to a node that sleeps in its loop. \a careful: the loop checks
// for events before it sleeps. Returns the number of pairs that were answered.
unsigned answered_by_loop(unsigned num, bool careful);

}  // namespace check
