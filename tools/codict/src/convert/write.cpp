// SPDX-License-Identifier: Apache-2.0
#include "convert/write.hpp"

#include <utility>

#include "eds/write.hpp"

namespace lexican::codict::convert {

std::string write(Device device, Target target, xdd::Edition edition, const std::string& file_name) {
  if (!file_name.empty()) {
    device.file.file_name.text = file_name;
    device.file.file_name.is_given = true;
  }
  const bool is_configuration = target == Target::dcf || target == Target::xdc;
  const Device described = is_configuration ? std::move(device) : without_configuration(std::move(device));
  if (target == Target::xdd || target == Target::xdc) {
    return xdd::write(described, edition);
  }
  eds::WriteOptions options;
  options.as_dcf = is_configuration;
  return eds::write(described, options);
}

}  // namespace lexican::codict::convert
