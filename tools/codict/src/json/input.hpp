// SPDX-License-Identifier: Apache-2.0
/// \file input.hpp
/// A description in any format: EDS and DCF, XDD, XDC and XPD, JSON.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "eds/document.hpp"
#include "json/document.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"
#include "text/source.hpp"
#include "xdd/document.hpp"

namespace lexican::codict {

/// Description that has been read, with the findings of its reader.
struct Input {
  std::unique_ptr<const eds::Document> eds;  ///< exactly one of these three pointers is not null
  std::unique_ptr<const xdd::Document> xdd;
  std::unique_ptr<const json::Document> json;
  Findings findings;
  Description description;

  const Source& source() const;
  Encoding encoding() const;
  const Device& device() const { return description.devices.front(); }
};

/// Recognises the format and reads a description.
/// \retval nothing  it is not a description; \a why is the reason in one line
std::optional<Input> read(Source source, std::string& why);

}  // namespace lexican::codict
