// SPDX-License-Identifier: Apache-2.0
#include "spi_model.hpp"

namespace test {

std::string SpiModel::fault_text() const {
  std::string text;
  for (const std::string& one : faults_) {
    text += one + "\n";
  }
  return text;
}

std::size_t SpiModel::bytes() const {
  std::size_t number = 0;
  for (const SpiTransaction& one : transactions_) {
    number += one.sent.size();
  }
  return number;
}

void SpiModel::select() {
  if (is_selected_) {
    fault("CS is set low within a transaction");
  }
  is_selected_ = true;
  transaction_ = {};
}

void SpiModel::deselect() {
  if (!is_selected_) {
    fault("CS is set high without a transaction");
    return;
  }
  is_selected_ = false;
  if (transaction_.sent.empty()) {
    fault("a transaction without an instruction");
  } else {
    end_instruction();
  }
  transactions_.push_back(transaction_);
}

std::uint8_t SpiModel::transfer(std::uint8_t out) {
  if (on_transfer) {
    on_transfer();
  }
  wire_.count_access();
  if (!is_selected_) {
    fault("a byte is transferred while CS is high");
    return not_driven;
  }
  const std::uint8_t in = shift(out);
  transaction_.sent.push_back(out);
  transaction_.received.push_back(in);
  return in;
}

}  // namespace test
